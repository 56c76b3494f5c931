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
    ReviewPage,
    Verdicts  ///< to be read
};

}  // namespace vesselbench
