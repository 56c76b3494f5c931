#pragma once

#include <filesystem>
#include <string>

#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "tests/window/window_support.h"

namespace vesselbench::test {

/// A case folder with a tube and its own recipe. \param recipe JSON
[[nodiscard]] inline std::filesystem::path case_folder(const std::string& recipe) {
    const std::filesystem::path folder = std::filesystem::path(temporary_folder()) / "tube";
    std::filesystem::create_directory(folder);
    std::filesystem::copy_file(tube_file(), folder / "tube.stl");
    write_text(
        folder / "case.json",
        R"({"name": "tube", "surface": "tube.stl", "units": "mm", "recipe": )" + recipe + "}");
    return folder;
}

/// The same with a recipe that is quickly made, with edits of two purposes.
[[nodiscard]] inline std::filesystem::path case_folder() {
    return case_folder(R"([{"operation": "repair"},
                           {"operation": "smooth", "arguments": {"iterations": 3}},
                           {"operation": "subdivide", "when": "cfd"},
                           {"operation": "decimate", "when": "rp"}])");
}

}  // namespace vesselbench::test
