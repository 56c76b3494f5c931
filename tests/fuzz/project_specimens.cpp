#include "tests/fuzz/project_specimens.h"

#include <vector>

#include <sqlite3.h>

#include "geometry/formats/image_file.h"
#include "geometry/formats/surface_file.h"
#include "tests/forest/dice.h"
#include "tests/support/image_shapes.h"
#include "tests/support/scene_bits.h"
#include "tests/support/shapes.h"
#include "workbench/case/history.h"
#include "workbench/operations/table.h"
#include "workbench/project/stored_text.h"

namespace vesselbench::fuzz {

namespace {

namespace fs = std::filesystem;

void make_surface_project(const fs::path& file) {
    const std::string tube = test::temporary_folder() + "/tube.vtp";
    write_surface(test::closed_tube(2.0, 12.0, 12, 10), tube);
    Session session = Session::create(file, session_options());
    session.apply("load-surface", {{"file", tube}});
    session.apply("repair", {});
    session.apply("smooth", {{"iterations", std::int64_t{3}}});
    session.apply("brush-inflate", {{"at", Vec3(2, 0, 6)}, {"radius", 2.0}}, {.note = "a bump"});
    session.undo();
    session.apply("brush-weight", {{"at", Vec3(0, 2, 6)}, {"radius", 2.0}});
    session.apply("subdivide", {}, {.variant = "rp"});
    session.change_edit(3, {{"iterations", std::int64_t{5}}});
    (void)session.scene("rp");
    session.apply("tetrahedralize", {{"size", 2.0}});
}

void make_image_project(const fs::path& file) {
    const std::string image = test::temporary_folder() + "/ball.nrrd";
    write_image(image, test::ball_image(4.0, 12, Vec3::Ones()));
    Session session = Session::create(file, session_options());
    session.apply("load-image", {{"file", image}});
    session.apply("extract-surface", {});
    session.apply("repair", {});
}

void run_sql(sqlite3* database, const std::string& sql) {
    sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr);
}

struct Column {
    const char* table;
    const char* name;
};

constexpr Column kColumns[] = {
    {"meta", "value"},        {"edits", "edit"},       {"edits", "revision"},
    {"edits", "step"},        {"edits", "variant"},    {"edits", "operation"},
    {"edits", "author"},      {"edits", "time"},       {"edits", "note"},
    {"edits", "given"},       {"states", "id"},        {"states", "parent"},
    {"states", "change"},     {"states", "edit"},      {"states", "revision"},
    {"states", "last_child"}, {"results", "id"},       {"results", "edit"},
    {"results", "revision"},  {"results", "input"},    {"results", "stale"},
    {"results", "time"},      {"results", "duration"}, {"results", "version"},
    {"results", "device"},    {"results", "details"},  {"results", "scene"},
    {"sources", "parameter"}, {"sources", "name"},     {"sources", "hash"},
    {"sources", "place"}};

/// A statement that changes one cell or row.
std::string statement(forest::Dice& dice) {
    const Column& column = kColumns[dice.whole(0, static_cast<int>(std::size(kColumns)) - 1)];
    const std::string table = column.table, name = column.name;
    static const std::vector<std::string> values = {
        "-1",
        "0",
        "1",
        "2",
        "3",
        "9",
        "9223372036854775807",
        "-9223372036854775808",
        "1e308",
        "NULL",
        "''",
        "'x'",
        "'cfd'",
        "'../../etc/passwd'",
        "x'00'",
        "zeroblob(100)",
        "hex(zeroblob(3000))",
        "char(27) || '[31m'",
        name + " + 1",
        name + " - 1",
        "substr(" + name + ", 1, length(" + name + ") / 2)",
        "CAST(" + name + " AS BLOB) || x'00'",
        "CAST(" + name + " AS TEXT)"};
    const std::string value = values[dice.pick(std::vector<double>(values.size(), 1.0))];
    const std::string some =
        dice.chance(0.3) ? ""
                         : " WHERE abs(random()) % " + std::to_string(dice.whole(2, 5)) + " = 0";
    switch (dice.whole(0, 9)) {
        case 0:
            return "DELETE FROM " + table + some;
        case 1:
            return "UPDATE OR REPLACE " + table + " SET " + name + " = (SELECT " + name + " FROM " +
                   table + " ORDER BY 1 DESC LIMIT 1)" + some;
        case 2:
            return "UPDATE OR IGNORE blobs SET " + std::string(dice.chance(0.5) ? "base" : "hash") +
                   " = " + value + some;
        default:
            return "UPDATE OR IGNORE " + table + " SET " + name + " = " + value + some;
    }
}

}  // namespace

SessionOptions session_options() {
    SessionOptions options;
    options.author = "fuzz";
    options.find = find_operation;
    options.worker.time_limit = std::chrono::seconds(60);
    return options;
}

void write_project_specimens(const fs::path& folder) {
    make_surface_project(folder / "surface.vbench");
    make_image_project(folder / "image.vbench");
    for (const char* rest : {"surface.vbench-lock", "image.vbench-lock"}) fs::remove(folder / rest);
}

std::string content_of(const fs::path& project) {
    Session session = Session::open(project, session_options());
    std::string content;
    for (const LogEntry& entry : session.log())
        content += entry.edit.operation + " " + stored_text(entry.edit.given) + " " +
                   (entry.result ? stored_text(entry.result->resolved) : "") + "\n";
    for (const ReplayEntry& entry : session.replay())
        if (!entry.differences.empty()) return "";
    for (const std::string variant : {"cfd", "rp"})
        content += test::bits_of(session.scene(variant));
    const std::shared_ptr<const Snapshot> snapshot = session.snapshot();
    for (const auto& [id, state] : snapshot->history->states()) {
        (void)session.known_scene(id, "rp");
        session.jump(id);
    }
    return content;
}

void damage_rows(const fs::path& project, std::uint64_t seed) {
    forest::Dice dice(seed);
    sqlite3* database = nullptr;
    if (sqlite3_open(project.c_str(), &database) == SQLITE_OK)
        for (int left = dice.whole(1, 3); left > 0; --left) run_sql(database, statement(dice));
    sqlite3_close(database);
}

}  // namespace vesselbench::fuzz
