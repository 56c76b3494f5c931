#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "workbench/operations/extract_surface/live_extractor.h"
#include "workbench/window/case/answerer.h"

namespace vesselbench {

/// What a surface is to be extracted from, and how.
struct ExtractionQuestion {
    Image image;
    std::optional<Image> mask;
    std::vector<int> vessel;  ///< labels that were chosen
    int base = 0;             ///< number of the image and the mask: equal ones are the same
    CheckedArguments arguments;
};

/// A surface that follows the arguments of its extraction, as the view shows it: a value.
struct ExtractionModel {
    std::uint64_t question = 0;  ///< that it answers
    LiveExtractor::State state;
    std::shared_ptr<const ImageHistogram> histogram;
};

using ExtractionModels = AnswerTask<ExtractionQuestion, ExtractionModel>;

/// Work that extracts from a coarse image first, and from all of it when the values rest.
[[nodiscard]] ExtractionModels::Maker live_extracting();

}  // namespace vesselbench
