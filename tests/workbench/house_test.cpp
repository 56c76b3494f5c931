#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/support/paths.h"

namespace fs = std::filesystem;

namespace {

const std::map<std::string, std::set<std::string>> kMayInclude = {
    {"geometry", {"geometry"}},
    {"smoothing", {"geometry", "smoothing"}},
    {"gpu", {"geometry", "smoothing", "gpu"}},
    {"meshing", {"geometry", "meshing"}},
    {"workbench", {"geometry", "smoothing", "gpu", "meshing", "workbench"}}};

struct Include {
    std::string file;  ///< that includes, relative to the repository
    std::string name;  ///< as written
    bool quoted = false;
};

bool is_header(const fs::path& file) {
    return file.extension() == ".h";
}

std::vector<Include> includes_of(const std::string& folder) {
    const fs::path root = vesselbench::test::source_folder();
    static const std::regex pattern(R"re(^\s*#\s*include\s*(["<])([^">]+)[">])re");
    std::vector<Include> includes;
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
        if (!is_header(entry.path()) && entry.path().extension() != ".cpp") continue;
        std::ifstream stream(entry.path());
        std::smatch match;
        for (std::string line; std::getline(stream, line);)
            if (std::regex_search(line, match, pattern))
                includes.push_back(
                    {fs::relative(entry.path(), root).string(), match[2], match[1] == "\""});
    }
    return includes;
}

bool is_heavy_library(const std::string& name) {
    return name.starts_with("vtk") || name.starts_with("CGAL/") || name.starts_with("OpenMesh/") ||
           name == "tetgen.h" || name.starts_with("gdcm") || name.starts_with("epoxy/") ||
           name.starts_with("EGL/");
}

bool may_use_vtk(const std::string& file) {
    return file.starts_with("geometry/formats/") || file.starts_with("geometry/image/") ||
           file.starts_with("geometry/phantoms/");  // its iso-surface
}

}  // namespace

SCENARIO("Dependencies between the folders run one way", "[workbench][house]") {
    for (const auto& [folder, allowed] : kMayInclude) {
        const auto includes = includes_of(folder);
        CHECK_FALSE(includes.empty());
        for (const Include& include : includes) {
            if (!include.quoted) continue;
            INFO(include.file << " includes \"" << include.name << "\"");
            const std::string from = include.name.substr(0, include.name.find('/'));
            CHECK(allowed.contains(from));
        }
    }
}

SCENARIO("Large libraries stop at the source files", "[workbench][house]") {
    for (const auto& [folder, allowed] : kMayInclude)
        for (const Include& include : includes_of(folder)) {
            INFO(include.file << " includes " << include.name);
            CHECK_FALSE((is_header(include.file) && is_heavy_library(include.name)));
            if (include.name.starts_with("vtk")) CHECK(may_use_vtk(include.file));
            CHECK(include.name != "vtkSMPTools.h");
        }
}
