#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/support/paths.h"

namespace fs = std::filesystem;
using vesselbench::test::source_folder;

namespace {

using Names = std::set<std::string>;

// The rooms and the rooms each may include besides itself; the drawing is in
// docs/dev/architecture.md. A file belongs to the room of its longest prefix; "geometry" on the
// right means all rooms there.
const std::map<std::string, Names> kDoors = {
    {"geometry/kernel", {}},
    {"geometry/image", {"geometry/kernel"}},
    {"geometry/vessel/centerlines", {"geometry/kernel"}},
    {"geometry/editing", {"geometry/kernel"}},
    {"geometry/vessel/artefacts", {"geometry/kernel", "geometry/vessel/centerlines"}},
    {"geometry/vessel/ends",
     {"geometry/kernel", "geometry/editing", "geometry/vessel/centerlines"}},
    {"geometry/vessel/openings",
     {"geometry/kernel", "geometry/editing", "geometry/vessel/centerlines",
      "geometry/vessel/ends"}},
    {"geometry/vessel/narrowing",
     {"geometry/kernel", "geometry/image", "geometry/vessel/centerlines",
      "geometry/vessel/openings"}},
    {"geometry/vessel/posing", {"geometry/kernel", "geometry/vessel/centerlines"}},
    {"geometry/vessel/repair", {"geometry/kernel", "geometry/editing"}},
    {"geometry/formats", {"geometry/kernel", "geometry/image", "geometry/vessel"}},
    {"geometry/phantoms", {"geometry/kernel", "geometry/image"}},
    {"smoothing/filters", {"geometry/kernel"}},
    {"smoothing/context", {"geometry/kernel"}},
    {"smoothing/brush", {"geometry/kernel", "smoothing/filters"}},
    {"smoothing/quality", {"geometry/kernel", "smoothing/filters"}},
    {"gpu", {"geometry/kernel", "smoothing/filters", "smoothing/context", "smoothing/quality"}},
    {"meshing/remeshing", {"geometry/kernel", "geometry/editing", "geometry/vessel"}},
    {"meshing/stamp",
     {"geometry/kernel", "geometry/editing", "geometry/vessel", "meshing/remeshing"}},
    {"meshing/tetrahedra", {"geometry/kernel"}},
    {"meshing/products", {"geometry/kernel", "geometry/formats", "meshing/tetrahedra"}},
    {"workbench/case", {"geometry/kernel", "geometry/image", "meshing/tetrahedra"}},
    {"workbench/project", {"geometry/kernel", "workbench/case"}},
    {"workbench/worker", {"geometry/kernel", "workbench/case", "workbench/project"}},
    {"workbench/session",
     {"geometry/kernel", "workbench/case", "workbench/project", "workbench/worker"}},
    {"workbench/operations",
     {"geometry", "smoothing", "gpu", "meshing", "workbench/case", "workbench/worker"}},
    {"workbench/phantoms", {"geometry/kernel", "geometry/phantoms", "workbench/case"}},
    {"workbench/report",
     {"geometry/kernel", "smoothing/quality", "gpu", "workbench/case", "workbench/session"}},
    {"workbench/colours",
     {"geometry/kernel", "geometry/vessel/centerlines", "smoothing/context", "meshing/tetrahedra",
      "workbench/case", "workbench/operations", "workbench/report"}},
    {"workbench/findings",
     {"geometry/kernel", "geometry/editing", "geometry/vessel", "smoothing/context",
      "meshing/products", "workbench/case", "workbench/project", "workbench/session",
      "workbench/operations"}},
    {"workbench/review",
     {"geometry/kernel", "geometry/image", "geometry/formats", "gpu", "workbench/case",
      "workbench/project", "workbench/worker", "workbench/session", "workbench/report",
      "workbench/colours", "workbench/findings"}},
    {"workbench/export",
     {"geometry/kernel", "geometry/formats", "meshing/products", "workbench/case",
      "workbench/report", "workbench/colours", "workbench/review"}},
    {"workbench/prepare",
     {"geometry", "meshing/products", "workbench/case", "workbench/session", "workbench/operations",
      "workbench/findings", "workbench/export", "workbench/report", "workbench/review",
      "workbench/phantoms"}},
    {"workbench/batch",
     {"geometry/kernel", "geometry/formats", "workbench/case", "workbench/project",
      "workbench/worker", "workbench/session", "workbench/operations", "workbench/export",
      "workbench/report", "workbench/review", "workbench/prepare"}},
    {"workbench/suggest",
     {"geometry/kernel", "smoothing/quality", "workbench/case", "workbench/project",
      "workbench/worker", "workbench/session", "workbench/operations"}},
    {"workbench/window/style", {}},
    {"workbench/window/keys", {}},
    {"workbench/window/widgets", {"workbench/window/style"}},
    {"workbench/window/case",
     {"geometry/kernel", "geometry/vessel/centerlines", "smoothing/brush", "workbench/case",
      "workbench/session", "workbench/operations", "workbench/export", "workbench/report",
      "workbench/review", "workbench/prepare"}},
    {"workbench/window/form",
     {"geometry/kernel", "geometry/image", "workbench/case", "workbench/session",
      "workbench/operations", "workbench/prepare", "workbench/window/case"}},
    {"workbench/window/drawing",
     {"geometry/kernel", "gpu", "workbench/case", "workbench/session", "workbench/colours",
      "workbench/window/widgets", "workbench/window/case"}},
    {"workbench/window/core",
     {"geometry/kernel", "workbench/case", "workbench/session", "workbench/operations",
      "workbench/prepare", "workbench/window/keys", "workbench/window/widgets",
      "workbench/window/case", "workbench/window/form", "workbench/window/drawing"}},
    {"workbench/window/features/borders", {"workbench/window/widgets", "workbench/window/core"}},
    {"workbench/window/features/brush",
     {"geometry/kernel", "gpu", "workbench/case", "workbench/operations",
      "workbench/window/widgets", "workbench/window/case", "workbench/window/form",
      "workbench/window/drawing", "workbench/window/core"}},
    {"workbench/window/features/compare",
     {"geometry/kernel", "gpu", "workbench/session", "workbench/report", "workbench/window/style",
      "workbench/window/widgets", "workbench/window/case", "workbench/window/drawing",
      "workbench/window/core"}},
    {"workbench/window/features/openings",
     {"geometry/kernel", "geometry/vessel/centerlines", "geometry/vessel/ends",
      "geometry/vessel/openings", "workbench/case", "workbench/session", "workbench/operations",
      "workbench/window/style", "workbench/window/keys", "workbench/window/widgets",
      "workbench/window/case", "workbench/window/form", "workbench/window/drawing",
      "workbench/window/core"}},
    {"workbench/window/features/picture",
     {"geometry/kernel", "gpu", "workbench/session", "workbench/window/widgets",
      "workbench/window/case", "workbench/window/drawing", "workbench/window/core"}},
    {"workbench/window/features/handles",
     {"geometry/kernel", "geometry/image", "geometry/vessel/centerlines",
      "geometry/vessel/openings", "geometry/vessel/posing", "workbench/case", "workbench/session",
      "workbench/operations", "workbench/window/widgets", "workbench/window/form",
      "workbench/window/drawing", "workbench/window/core", "workbench/window/features/openings"}},
    {"workbench/window/features/history",
     {"geometry/kernel", "gpu", "meshing/remeshing", "workbench/session", "workbench/window/style",
      "workbench/window/widgets", "workbench/window/case", "workbench/window/core",
      "workbench/window/features/compare"}},
    {"workbench/window/features/live",
     {"geometry/kernel", "smoothing/context", "workbench/case", "workbench/operations",
      "workbench/colours", "workbench/window/style", "workbench/window/widgets",
      "workbench/window/case", "workbench/window/form", "workbench/window/drawing",
      "workbench/window/core", "workbench/window/features/compare"}},
    {"workbench/window/features/picking",
     {"geometry/kernel", "gpu", "workbench/window/widgets", "workbench/window/form",
      "workbench/window/drawing", "workbench/window/core", "workbench/window/features/brush",
      "workbench/window/features/openings"}},
    {"workbench/window/features/colours",
     {"geometry/kernel", "geometry/vessel/centerlines", "workbench/session", "workbench/colours",
      "workbench/window/case", "workbench/window/drawing", "workbench/window/core",
      "workbench/window/features/live"}},
    {"workbench/window/features/findings",
     {"geometry/kernel", "workbench/case", "workbench/session", "workbench/operations",
      "workbench/findings", "workbench/window/style", "workbench/window/widgets",
      "workbench/window/case", "workbench/window/core"}},
    {"workbench/window/features/gallery",
     {"geometry/kernel", "gpu", "workbench/case", "workbench/session", "workbench/suggest",
      "workbench/window/style", "workbench/window/keys", "workbench/window/widgets",
      "workbench/window/case", "workbench/window/drawing", "workbench/window/core",
      "workbench/window/features/live", "workbench/window/features/picking"}},
    {"workbench/window/features/clip",
     {"geometry/kernel", "gpu", "meshing/tetrahedra", "workbench/session", "workbench/colours",
      "workbench/window/style", "workbench/window/widgets", "workbench/window/drawing",
      "workbench/window/core", "workbench/window/features/colours"}},
    {"workbench/window/features/flight",
     {"geometry/kernel", "geometry/vessel/centerlines", "gpu", "workbench/window/style",
      "workbench/window/keys", "workbench/window/widgets", "workbench/window/drawing",
      "workbench/window/core", "workbench/window/features/colours"}},
    {"workbench/window/features/measures",
     {"geometry/kernel", "geometry/vessel/centerlines", "workbench/session", "workbench/report",
      "workbench/window/style", "workbench/window/widgets", "workbench/window/case",
      "workbench/window/drawing", "workbench/window/core", "workbench/window/features/live",
      "workbench/window/features/picking", "workbench/window/features/colours"}},
    {"workbench/window/features/quality",
     {"geometry/kernel", "workbench/report", "workbench/suggest", "workbench/window/widgets",
      "workbench/window/case", "workbench/window/form", "workbench/window/core",
      "workbench/window/features/live", "workbench/window/features/gallery"}},
    {"workbench/window/features/review",
     {"geometry/kernel", "workbench/operations", "workbench/review", "workbench/window/style",
      "workbench/window/keys", "workbench/window/widgets", "workbench/window/case",
      "workbench/window/drawing", "workbench/window/core", "workbench/window/features/compare",
      "workbench/window/features/picking"}},
    {"workbench/window/features/slices",
     {"geometry/kernel", "geometry/image", "gpu", "workbench/case", "workbench/session",
      "workbench/window/style", "workbench/window/widgets", "workbench/window/case",
      "workbench/window/form", "workbench/window/drawing", "workbench/window/core",
      "workbench/window/features/handles", "workbench/window/features/measures",
      "workbench/window/features/review"}},
    {"workbench/window/features/extraction",
     {"geometry/kernel", "workbench/operations", "workbench/window/style",
      "workbench/window/widgets", "workbench/window/case", "workbench/window/form",
      "workbench/window/core", "workbench/window/features/live",
      "workbench/window/features/slices"}},
    {"workbench/window/workplace",
     {"workbench/window/core", "workbench/window/features/brush",
      "workbench/window/features/compare", "workbench/window/features/openings",
      "workbench/window/features/picture", "workbench/window/features/handles",
      "workbench/window/features/history", "workbench/window/features/live",
      "workbench/window/features/colours", "workbench/window/features/gallery",
      "workbench/window/features/measures", "workbench/window/features/quality",
      "workbench/window/features/review", "workbench/window/features/slices",
      "workbench/window/features/findings", "workbench/window/features/extraction"}},
    {"workbench/window/fields",
     {"geometry/kernel", "gpu", "workbench/window/style", "workbench/window/widgets",
      "workbench/window/case", "workbench/window/form", "workbench/window/core"}},
    {"workbench/window/panels",
     {"geometry/kernel",
      "geometry/formats",
      "workbench/case",
      "workbench/session",
      "workbench/operations",
      "workbench/prepare",
      "workbench/export",
      "workbench/phantoms",
      "workbench/window/style",
      "workbench/window/keys",
      "workbench/window/widgets",
      "workbench/window/case",
      "workbench/window/form",
      "workbench/window/drawing",
      "workbench/window/core",
      "workbench/window/features/brush",
      "workbench/window/features/compare",
      "workbench/window/features/openings",
      "workbench/window/features/handles",
      "workbench/window/features/history",
      "workbench/window/features/colours",
      "workbench/window/features/findings",
      "workbench/window/features/gallery",
      "workbench/window/features/measures",
      "workbench/window/features/quality",
      "workbench/window/features/review",
      "workbench/window/features/extraction",
      "workbench/window/workplace",
      "workbench/window/fields"}},
    {"workbench/window/view",
     {"workbench/window/features/borders",
      "geometry/kernel",
      "geometry/vessel/centerlines",
      "geometry/vessel/openings",
      "gpu",
      "workbench/case",
      "workbench/session",
      "workbench/operations",
      "workbench/window/style",
      "workbench/window/widgets",
      "workbench/window/case",
      "workbench/window/form",
      "workbench/window/drawing",
      "workbench/window/core",
      "workbench/window/features/brush",
      "workbench/window/features/compare",
      "workbench/window/features/openings",
      "workbench/window/features/picture",
      "workbench/window/features/handles",
      "workbench/window/features/live",
      "workbench/window/features/picking",
      "workbench/window/features/gallery",
      "workbench/window/features/clip",
      "workbench/window/features/flight",
      "workbench/window/features/measures",
      "workbench/window/features/review",
      "workbench/window/features/slices",
      "workbench/window/workplace"}},
    {"workbench/window/app",
     {"geometry/kernel", "gpu", "workbench/window/widgets", "workbench/window/case",
      "workbench/window/core", "workbench/window/features/borders",
      "workbench/window/features/history", "workbench/window/workplace", "workbench/window/panels",
      "workbench/window/view"}},
    {"workbench/window/shell",
     {"geometry/kernel", "gpu", "workbench/window/keys", "workbench/window/app"}},
    {"workbench/commands", {"geometry", "smoothing/quality", "gpu", "workbench"}}};

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

/// All our code by its path in the repository.
const std::map<std::string, SourceFile>& house() {
    static const auto files = [] {
        const fs::path root = source_folder();
        std::map<std::string, SourceFile> all;
        for (const std::string& folder : kFolders)
            for (const auto& entry : fs::recursive_directory_iterator(root / folder))
                if (is_source(entry.path())) {
                    const std::string text = text_of(entry.path());
                    all[fs::relative(entry.path(), root).string()] = {text, includes_in(text)};
                }
        return all;
    }();
    return files;
}

bool is_below(const std::string& path, const std::string& folder) {
    return path == folder || path.starts_with(folder + "/");
}

/// Empty if the file is in none.
std::string room_of(const std::string& path) {
    std::string room;
    for (const auto& [name, doors] : kDoors)
        if (is_below(path, name) && name.size() > room.size()) room = name;
    return room;
}

bool may_use(const std::string& room, const std::string& other) {
    return room == other || std::ranges::any_of(kDoors.at(room), [&](const std::string& door) {
               return is_below(other, door);
           });
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

// --- the targets as the CMakeLists link them

struct Target {
    Names rooms;  ///< of its sources; none: a bundle of other targets
    Names links;  ///< our own targets among what it links
};

Names words_of(const std::string& text) {
    std::istringstream stream(text);
    return {std::istream_iterator<std::string>(stream), {}};
}

Names own_targets(const Names& words) {
    Names targets;
    for (const std::string& word : words)
        if (word.starts_with("vb_")) targets.insert(word);
    return targets;
}

Names rooms_of_sources(const std::string& folder, const Names& words) {
    Names rooms;
    for (const std::string& word : words)
        if (word.ends_with(".cpp") && !word.starts_with("$"))
            rooms.insert(room_of(folder + "/" + word));
    return rooms;
}

void read_targets(const std::string& folder, std::map<std::string, Target>& targets) {
    const std::string text = text_of(fs::path(source_folder()) / folder / "CMakeLists.txt");
    static const std::regex with_sources(
        R"re((vesselbench_library|add_executable)\((\w+)([^)]*)\))re");
    static const std::regex links(R"re(target_link_libraries\((\w+)([^)]*)\))re");
    for (std::sregex_iterator i(text.begin(), text.end(), with_sources), end; i != end; ++i) {
        const Names words = words_of(i->str(3));
        const std::string prefix = i->str(1) == "add_executable" ? "" : "vb_";
        targets[prefix + i->str(2)] = {rooms_of_sources(folder, words), own_targets(words)};
    }
    for (std::sregex_iterator i(text.begin(), text.end(), links), end; i != end; ++i)
        targets[i->str(1)].links.merge(own_targets(words_of(i->str(2))));
}

std::map<std::string, Target> targets() {
    std::map<std::string, Target> all;
    for (const std::string& folder : kFolders) read_targets(folder, all);
    return all;
}

/// Rooms whose code a target can call: its own and those it links, directly or through others.
Names linked_rooms(const std::map<std::string, Target>& targets, const std::string& target) {
    Names rooms = targets.at(target).rooms;
    for (const std::string& link : targets.at(target).links)
        rooms.merge(linked_rooms(targets, link));
    return rooms;
}

bool may_link(const Target& target, const Target& other) {
    const auto used_by = [&](const std::string& room) {
        return std::ranges::any_of(other.rooms,
                                   [&](const std::string& to) { return may_use(room, to); });
    };
    return other.rooms.empty() || target.rooms.empty() ||
           std::ranges::any_of(target.rooms, used_by);
}

}  // namespace

SCENARIO("The table of rooms has no circle", "[workbench][house]") {
    std::map<std::string, Names> next;
    for (const auto& [room, doors] : kDoors)
        for (const auto& [other, ignored] : kDoors)
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
    for (const auto& [room, doors] : kDoors)
        for (const std::string& door : doors) {
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

SCENARIO("The targets link the rooms that their doors name", "[workbench][house]") {
    const auto all = targets();
    CHECK(all.size() > 20);
    std::map<std::string, Names> linked;
    for (const auto& [name, target] : all) {
        for (const std::string& room : target.rooms) linked[room].merge(linked_rooms(all, name));
        for (const std::string& link : target.links) {
            INFO(name << " links " << link);
            CHECK(may_link(target, all.at(link)));
        }
    }
    for (const auto& [file, source] : house())
        for (const Include& include : source.includes) {
            if (!include.quoted) continue;
            INFO(file << " includes " << include.name);
            CHECK(linked[room_of(file)].contains(room_of(include.name)));
        }
}
