#include "workbench/export/export_formats.h"

#include <algorithm>

#include "geometry/formats/image_formats.h"
#include "geometry/formats/surface_formats.h"
#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/whole_file.h"
#include "geometry/kernel/wording.h"
#include "meshing/products/cgns.h"
#include "meshing/products/glb.h"
#include "meshing/products/product_formats.h"
#include "workbench/colours/shown_measure.h"
#include "workbench/flow/flow_record.h"
#include "workbench/flow/outlet_shares.h"
#include "workbench/report/colour_scale.h"

namespace vesselbench {

namespace {

constexpr double kShareOfLines = 0.3;  ///< of a case's progress, if it needs centerlines

const VolumeMesh& volume_mesh_of(const Scene& scene) {
    if (!scene.volume_mesh)
        throw DiagnosedFailure(
            {.code = "no-volume-mesh", .remedies = {{.operation = "tetrahedralize"}}});
    return *scene.volume_mesh;
}

void add_surfaces(std::vector<ExportFormat>& all, const std::vector<SurfaceFormat>& rows) {
    for (const SurfaceFormat& row : rows)
        if (row.write)
            all.push_back(
                {row, [write = row.write](const Scene& scene, const std::string& path,
                                          const ExportOptions& options, const Progress& progress) {
                     write(surface_of(scene), path, progress, options.provenance);
                 }});
}

GlbColours glb_colours(const ShownMeasure& measure) {
    GlbColours colours{.name = measure.name,
                       .label = measure.label,
                       .unit = measure.unit,
                       .least = measure.scale.least,
                       .most = measure.scale.most,
                       .map = legend_colours(measure.scale),
                       .vertices = {}};
    for (const Colour& colour : colours_of(measure.values, measure.scale))
        colours.vertices.push_back({colour.x(), colour.y(), colour.z()});
    return colours;
}

void export_glb(const Scene& scene, const std::string& path, const ExportOptions& options,
                const Progress& progress) {
    GlbModel model{.surface = surface_of(scene),
                   .neighbours = scene.neighbours,
                   .colours = {},
                   .provenance = options.provenance};
    if (options.shown.colour) model.colours = glb_colours(*options.shown.colour);
    write_glb(model, path, progress);
}

void export_page(const Scene& scene, const std::string& path, const ExportOptions& options,
                 const Progress& progress) {
    ViewerContents shown = options.shown;
    shown.provenance = options.provenance;
    const std::string page = viewer_page(scene, shown, progress.part(0.0, 0.9));
    write_file(path, page, progress.part(0.9, 1.0));
}

/// Formats that show the scene with its neighbours.
std::vector<ExportFormat> viewer_formats() {
    return {{{.name = "GLB",
              .suffixes = {".glb"},
              .content = "binary glTF 2.0 for viewers, with neighbours and a node per part",
              .unit = "m"},
             export_glb,
             true},
            {{.name = "HTML",
              .suffixes = {".html"},
              .content = "one page that shows the model in any browser, with neighbours"},
             export_page,
             true,
             true}};
}

std::vector<ExportFormat> joined_rows() {
    std::vector<ExportFormat> all;
    add_surfaces(all, surface_formats());
    add_surfaces(all, product_surface_formats());
    for (const ExportFormat& row : viewer_formats()) all.push_back(row);
    for (const VolumeFormat& row : volume_formats())
        all.push_back(
            {row, [write = row.write](const Scene& scene, const std::string& path,
                                      const ExportOptions& options, const Progress& progress) {
                 write(volume_mesh_of(scene), path, progress, options.provenance);
             }});
    for (const CaseFormat& row : case_formats())
        all.push_back(
            {row, [write = row.write](const Scene& scene, const std::string& path,
                                      const ExportOptions& options, const Progress& progress) {
                 const VolumeMesh& mesh = volume_mesh_of(scene);
                 const double lines =
                     options.flow.outlets == OutletFlow::Bifurcations ? kShareOfLines : 0.0;
                 const CfdParameters flow =
                     with_outlet_shares(options.flow, mesh, progress.part(0.0, lines));
                 write(path, mesh, flow, progress.part(lines, 1.0), options.provenance);
                 write_flow_record(path, mesh, flow,
                                   {.provenance = options.provenance,
                                    .ends = options.ends,
                                    .neck = options.neck});
             }});
    return all;
}

std::string padded(std::string text, std::size_t width) {
    text.resize(std::max(width, text.size()), ' ');
    return text;
}

}  // namespace

const std::vector<ExportFormat>& export_formats() {
    static const std::vector<ExportFormat> rows = joined_rows();
    return rows;
}

std::string export_formats_text() {
    const auto suffixes = [](const ExportFormat& row) {
        return row.folder.empty() ? joined(row.suffixes, " ") : "folder";
    };
    std::size_t width = 0;
    for (const ExportFormat& row : export_formats())
        width = std::max(width, suffixes(row).size() + 2);
    std::string text;
    for (const ExportFormat& row : export_formats())
        text += "  " + padded(suffixes(row), width) +
                padded(row.kind == FormatKind::Surface ? "surface" : "volume mesh", 13) +
                padded(row.unit, 4) + row.name + ": " + row.content + "\n";
    return text;
}

bool can_write_cgns() {
    return cgns_installed();
}

std::string input_formats_text() {
    return "Surfaces: " + joined(read_suffixes(surface_formats()), " ") +
           "\nImages: " + joined(read_suffixes(image_formats()), " ") + " and " +
           folder_text(image_formats(), "folders");
}

}  // namespace vesselbench
