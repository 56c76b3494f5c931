#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "geometry/formats/format.h"
#include "geometry/kernel/progress.h"
#include "meshing/products/cfd_parameters.h"
#include "workbench/case/scene.h"
#include "workbench/flow/flow_record.h"
#include "workbench/review/viewer_page.h"
#include "workbench/session/source_counterpart.h"

namespace vesselbench {

/// What an export adds to the scene, or says beside it; each format takes its own part.
struct ExportOptions {
    CfdParameters flow = {};         ///< of a solver's case
    std::string provenance = {};     ///< line for the file's header, as provenance() makes it
    ViewerContents shown = {};       ///< of models for viewers: colour; of pages all of it
    std::vector<MadeEnd> ends = {};  ///< of the model, for a solver's case
    std::optional<RecordedNeck> neck = std::nullopt;  ///< of the model's sac, for the same
};

/// A format that a scene can be exported in.
struct ExportFormat : Format {
    /// \throw AlgorithmFailure if the scene has no such content, Cancelled within the file
    std::function<void(const Scene&, const std::string& path, const ExportOptions&,
                       const Progress&)>
        write;
    bool takes_colour = false;  ///< shows ViewerContents::colour
    bool takes_page = false;    ///< shows the rest of ViewerContents
};

/// The formats that can be written from a scene, of all rooms: surfaces, models for viewers, then
/// volume meshes, then solvers' cases.
[[nodiscard]] const std::vector<ExportFormat>& export_formats();

/// The table of these formats for the help of `export`: a line each with suffix, content and unit.
[[nodiscard]] std::string export_formats_text();

/// Whether the library that writes CGNS files is installed; the other formats need none.
[[nodiscard]] bool can_write_cgns();

/// The surface and image formats that are read, for help texts: two lines.
[[nodiscard]] std::string input_formats_text();

}  // namespace vesselbench
