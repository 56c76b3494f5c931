#include "workbench/project/project.h"

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <optional>
#include <random>

#include <catch2/catch.hpp>
#include <fcntl.h>
#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/pending_files.h"
#include "tests/session/small_operations.h"
#include "tests/support/shapes.h"
#include "tests/support/small_files.h"
#include "workbench/project/record_check.h"
#include "workbench/session/session.h"

using namespace vesselbench;

namespace {

namespace fs = std::filesystem;

const Vec3 kTop(1.0, 2.0, 10.0 + 1.0 / 3.0);  // of make-sphere's default sphere

SessionOptions options() {
    SessionOptions made;
    made.find = test::find_test_operation;
    return made;
}

std::string new_project(std::int64_t levels = 2) {
    const std::string file = test::temporary_folder() + "/case.vbench";
    Session session = Session::create(file, options());
    session.apply("make-sphere", {{"levels", levels}});
    return file;
}

Arguments small_bump(double reach = 4.0) {
    return {{"at", kTop}, {"reach", reach}, {"height", 1.0 / 300.0}};
}

void run_sql(const std::string& file, const std::string& sql) {
    sqlite3* database = nullptr;
    REQUIRE(sqlite3_open(file.c_str(), &database) == SQLITE_OK);
    CHECK(sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK);
    sqlite3_close(database);
}

template <class Error>
std::string error_of(const std::function<void()>& call) {
    try {
        call();
    } catch (const Error& error) {
        return error.what();
    }
    return "no such error";
}

/// The helper program as a child, with its output to read and its input to write.
class Helper {
public:
    Helper(const std::string& what, const std::string& file) {
        int out[2], in[2];
        REQUIRE(pipe2(out, O_CLOEXEC) == 0);
        REQUIRE(pipe2(in, O_CLOEXEC) == 0);
        const std::string program = test::helper_program();
        pid_ = fork();
        if (pid_ == 0) {
            dup2(out[1], STDOUT_FILENO);
            dup2(in[0], STDIN_FILENO);
            execl(program.c_str(), program.c_str(), what.c_str(), file.c_str(), nullptr);
            _exit(127);
        }
        close(out[1]);
        close(in[0]);
        output_ = out[0];
        input_ = in[1];
    }

    ~Helper() {
        close(input_);
        kill_now();
        close(output_);
    }

    Helper(const Helper&) = delete;
    Helper& operator=(const Helper&) = delete;

    void kill_now() {
        if (pid_ <= 0) return;
        ::kill(pid_, SIGKILL);
        waitpid(pid_, nullptr, 0);
        pid_ = -1;
    }

    /// One line of its output; empty at the end.
    std::string line() {
        std::string text;
        for (char c = 0; read(output_, &c, 1) == 1 && c != '\n';) text += c;
        return text;
    }

    [[nodiscard]] pid_t pid() const { return pid_; }

private:
    pid_t pid_ = -1;
    int output_ = -1;
    int input_ = -1;
};

/// Acts as a user without rights for a while (the tests may run as root).
class WithoutRights {
public:
    WithoutRights() {
        if (geteuid() == 0) changed_ = seteuid(65534) == 0;
    }

    ~WithoutRights() {
        if (changed_ && seteuid(0) != 0) std::abort();
    }

    WithoutRights(const WithoutRights&) = delete;
    WithoutRights& operator=(const WithoutRights&) = delete;

private:
    bool changed_ = false;
};

}  // namespace

SCENARIO("A project survives SIGKILL at any moment", "[session][project]") {
    const std::string file = test::temporary_folder() + "/case.vbench";
    (void)Session::create(file, options());
    std::mt19937 random(20240517);
    unsigned long told = 0;
    for (int round = 0; round < 50; ++round) {
        Helper helper("edit", file);
        const auto listen = [&] {
            const std::string line = helper.line();
            if (!line.empty()) told = std::max(told, std::strtoul(line.c_str(), nullptr, 10));
            return !line.empty();
        };
        for (auto lines = random() % 4; lines > 0; --lines) listen();
        // Somewhere within the next edit: one takes a few milliseconds.
        usleep(static_cast<useconds_t>(random() % 8000));
        helper.kill_now();
        CHECK(ProjectFile::open_to_read(file, "a test").check_record().findings.empty());
        while (listen()) {
        }
        Session session = Session::open(file, options());
        REQUIRE(session.read_only_reason().empty());
        const std::size_t found = session.log().size();
        // Commits not printed in time may be there as well.
        REQUIRE(found >= told);
        REQUIRE(found <= told + 1);
        told = found;
        if (found > 0) REQUIRE(session.scene().surface);
    }
    CHECK(told > 20);
    Session session = Session::open(file, options());
    for (const auto& entry : session.replay()) REQUIRE(entry.differences.empty());
}

SCENARIO("Opening a project removes what a killed process left beside it", "[session][project]") {
    const std::string file = new_project();
    const fs::path folder = fs::path(file).parent_path();
    const pid_t child = fork();
    if (child == 0) {
        PendingFiles files;
        (void)files.add(folder / "other.vbench");
        raise(SIGKILL);
    }
    waitpid(child, nullptr, 0);
    const auto partial = [&] {
        return std::ranges::count_if(fs::directory_iterator(folder), [](const auto& entry) {
            return entry.path().filename().string().starts_with(".partial-");
        });
    };
    REQUIRE(partial() == 1);
    (void)Session::open(file, options());
    CHECK(partial() == 0);
}

SCENARIO("A new project ignores the log of a deleted one", "[session][project]") {
    const std::string file = test::temporary_folder() + "/case.vbench";
    (void)Session::create(file, options());
    Helper helper("edit", file);
    while (!helper.line().empty() && std::filesystem::file_size(file + "-wal") == 0) {
    }
    helper.kill_now();
    REQUIRE(std::filesystem::file_size(file + "-wal") > 0);
    std::filesystem::remove(file);
    Session session = Session::create(file, options());
    CHECK(session.log().empty());
}

SCENARIO("Two processes on one project: the second is read-only", "[session][project]") {
    const std::string file = new_project();
    {
        Helper writer("hold", file);
        REQUIRE(writer.line() == "writing");
        Session session = Session::open(file, options());
        const std::string reason = session.read_only_reason();
        CHECK(reason.find("process " + std::to_string(writer.pid())) != std::string::npos);
        CHECK(session.log().size() == 1);
        CHECK(surface_of(session.scene()).triangle_count() == 320);
        CHECK_THROWS_AS(session.apply("bump", small_bump()), IoError);
        CHECK_THROWS_AS(session.undo(), IoError);
        THEN("the lock dies with the process") {
            writer.kill_now();
            CHECK(Session::open(file, options()).read_only_reason().empty());
        }
    }
    THEN("within one process it holds as well") {
        Session first = Session::open(file, options());
        Session second = Session::open(file, options());
        CHECK(first.read_only_reason().empty());
        CHECK_FALSE(second.read_only_reason().empty());
        first.apply("bump", small_bump());
        CHECK(second.log().size() == 1);
    }
}

SCENARIO("A project is created under its lock", "[session][project]") {
    const std::string file = new_project(), other = file + ".earlier";
    const auto put_away = [&] { fs::rename(file, other); };
    WHEN("another process has one of this name open") {
        Helper writer("hold", file);
        REQUIRE(writer.line() == "writing");
        const std::string text =
            error_of<IoError>([&] { (void)Session::create(file, options(), put_away); });
        CHECK(text.find("process " + std::to_string(writer.pid())) != std::string::npos);
        CHECK_FALSE(fs::exists(other));
    }
    WHEN("nobody has") {
        std::string while_made;
        Session session = Session::create(file, options(), [&] {
            while_made = Session::open(file, options()).read_only_reason();
            put_away();
        });
        CHECK(while_made.find("has it open") != std::string::npos);
        CHECK(session.log().empty());
        CHECK(Session::open(other, options()).log().size() == 1);
        THEN("nothing is left when it is discarded") {
            session.discard();
            session = Session::unsaved(options());
            CHECK(std::distance(fs::directory_iterator(fs::path(file).parent_path()), {}) == 1);
        }
    }
}

SCENARIO("A read-only session runs pending edits for itself only", "[session][project]") {
    const std::string file = new_project();
    Session writer = Session::open(file, options());
    writer.apply("bump", small_bump());
    writer.change_edit(1, {{"levels", std::int64_t{3}}});
    Session reader = Session::open(file, options());
    CHECK(reader.log()[1].status == EditStatus::Pending);
    CHECK(surface_of(reader.scene()).triangle_count() == 1280);
    CHECK(reader.log()[1].status == EditStatus::Done);
    CHECK(reader.log()[1].result->change.moved_vertices > 0);
    CHECK(writer.log()[1].status == EditStatus::Pending);
    CHECK(writer.scene().surface->points() == reader.scene().surface->points());
    CHECK(reader.replay()[0].replayed);
}

SCENARIO("A session without a file becomes a project", "[session][project]") {
    const std::string file = test::temporary_folder() + "/case.vbench";
    Session session = Session::unsaved(options());
    session.apply("make-sphere", {});
    session.save_as(file);
    Session saved = Session::open(file, options());
    CHECK(saved.read_only_reason().empty());
    CHECK(saved.scene().surface->points() == session.scene().surface->points());
}

SCENARIO("A project of a newer version is refused", "[session][project]") {
    const std::string file = new_project();
    run_sql(file,
            "PRAGMA user_version = 7; UPDATE meta SET value = '9.9.9' WHERE name = 'written by'");
    const std::string text = error_of<InvalidInput>([&] { (void)Session::open(file, options()); });
    CHECK(text.find("version 7") != std::string::npos);
    CHECK(text.find("9.9.9") != std::string::npos);
    CHECK(text.find("version 2") != std::string::npos);
}

SCENARIO("A file that is not a project is rejected", "[session][project]") {
    const std::string folder = test::temporary_folder();
    CHECK_THROWS_AS(Session::open(folder + "/none.vbench", options()), IoError);
    CHECK_THROWS_AS(Session::open(folder, options()), InvalidInput);
    std::ofstream(folder + "/text.vbench") << std::string(5000, 'x');
    CHECK_THROWS_AS(Session::open(folder + "/text.vbench", options()), InvalidInput);
    std::ofstream(folder + "/empty.vbench").flush();
    CHECK_THROWS_AS(Session::open(folder + "/empty.vbench", options()), InvalidInput);
    run_sql(folder + "/other.vbench", "CREATE TABLE a(b)");
    CHECK_THROWS_AS(Session::open(folder + "/other.vbench", options()), InvalidInput);
    THEN("a cut project too") {
        const std::string file = new_project();
        fs::resize_file(file, fs::file_size(file) / 2);
        CHECK_THROWS_AS(Session::open(file, options()).scene(), InvalidInput);
    }
}

SCENARIO("Damaged data is noticed", "[session][project]") {
    const std::string file = new_project();
    run_sql(file, "UPDATE blobs SET content = zeroblob(length(content)) WHERE id = 2");
    Session session = Session::open(file, options());
    CHECK(session.log().size() == 1);
    CHECK_THROWS_AS(session.scene(), InvalidInput);
    THEN("also where the history is") {
        run_sql(file, "UPDATE states SET parent = 9 WHERE id = 1");
        CHECK_THROWS_AS(Session::open(file, options()), InvalidInput);
    }
}

SCENARIO("A folder that cannot be written", "[session][project]") {
    const std::string file = new_project();
    const fs::path folder = fs::path(file).parent_path();
    fs::permissions(folder, fs::perms::owner_all | fs::perms::group_read | fs::perms::group_exec |
                                fs::perms::others_read | fs::perms::others_exec);
    fs::permissions(folder, fs::perms::owner_write, fs::perm_options::remove);
    {
        const WithoutRights nobody;
        CHECK_THROWS_AS(Session::create(folder / "new.vbench", options()), IoError);
        Session session = Session::open(file, options());
        CHECK_FALSE(session.read_only_reason().empty());
        CHECK(session.log().size() == 1);
        CHECK(surface_of(session.scene()).triangle_count() == 320);
        CHECK_THROWS_AS(session.apply("bump", small_bump()), IoError);
        CHECK_THROWS_AS(session.save_as(folder / "copy.vbench"), IoError);
    }
    fs::permissions(folder, fs::perms::owner_all);
    CHECK(std::distance(fs::directory_iterator(folder), {}) == 1);
}

SCENARIO("A full disk leaves the project as it was", "[session][project]") {
    const std::string file = new_project(4);
    Session session = Session::open(file, options());
    session.apply("bump", small_bump());
    auto full = std::make_optional<test::SmallFiles>(60000);
    const std::string text = error_of<IoError>([&] { session.apply("bump", small_bump(100.0)); });
    const std::string copy_text = error_of<IoError>([&] { session.save_as(file + ".copy"); });
    full.reset();
    CHECK(text.find("case.vbench") != std::string::npos);
    CHECK(copy_text.find("vbench") != std::string::npos);
    CHECK(std::distance(fs::directory_iterator(fs::path(file).parent_path()), {}) <= 4);
    CHECK_FALSE(fs::exists(file + ".copy"));
    CHECK(session.log().size() == 2);
    THEN("and with room again it goes on") {
        session.apply("bump", small_bump(100.0));
        for (const auto& entry : session.replay()) CHECK(entry.differences.empty());
    }
}

SCENARIO("The file alone is the project once its log is folded in", "[session][project]") {
    const std::string file = new_project(4);
    Session session = Session::open(file, options());
    session.apply("bump", small_bump(100.0));
    const auto edits_in_copy = [&] {
        const std::string copy = test::temporary_folder() + "/copy.vbench";
        fs::copy_file(file, copy);
        return Session::open(copy, options()).log().size();
    };
    CHECK(edits_in_copy() == 1);
    WHEN("there is room") {
        session.fold_log();
        CHECK(edits_in_copy() == 2);
    }
    WHEN("the file cannot grow") {
        auto full = std::make_optional<test::SmallFiles>(fs::file_size(file));
        const std::string text = error_of<IoError>([&] { session.fold_log(); });
        full.reset();
        CHECK(text.find("the last edits are in case.vbench-wal only: ") == 0);
        CHECK(session.log().size() == 2);
        session.fold_log();
        CHECK(edits_in_copy() == 2);
    }
}

SCENARIO("An edit takes at most 64 bytes per moved vertex and 16 KiB", "[session][project]") {
    const std::string file = new_project(5);
    const double reach = GENERATE(0.5, 3.0, 9.0, 100.0);
    const auto before = fs::file_size(file);
    std::size_t moved = 0;
    {
        Session session = Session::open(file, options());
        for (int i = 0; i < 5; ++i)
            moved += session.apply("bump", small_bump(reach)).result->change.moved_vertices;
    }
    const auto grown = fs::file_size(file) - before;
    CHECK(moved >= 5);
    CHECK(grown <= 64 * moved + 5 * 16384);
}

SCENARIO("A million triangles: undo reads no scene, and scenes share their topology",
         "[session][project]") {
    const std::string file = test::temporary_folder() + "/case.vbench";
    {
        Session session = Session::create(file, options());
        session.apply("make-sphere", {{"levels", std::int64_t{8}}});
        session.apply("bump", small_bump(0.2));
        session.apply("bump", small_bump(0.2));
    }
    {
        Session session = Session::open(file, options());
        session.undo();
    }
    Session session = Session::open(file, options());
    CHECK(session.log().size() == 2);
    const Scene after = session.scene(), before = session.scene_after(1);
    CHECK(surface_of(after).triangle_count() == 1310720);
    CHECK(after.surface->topology == before.surface->topology);
    CHECK(after.surface->positions != before.surface->positions);
}
