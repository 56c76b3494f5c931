#pragma once

namespace vesselbench {

/// What a file is asked for.
enum class FileQuestion {
    None,
    Open,
    SaveCopy,
    Export,
    Parameter,
    Picture,
    Measures,
    SaveRecipe,
    SaveEdits,  ///< as a recipe
    ReviewPage,
    Verdicts  ///< to be read
};

/// True if several files may be chosen at once.
[[nodiscard]] constexpr bool takes_several(FileQuestion question) {
    return question == FileQuestion::Verdicts;
}

}  // namespace vesselbench
