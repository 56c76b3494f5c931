#include "workbench/operations/extract_surface/parameters.h"

#include <cmath>

#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

std::optional<ExtractionMethod> method_from(const Arguments& arguments) {
    const std::string& name = arguments.text("method");
    if (name == "threshold") return ExtractionMethod::Threshold;
    if (name == "labels") return ExtractionMethod::Labels;
    if (name == "masked") return ExtractionMethod::Masked;
    if (name == "wall") return ExtractionMethod::Wall;
    return std::nullopt;
}

MaskSurface mask_surface_from(const std::string& name) {
    if (name == "smooth") return MaskSurface::Smooth;
    return name == "lumen" ? MaskSurface::Lumen : MaskSurface::Midway;
}

std::vector<int> labels_from(const Arguments& arguments) {
    std::vector<int> labels;
    if (!arguments.has("labels")) return labels;
    for (const double label : arguments.list("labels")) {
        if (label != std::floor(label) || label < 1.0 || label > 1e6)
            throw UsageError("extract-surface: labels are integers, 1 or above");
        labels.push_back(static_cast<int>(label));
    }
    return labels;
}

Cleaning cleaning_from(const Arguments& arguments) {
    return {.diffusion = static_cast<int>(arguments.integer("diffusion")),
            .diffusion_contrast = arguments.optional_real("contrast"),
            .gaussian = arguments.real("gaussian"),
            .opening = static_cast<int>(arguments.integer("opening")),
            .closing = static_cast<int>(arguments.integer("closing"))};
}

}  // namespace

ExtractionParameters extraction_parameters(const Arguments& arguments, bool with_mask,
                                           const std::vector<int>& vessel) {
    ExtractionParameters parameters;
    parameters.method = method_from(arguments);
    if (arguments.has("iso") && arguments.has("threshold"))
        throw UsageError("extract-surface: iso and threshold are synonyms: give one of them");
    const bool midway = arguments.is_word("threshold", "midway");
    if (arguments.has("iso"))
        parameters.threshold = arguments.real("iso");
    else if (!midway && !arguments.is_word("threshold", "local"))
        parameters.threshold = arguments.optional_real("threshold");
    parameters.local_levels = !parameters.threshold && !midway;
    if (const auto inside = arguments.optional_text("inside"))
        parameters.inside_below = *inside == "below";
    parameters.labels = labels_from(arguments);
    if (parameters.labels.empty()) parameters.labels = vessel;
    const bool labels_alone = !parameters.labels.empty() && !parameters.threshold && !with_mask;
    if (labels_alone && !parameters.method) parameters.method = ExtractionMethod::Labels;
    parameters.mask_surface = mask_surface_from(arguments.text("mask_surface"));
    if (arguments.text("between_slices") == "curved")
        parameters.between_slices = BetweenSlices::Curved;
    if (arguments.text("freed_sides") == "touched") parameters.freed_sides = FreedSides::Touched;
    parameters.dilation = static_cast<int>(arguments.integer("dilation"));
    parameters.cleaning = cleaning_from(arguments);
    parameters.resample = arguments.optional_real("resample");
    parameters.seed = arguments.optional_point("seed");
    parameters.bodies = arguments.text("component") == "all" ? Bodies::All : Bodies::Largest;
    return parameters;
}

}  // namespace vesselbench
