#include <filesystem>
#include <fstream>
#include <functional>
#include <new>
#include <random>

#include <catch2/catch.hpp>
#include <sqlite3.h>
#include <sys/resource.h>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/whole_file.h"
#include "tests/session/small_operations.h"
#include "tests/support/shapes.h"
#include "workbench/project/compression.h"
#include "workbench/project/database.h"
#include "workbench/project/file_lock.h"
#include "workbench/project/part_store.h"
#include "workbench/project/source_files.h"
#include "workbench/project/stored_text.h"
#include "workbench/session/session.h"

using namespace vesselbench;
using Catch::Matchers::Contains;

namespace {

namespace fs = std::filesystem;

SessionOptions options() {
    SessionOptions made;
    made.find = test::find_test_operation;
    return made;
}

std::string new_project() {
    const std::string file = test::temporary_folder() + "/case.vbench";
    Session session = Session::create(file, options());
    session.apply("make-sphere", {});
    return file;
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

/// [bytes] of this process's own data.
std::uint64_t data_memory() {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with("VmData:")) return std::stoull(line.substr(7)) * 1024;
    return 0;
}

/// The start of a zstd frame that announces a content of this size.
Bytes frame_announcing(std::uint64_t size) {
    ByteWriter writer;
    writer.put<std::uint32_t>(0xfd2fb528);
    writer.put<std::uint8_t>(0xe0);  // a single segment, its size in 8 bytes
    writer.put(size);
    writer.put<std::uint32_t>(1);  // an empty last block
    return writer.take();
}

}  // namespace

SCENARIO("A project with tables, triggers, views or indices of others is refused",
         "[session][hostile]") {
    for (const char* sql : {"CREATE TABLE more(a)", "CREATE VIEW more AS SELECT * FROM edits",
                            "CREATE TRIGGER more AFTER UPDATE ON meta BEGIN DELETE FROM edits; END",
                            "CREATE INDEX more ON edits(note)", "DROP TABLE sources",
                            "ALTER TABLE edits ADD COLUMN more TEXT"}) {
        INFO(sql);
        const std::string file = new_project();
        run_sql(file, sql);
        CHECK(error_of<InvalidInput>([&] { (void)Session::open(file, options()); }) !=
              "no such error");
    }
    const std::string copy = test::temporary_folder() + "/copy.vbench";
    Session::open(new_project(), options()).save_as(copy);
    CHECK_NOTHROW(Session::open(copy, options()));
}

SCENARIO("SQLite itself is restricted to rows", "[session][hostile]") {
    const Database database(new_project(), OpenMode::Write);
    const char* change = "PRAGMA writable_schema = ON; DELETE FROM sqlite_master";
    CHECK_THROWS_AS(database.run(change), InvalidInput);
    CHECK_THROWS_AS(database.run("SELECT load_extension('x')"), InvalidInput);
}

SCENARIO("Numbers and texts of a project beyond their range are refused", "[session][hostile]") {
    for (const char* sql : {"UPDATE edits SET step = 99", "UPDATE edits SET revision = -1",
                            "UPDATE edits SET variant = 'a b'", "UPDATE states SET change = 7",
                            "UPDATE results SET id = 9223372036854775807",
                            "UPDATE edits SET note = hex(zeroblob(1000000))",
                            "UPDATE edits SET operation = hex(zeroblob(200))"}) {
        INFO(sql);
        const std::string file = new_project();
        run_sql(file, sql);
        CHECK_THAT(error_of<InvalidInput>([&] { (void)Session::open(file, options()).snapshot(); }),
                   Contains("case.vbench is damaged"));
    }
}

SCENARIO("A compressed part must not announce more than it can hold", "[session][hostile]") {
    const Bytes zeros(std::size_t{1} << 20);
    CHECK(decompress(compress(zeros), zeros.size()) == zeros);
    for (const std::uint64_t size : {std::uint64_t{1} << 20U, std::uint64_t{1} << 40U,
                                     std::uint64_t{1} << 63U, ~std::uint64_t{0}}) {
        const Bytes frame = frame_announcing(size);
        CHECK_THROWS_AS(decompress(frame, size), InvalidInput);
    }
    CHECK_THROWS_AS(decompress(compress(zeros), 1000), InvalidInput);
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
SCENARIO("Reading a part takes at most twice the memory that it announces", "[session][hostile]") {
    constexpr std::size_t kPart = std::size_t{48} << 20U, kMargin = std::size_t{24} << 20U;
    const std::string file = test::temporary_folder() + "/parts.vbench";
    const BlobId id = [&] {
        // Numbers without a pattern take as much in the file as in memory.
        std::mt19937_64 random(1);
        auto values = std::make_shared<std::vector<double>>(kPart / sizeof(double));
        for (double& value : *values) value = static_cast<double>(random());
        const Database database(file, OpenMode::Create);
        PartStore::make_table(database);
        return PartStore(database, 0)
            .store(ScenePart(std::shared_ptr<const std::vector<double>>(values)), std::nullopt);
    }();
    const Database database(file, OpenMode::Read);
    PartStore store(database, 0);
    rlimit limit{};
    getrlimit(RLIMIT_DATA, &limit);
    const rlimit before = limit;
    limit.rlim_cur = data_memory() + 2 * kPart + kMargin;
    setrlimit(RLIMIT_DATA, &limit);
    std::size_t size = 0;
    try {
        size = memory_bytes(store.load(id));
    } catch (const std::bad_alloc&) {
    }
    setrlimit(RLIMIT_DATA, &before);
    CHECK(size == kPart);
}
#endif

SCENARIO("A small project must not announce more than a large one could hold",
         "[session][hostile]") {
    constexpr std::uint64_t kMiB = std::uint64_t{1} << 20U;
    CHECK_NOTHROW(require_plausible(1024 * kMiB, 1, 1024 * kMiB));
    CHECK_NOTHROW(require_plausible(4000 * kMiB, 5 * kMiB, 1024 * kMiB));
    CHECK_THROWS_WITH(require_plausible(4000 * kMiB, kMiB, 1024 * kMiB),
                      Contains("a file of 1048576 bytes announces"));
    GIVEN("a project whose reports are long runs of blanks") {
        const std::string file = new_project();
        {
            Session session = Session::open(file, options());
            session.apply("scale", {}, {.variant = "cfd"});
        }
        const Database database(file, OpenMode::Write);
        std::vector<std::pair<std::int64_t, Bytes>> details;
        for (auto row = database.prepare("SELECT id, details FROM results"); row.step();)
            details.emplace_back(row.integer(0),
                                 pack_text(unpack_text(row.blob(1)) + std::string(17 * kMiB, ' ')));
        REQUIRE(details.size() == 2);
        for (const auto& [id, text] : details)
            database.prepare("UPDATE results SET details = ? WHERE id = ?")
                .bind(0, std::span<const std::byte>(text))
                .bind(1, id)
                .step();
        CHECK_THAT(error_of<InvalidInput>([&] { (void)Session::open(file, options()).log(); }),
                   Contains("announces a content"));
    }
}

SCENARIO("A project's stored places stay inside its folder", "[session][hostile]") {
    const fs::path root = test::temporary_folder(), folder = root / "project";
    fs::create_directory(folder);
    fs::create_directory(root / "other");
    std::ofstream(root / "other/outside.txt") << "secret";
    std::ofstream(folder / "inside.txt") << "mine";
    const Operation& load = test::find_test_operation("load-sphere");

    const auto stored = [&](const fs::path& file) {
        return source_files(load, {{"file", file.string()}}, folder).front();
    };
    CHECK(stored(folder / "inside.txt").place == "inside.txt");
    CHECK(stored(root / "other/outside.txt").place.empty());

    SourceFile source = stored(root / "other/outside.txt");
    source.place = "../other/outside.txt";  // as a stranger may write it
    const Arguments given = {{"file", std::string("outside.txt")}};
    CHECK_THAT(error_of<IoError>(
                   [&] { (void)with_found_files(load, given, {source}, {.folder = folder}); }),
               Contains("outside the project's folder"));
    for (const char* name : {"/etc/passwd", "../outside.txt", ".."})
        CHECK_THROWS_AS(require_bare_files(load, {{"file", std::string(name)}}), InvalidInput);
    CHECK_NOTHROW(require_bare_files(load, given));
    THEN("a file beside the folder is found by its name and content") {
        std::ofstream(root / "outside.txt") << "secret";
        CHECK_NOTHROW(with_found_files(load, given, {source}, {.folder = folder}));
        std::ofstream(root / "outside.txt") << "another";
        CHECK_THAT(error_of<IoError>(
                       [&] { (void)with_found_files(load, given, {source}, {.folder = folder}); }),
                   Contains("has changed"));
    }
}

SCENARIO("A folder of slices does not leave its name in the project", "[session][hostile]") {
    const fs::path folder = fs::path(test::temporary_folder()) / "Doe_Jane";
    fs::create_directory(folder);
    std::ofstream(folder / "slice.dcm") << "pixels";
    const Operation& load = test::find_test_operation("load-sphere");
    const Arguments given = {{"file", folder.string()}};
    const Arguments stored = without_folders(load, given);
    CHECK(stored.text("file") == "dicom-slices");
    const SourceFile source = source_files(load, given, folder.parent_path()).front();
    CHECK(source.name == "dicom-slices");
    CHECK(source.place.empty());
    fs::rename(folder, folder.parent_path() / "dicom-slices");
    const Arguments found =
        with_found_files(load, stored, {source}, {.folder = folder.parent_path()});
    CHECK(found.text("file") == (folder.parent_path() / "dicom-slices").string());
}

SCENARIO("The lock is never written through a link", "[session][hostile]") {
    const std::string file = new_project();
    const fs::path victim = fs::path(file).parent_path() / "victim.txt", lock = file + "-lock";
    std::ofstream(victim) << "precious";
    WHEN("it is a symbolic link") {
        fs::create_symlink(victim, lock);
    }
    WHEN("it is another name of a file") {
        fs::create_hard_link(victim, lock);
    }
    if (!fs::exists(lock)) return;
    const Session session = Session::open(file, options());
    CHECK_THAT(session.read_only_reason(), Contains("case.vbench-lock"));
    CHECK(file_content(victim) == "precious");
}

SCENARIO("A project that is deleted while it is open loses no edit silently",
         "[session][hostile]") {
    const std::string file = new_project();
    Session session = Session::open(file, options());
    WHEN("it is deleted") {
        fs::remove(file);
    }
    WHEN("it is replaced") {
        fs::copy(file, file + ".copy");
        fs::rename(file + ".copy", file);
    }
    if (fs::exists(file) && !fs::exists(file + "-wal")) return;
    CHECK_THAT(error_of<IoError>([&] { (void)session.apply("scale", {}, {.variant = "cfd"}); }),
               Contains("deleted, moved or replaced"));
    CHECK(session.log().size() == 1);
}
