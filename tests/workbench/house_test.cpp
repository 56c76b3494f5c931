#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/support/paths.h"
#include "tests/workbench/room_table.h"

namespace fs = std::filesystem;
using vesselbench::test::is_below;
using vesselbench::test::read_cmake_lists;
using vesselbench::test::RoomTable;
using vesselbench::test::source_folder;

namespace {

using Names = std::set<std::string>;

const Names kFolders = {"geometry", "smoothing", "gpu", "meshing", "workbench"};

// Headers whose functions generated sources define, or one source per command.
const Names kDeclareWithoutSource = {
    "geometry/vessel/ends/end_weights.h",   "gpu/shader_texts.h",
    "workbench/batch/page_texts.h",         "workbench/phantoms/builtin.h",
    "workbench/prepare/builtin_recipes.h",  "workbench/report/label_font.h",
    "workbench/report/report_template.h",   "workbench/review/audit_template.h",
    "workbench/review/review_page_bytes.h", "workbench/window/style/embedded_fonts.h",
    "workbench/commands/commands.h"};

// Units that still need each other: a list that only shrinks.
const std::set<Names> kUnitsInCircles = {
    {"geometry/vessel/openings/end_opener", "geometry/vessel/openings/named_ends",
     "geometry/vessel/openings/openings", "geometry/vessel/openings/plan_draft",
     "geometry/vessel/openings/rim_and_cap_places"},
    {"gpu/compute", "gpu/device", "gpu/device_store", "gpu/device_topology"},
    {"workbench/case/checked_arguments", "workbench/case/operation"}};

struct Include {
    std::string name;  ///< as written
    bool quoted = false;
};

struct SourceFile {
    std::string text;
    std::vector<Include> includes;
};

bool is_source(const fs::path& file) {
    static const Names suffixes = {".h", ".hpp", ".inc", ".cpp", ".cc", ".cu"};
    return suffixes.contains(file.extension().string());
}

bool is_header(const std::string& file) {
    return file.ends_with(".h") || file.ends_with(".inc");
}

std::string text_of(const fs::path& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<Include> includes_in(const std::string& text) {
    static const std::regex pattern(
        R"re((?:^|\n)[ \t]*#[ \t]*include[ \t]*(["<])([^">\n]+)[">])re");
    std::vector<Include> includes;
    for (std::sregex_iterator i(text.begin(), text.end(), pattern), end; i != end; ++i)
        includes.push_back({(*i)[2], (*i)[1] == "\""});
    return includes;
}

/// Files below our folders by their paths in the repository, without installed and built ones.
const Names& house_files() {
    static const auto files = [] {
        const fs::path root = source_folder();
        Names all;
        for (const std::string& folder : kFolders)
            for (fs::recursive_directory_iterator i(root / folder), end; i != end; ++i) {
                const std::string name = i->path().filename().string();
                if (name == "build" || name == "node_modules") i.disable_recursion_pending();
                if (i->is_regular_file()) all.insert(fs::relative(i->path(), root).string());
            }
        return all;
    }();
    return files;
}

/// All our code by its path in the repository.
const std::map<std::string, SourceFile>& house() {
    static const auto sources = [] {
        std::map<std::string, SourceFile> all;
        for (const std::string& file : house_files())
            if (is_source(file)) {
                const std::string text = text_of(fs::path(source_folder()) / file);
                all[file] = {text, includes_in(text)};
            }
        return all;
    }();
    return sources;
}

/// What all CMakeLists.txt of the house declare.
const RoomTable& table() {
    static const auto read = [] {
        RoomTable all;
        for (const std::string& file : house_files())
            if (fs::path(file).filename() == "CMakeLists.txt")
                read_cmake_lists(fs::path(file).parent_path().string(),
                                 text_of(fs::path(source_folder()) / file), house_files(), all);
        return all;
    }();
    return read;
}

/// Empty if the file is in none.
std::string room_of(const std::string& path) {
    std::string room;
    for (const auto& [name, declared] : table().rooms)
        if (is_below(path, name) && name.size() > room.size()) room = name;
    return room;
}

bool may_use(const std::string& room, const std::string& other) {
    return room == other ||
           std::ranges::any_of(table().rooms.at(room).doors,
                               [&](const std::string& door) { return is_below(other, door); });
}

/// Names that lead back to themselves via `next`, and those that lead to them.
Names circles(std::map<std::string, Names> next) {
    const auto leads_nowhere = [&](const auto& entry) {
        return std::ranges::none_of(entry.second,
                                    [&](const std::string& name) { return next.contains(name); });
    };
    for (std::size_t before = 0; before != next.size();) {
        before = next.size();
        Names done;
        for (const auto& entry : next)
            if (leads_nowhere(entry)) done.insert(entry.first);
        for (const std::string& name : done) next.erase(name);
    }
    Names left;
    for (const auto& [name, followers] : next) left.insert(name);
    return left;
}

/// What a name leads to via `next`, over any number of steps.
Names reached_from(const std::string& start, const std::map<std::string, Names>& next) {
    Names reached;
    std::vector<std::string> open = {start};
    while (!open.empty()) {
        const auto followers = next.find(open.back());
        open.pop_back();
        if (followers == next.end()) continue;
        for (const std::string& name : followers->second)
            if (reached.insert(name).second) open.push_back(name);
    }
    return reached;
}

/// Groups of names that all lead to each other.
std::set<Names> groups_in_circles(const std::map<std::string, Names>& next) {
    std::map<std::string, Names> reached;
    for (const std::string& name : circles(next)) reached[name] = reached_from(name, next);
    std::set<Names> groups;
    for (const auto& [name, all] : reached) {
        if (!all.contains(name)) continue;
        Names group;
        for (const std::string& other : all)
            if (reached.contains(other) && reached.at(other).contains(name)) group.insert(other);
        groups.insert(group);
    }
    return groups;
}

/// A header and its source are one unit.
std::string unit_of(const std::string& file) {
    return file.substr(0, file.rfind('.'));
}

bool is_large_library(const std::string& name) {
    return name.starts_with("vtk") || name.starts_with("CGAL/") || name.starts_with("OpenMesh/") ||
           name == "tetgen.h" || name.starts_with("gdcm") || name.starts_with("epoxy/") ||
           name.starts_with("EGL/") || name.starts_with("itk") || name.starts_with("imgui") ||
           name.starts_with("GLFW/") || name.starts_with("backends/imgui");
}

bool may_use_vtk(const std::string& file) {
    const std::string room = room_of(file);
    return room == "geometry/formats" || room == "geometry/image";
}

/// An operation is registered in operations/table.h, a command is declared in commands.h, what
/// looks for faults in findings/detectors.h.
bool is_declared_in_a_table(const std::string& source) {
    const fs::path path = source;
    if (path.parent_path() == "workbench/commands") return true;
    if (path.parent_path() == "workbench/findings") return source.ends_with("_faults.cpp");
    if (path.parent_path() != "workbench/operations") return false;
    const std::regex name("\\b" + path.stem().string() + "(_\\w+)?\\b");
    return std::regex_search(house().at("workbench/operations/table.h").text, name);
}

/// Functions that a header declares at namespace scope and leaves to a source file.
std::vector<std::string> functions_left_to_a_source(const std::string& text) {
    static const std::regex comment("//[^\n]*");
    static const std::regex declaration(
        R"re((^|\n)(?!using|template|inline|constexpr|friend|public:|private:|protected:|static_assert|#|\}))re"
        R"re([A-Za-z\[][^;{}()]*\([^;{]*;)re");
    const std::string code = std::regex_replace(text, comment, "");
    std::vector<std::string> found;
    for (std::sregex_iterator i(code.begin(), code.end(), declaration), end; i != end; ++i)
        found.push_back(i->str());
    return found;
}

/// The folder of the CMakeLists.txt that is responsible for a folder.
std::string folder_with_cmake_lists(fs::path folder) {
    while (!folder.empty() && !house_files().contains((folder / "CMakeLists.txt").string()))
        folder = folder.parent_path();
    return folder.string();
}

/// Rooms of the sources of a target; none: a bundle of other targets.
const Names& rooms_of(const std::string& target) {
    static const auto rooms = [] {
        std::map<std::string, Names> all;
        for (const auto& [name, declared] : table().targets) {
            Names& its = all[name];
            for (const std::string& source : declared.sources) its.insert(room_of(source));
        }
        return all;
    }();
    return rooms.at(target);
}

/// Rooms whose code a target can call: its own and those it links, directly or through others.
Names linked_rooms(const std::string& target) {
    Names rooms = rooms_of(target);
    for (const std::string& link : table().targets.at(target).links)
        rooms.merge(linked_rooms(link));
    return rooms;
}

bool may_link(const std::string& target, const std::string& other) {
    const Names& to = rooms_of(other);
    const auto may_use_it = [&](const std::string& room) {
        return std::ranges::any_of(to, [&](const auto& used) { return may_use(room, used); });
    };
    return to.empty() || rooms_of(target).empty() ||
           std::ranges::any_of(rooms_of(target), may_use_it);
}

}  // namespace

SCENARIO("The rooms are folders with code, declared in their CMakeLists.txt",
         "[workbench][house]") {
    Names with_code;
    for (const auto& [file, source] : house()) with_code.insert(room_of(file));
    std::size_t doors = 0;
    for (const auto& [name, room] : table().rooms) {
        INFO(name << " in " << room.declared_in << "/CMakeLists.txt");
        CHECK(fs::is_directory(fs::path(source_folder()) / name));
        CHECK(with_code.contains(name));
        CHECK(room.declared_in == folder_with_cmake_lists(name));
        doors += room.doors.size();
    }
    CHECK(table().rooms.size() > 60);
    CHECK(doors > 400);
}

SCENARIO("A CMakeLists.txt is read as CMake reads it, or refused", "[workbench][house]") {
    const Names files = {"a/b/one.cpp", "a/b/two.cpp", "a/c/d/three.cpp", "a/c/four.cpp"};
    const auto read = [&](const std::string& text) {
        RoomTable all;
        read_cmake_lists("a", text, files, all);
        return all;
    };
    CHECK(read("# room(a/x)\nroom(a/b)\nroom(a/c USES  # all\n  a/b\n  z)").rooms.at("a/c").doors ==
          Names{"a/b", "z"});
    CHECK(read("# room(a/x)").rooms.empty());
    CHECK_THROWS_WITH(read("room(a/c a/b)"), Catch::Contains("it is not room(NAME USES ...)"));
    CHECK_THROWS_WITH(read("room(a/b) room(a/b)"), Catch::Contains("there is such a room"));

    const auto sources = [&](const std::string& text) {
        return read(text).targets.begin()->second.sources;
    };
    CHECK(sources("vesselbench_library(b)") == Names{"a/b/one.cpp", "a/b/two.cpp"});
    CHECK(sources("vesselbench_library(b WITHOUT b/two.cpp)") == Names{"a/b/one.cpp"});
    CHECK(sources("vesselbench_library(b SOURCES b/two.cpp ${X}/three.cpp)") ==
          Names{"a/b/two.cpp"});
    CHECK(sources("vesselbench_library(x FOLDERS . SOURCES ${X}/three.cpp)") == files);
    CHECK(sources("sources_below(S b c)\nlist(FILTER S EXCLUDE REGEX \"^c/d/\")\n"
                  "add_executable(x ${S})") == Names{"a/b/one.cpp", "a/b/two.cpp", "a/c/four.cpp"});
    CHECK_THROWS_WITH(read("vesselbench_library(b b/one.cpp)"), Catch::Contains("keyword"));
    CHECK_THROWS_WITH(read("sources_below(S b) list(APPEND S c/four.cpp)"),
                      Catch::Contains("only FILTER"));
    CHECK_THROWS_WITH(read("add_executable(x ${S})"), Catch::Contains("${S}"));

    const auto linked = read(
        "vesselbench_library(b PUBLIC vb_c Eigen3::Eigen PRIVATE vb_d)\n"
        "add_library(vb_all INTERFACE)\n"
        "target_link_libraries(vb_all INTERFACE vb_b vb_c)");
    CHECK(linked.targets.at("vb_b").links == Names{"vb_c", "vb_d"});
    CHECK(linked.targets.at("vb_all").links == Names{"vb_b", "vb_c"});
    CHECK(linked.targets.at("vb_all").sources == Names{});
}

SCENARIO("The table of rooms has no circle", "[workbench][house]") {
    std::map<std::string, Names> next;
    for (const auto& [room, declared] : table().rooms)
        for (const auto& [other, ignored] : table().rooms)
            if (room != other && may_use(room, other)) next[room].insert(other);
    CHECK(circles(next) == Names{});
    CHECK(circles({{"a", {"b"}}, {"b", {"a"}}, {"c", {}}}) == Names{"a", "b"});
}

SCENARIO("Every include goes through a door", "[workbench][house]") {
    for (const auto& [file, source] : house()) {
        const std::string room = room_of(file);
        INFO(file << " of room '" << room << "'");
        REQUIRE_FALSE(room.empty());
        for (const Include& include : source.includes) {
            if (!include.quoted) continue;
            INFO("includes \"" << include.name << "\"");
            REQUIRE(house().contains(include.name));
            CHECK(may_use(room, room_of(include.name)));
        }
    }
}

SCENARIO("Every door is used by an include", "[workbench][house]") {
    std::map<std::string, Names> used;
    for (const auto& [file, source] : house())
        for (const Include& include : source.includes)
            if (include.quoted) used[room_of(file)].insert(room_of(include.name));
    for (const auto& [room, declared] : table().rooms)
        for (const std::string& door : declared.doors) {
            INFO(room << " may use " << door);
            CHECK(std::ranges::any_of(
                used[room], [&](const std::string& other) { return is_below(other, door); }));
        }
}

SCENARIO("No files include each other in a circle", "[workbench][house]") {
    std::map<std::string, Names> next;
    for (const auto& [file, source] : house())
        for (const Include& include : source.includes) next[file].insert(include.name);
    CHECK(circles(next) == Names{});
}

SCENARIO("No units need each other in a circle", "[workbench][house]") {
    std::map<std::string, Names> next;
    for (const auto& [file, source] : house())
        for (const Include& include : source.includes)
            if (include.quoted && unit_of(file) != unit_of(include.name))
                next[unit_of(file)].insert(unit_of(include.name));
    CHECK(groups_in_circles(next) == kUnitsInCircles);
    CHECK(groups_in_circles({{"a", {"b"}}, {"b", {"a", "d"}}, {"c", {"a"}}, {"d", {}}}) ==
          std::set<Names>{{"a", "b"}});
}

SCENARIO("A header's code is in the source file of the same name", "[workbench][house]") {
    Names without_header, without_source;
    for (const auto& [file, source] : house()) {
        const std::string stem = file.substr(0, file.rfind('.'));
        if (file.ends_with(".cpp") && !house().contains(stem + ".h") &&
            !is_declared_in_a_table(file))
            without_header.insert(file);
        if (file.ends_with(".h") && !house().contains(stem + ".cpp") &&
            !kDeclareWithoutSource.contains(file) &&
            !functions_left_to_a_source(source.text).empty())
            without_source.insert(file);
    }
    CHECK(without_header == Names{});
    CHECK(without_source == Names{});
    CHECK(functions_left_to_a_source("inline int f() {}\nint two(\n  int);\nstruct A { int g(); };")
              .size() == 1);
}

SCENARIO("No other folder at the top holds code", "[workbench][house]") {
    for (const auto& entry : fs::directory_iterator(source_folder())) {
        const std::string name = entry.path().filename().string();
        const bool ours = kFolders.contains(name) || name == "tests";
        if (!entry.is_directory() || ours || name == "build" || name == "out" || name[0] == '.')
            continue;
        for (const auto& inside : fs::recursive_directory_iterator(entry.path())) {
            INFO(inside.path());
            CHECK_FALSE(is_source(inside.path()));
        }
    }
}

SCENARIO("Large libraries stop at the source files", "[workbench][house]") {
    for (const auto& [file, source] : house())
        for (const Include& include : source.includes) {
            INFO(file << " includes " << include.name);
            CHECK_FALSE((is_header(file) && is_large_library(include.name)));
            if (include.name.starts_with("vtk")) CHECK(may_use_vtk(file));
            CHECK(include.name != "vtkSMPTools.h");  // no C++20 with g++ 12
        }
}

SCENARIO("Every source is compiled into one target", "[workbench][house]") {
    std::map<std::string, int> compiled;
    for (const auto& [name, target] : table().targets)
        for (const std::string& source : target.sources) ++compiled[source];
    for (const auto& [file, source] : house()) {
        if (!file.ends_with(".cpp")) continue;
        INFO(file);
        CHECK(compiled[file] == 1);
    }
}

SCENARIO("The targets link the rooms that their doors name", "[workbench][house]") {
    CHECK(table().targets.size() > 20);
    std::map<std::string, Names> linked;  // by room, and by source: with its target alone
    for (const auto& [name, target] : table().targets) {
        const Names rooms = linked_rooms(name);
        for (const std::string& source : target.sources) {
            linked[room_of(source)].insert(rooms.begin(), rooms.end());
            linked[source] = rooms;
        }
        for (const std::string& link : target.links) {
            INFO(name << " links " << link);
            CHECK(may_link(name, link));
        }
    }
    for (const auto& [file, source] : house())
        for (const Include& include : source.includes) {
            if (!include.quoted) continue;
            INFO(file << " includes " << include.name);
            CHECK(linked[is_header(file) ? room_of(file) : file].contains(room_of(include.name)));
        }
}
