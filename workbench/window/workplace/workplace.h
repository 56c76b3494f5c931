#pragma once

#include <optional>

#include "workbench/window/core/core.h"
#include "workbench/window/features/colours/view_data.h"
#include "workbench/window/features/compare/comparison.h"
#include "workbench/window/features/extraction/live_extraction.h"
#include "workbench/window/features/gallery/suggestion_gallery.h"
#include "workbench/window/features/live/live_smoothing.h"
#include "workbench/window/features/measures/measure_list.h"
#include "workbench/window/features/openings/openings_model.h"
#include "workbench/window/features/quality/quality_analysis.h"
#include "workbench/window/features/slices/image_slices.h"

namespace vesselbench {

/// Everything the window is about: the core and all features (feature_table.h). The functions
/// are for those who draw around the features; others ask for a feature by its type: get().
class Workplace : public Core {
public:
    /// \param device of live smoothing
    Workplace(const DocumentOptions& options, Settings settings, const LiveDevice& device = {});

    /// None while nothing is compared.
    [[nodiscard]] std::optional<Comparison>& comparison() const;

    /// The form's model, followed live.
    [[nodiscard]] LiveSmoothing& live() const;

    /// What is known of the quality that the form's parameters give.
    [[nodiscard]] QualityAnalysis& quality() const;
    [[nodiscard]] SuggestionGallery& gallery() const;

    /// The surface of the image, which follows the form that extracts it.
    [[nodiscard]] LiveExtraction& extraction() const;

    /// True if a model or a surface can follow the form, or graphs belong to it.
    [[nodiscard]] bool has_live_form() const;

    /// All vessel ends of a form that opens them.
    [[nodiscard]] OpeningsModel& openings() const;

    /// Slices of the shown scene's image.
    [[nodiscard]] ImageSlices& slices() const;
    [[nodiscard]] MeasureList& measures() const;

    /// What the view shows besides the surface, as far as it is chosen and known.
    [[nodiscard]] const ViewData& view_data() const;
};

}  // namespace vesselbench
