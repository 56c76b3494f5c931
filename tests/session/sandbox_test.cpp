#include "workbench/worker/sandbox.h"

#include <cerrno>
#include <filesystem>
#include <fstream>

#include <catch2/catch.hpp>
#include <sys/stat.h>

#include "geometry/kernel/diagnostic_text.h"
#include "tests/session/small_operations.h"
#include "tests/support/shapes.h"
#include "tests/support/skip.h"
#include "workbench/worker/run_operation.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace fs = std::filesystem;

namespace {

/// A folder with two files, and one that nobody gave beside it.
struct Files {
    fs::path root = temporary_folder();
    fs::path folder = root / "given", file = folder / "a.stl", sibling = folder / "b.stl";
    fs::path secret = root / "secret.txt";

    Files() {
        fs::create_directory(folder);
        for (const fs::path& path : {file, sibling, secret}) std::ofstream(path) << "solid";
    }
};

/// The number of the error that a worker gets which may read `given`.
int error_in_worker(const std::string& what, const fs::path& at = {}, const fs::path& given = {}) {
    const Operation& act = find_test_operation("act");
    Arguments arguments = {{"what", what}};
    if (!at.empty()) arguments.set("at", at.string());
    if (!given.empty()) arguments.set("file", given.string());
    Progress progress;
    const Outcome outcome =
        run_operation(act, {}, checked_arguments(act, arguments), progress, test_worker());
    return std::stoi(text_of(outcome.warnings.at(0)));
}

/// Whether this build, kernel and container restrict workers; otherwise counts as skipped.
bool restricted(bool Sandbox::*part, const std::string& name) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    static_cast<void>(part);
    skip(name + " would stop the sanitizers: their workers go without");
    return false;
#else
    if (available_sandbox().*part) return true;
    skip("this kernel or container has no " + name + ": workers go without");
    return false;
#endif
}

}  // namespace

SCENARIO("A worker reads what it was given, with or without a sandbox", "[session][sandbox]") {
    const Files files;
    CHECK(error_in_worker("read", files.file, files.file) == 0);
    CHECK(error_in_worker("read in a thread", files.file, files.file) == 0);
    CHECK(error_in_worker("calculate") == 0);
    THEN("all of a folder, also through a link") {
        CHECK(error_in_worker("list", files.folder, files.folder) == 0);
        CHECK(error_in_worker("read", files.sibling, files.folder) == 0);
        fs::create_directory_symlink(files.folder, files.root / "link");
        fs::create_symlink(files.file, files.root / "c.stl");
        CHECK(error_in_worker("read", files.root / "link/a.stl", files.root / "link") == 0);
        CHECK(error_in_worker("read", files.root / "c.stl", files.root / "c.stl") == 0);
    }
    THEN("of a detached header the files beside it") {
        const fs::path header = files.folder / "a.NHDR";
        std::ofstream(header) << "NRRD0004";
        CHECK(error_in_worker("read", header, header) == 0);
        CHECK(error_in_worker("read", files.sibling, header) == 0);
    }
    THEN("a file that does not exist is no file, not a forbidden one") {
        CHECK(error_in_worker("read", files.folder / "none", files.folder) == ENOENT);
    }
}

SCENARIO("A worker opens no other file, and writes none", "[session][sandbox]") {
    if (!restricted(&Sandbox::files, "Landlock")) return;
    const Files files;
    for (const fs::path& other : {files.secret, files.sibling, fs::path("/etc/passwd")}) {
        CAPTURE(other.string());
        CHECK(error_in_worker("read", other, files.file) == EACCES);
        CHECK(error_in_worker("read in a thread", other, files.file) == EACCES);
        CHECK(error_in_worker("read", other) == EACCES);
    }
    CHECK(error_in_worker("list", files.folder, files.file) == EACCES);
    CHECK(error_in_worker("list", files.root, files.folder) == EACCES);
    THEN("a link in its folder leads nowhere else") {
        fs::create_symlink(files.secret, files.folder / "link");
        CHECK(error_in_worker("read", files.folder / "link", files.folder) == EACCES);
        CHECK(error_in_worker("read", files.folder / "../secret.txt", files.folder) == EACCES);
    }
    THEN("its own files stay as they are") {
        CHECK(error_in_worker("write", files.file, files.file) == EACCES);
        CHECK(error_in_worker("remove", files.file, files.folder) == EACCES);
        CHECK(error_in_worker("make", files.folder / "new", files.folder) == EACCES);
        CHECK(fs::file_size(files.file) == 5);
        CHECK_FALSE(fs::exists(files.folder / "new"));
    }
}

SCENARIO("A worker has no network, starts nothing, and signals nobody", "[session][sandbox]") {
    if (!restricted(&Sandbox::calls, "seccomp filter")) return;
    for (const char* what : {"socket", "exec", "fork", "signal"}) {
        CAPTURE(what);
        CHECK(error_in_worker(what) == EPERM);
    }
    const Files files;
    CHECK(error_in_worker("chmod", files.file, files.file) == EPERM);
    CHECK_FALSE((fs::status(files.file).permissions() & fs::perms::owner_write) == fs::perms::none);
}
