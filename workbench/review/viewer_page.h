#pragma once

#include <optional>
#include <string>

#include "geometry/kernel/progress.h"
#include "workbench/case/scene.h"
#include "workbench/colours/shown_measure.h"

namespace vesselbench {

/// What a page that shows a model holds besides its surfaces.
struct ViewerContents {
    std::string title;                   ///< of the case; empty: none
    std::string text;                    ///< about it; empty: none
    std::string purpose;                 ///< of the model, in words
    std::string provenance;              ///< line as provenance() makes it; empty: none
    std::optional<ShownMeasure> colour;  ///< of the scene's surface, shown on its wall
    bool slices = false;                 ///< three slices of the image through the model, if any
};

/// One self-contained page that shows a scene's surface and its neighbours, for teaching and
/// consultation. Where the surface has several components, each is a structure of its own; the page
/// holds the smallest distance of every two structures.
/// \throw DiagnosedFailure if the build has no page, AlgorithmFailure as surface_of(), InvalidInput
/// unless the measure has a value per vertex, Cancelled
[[nodiscard]] std::string viewer_page(const Scene& scene, const ViewerContents& contents,
                                      const Progress& progress = {});

}  // namespace vesselbench
