#include "workbench/batch/case_report.h"

#include <array>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/whole_file.h"
#include "workbench/case/json_text.h"
#include "workbench/operations/table.h"
#include "workbench/review/entered_verdicts.h"
#include "workbench/review/review.h"
#include "workbench/session/session.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

bool has_verdicts(const fs::path& project) {
    return !entered_verdicts(ProjectFile::open_to_read(project, "its verdicts are listed")).empty();
}

}  // namespace

std::span<const TableFigure> table_figures() {
    static const std::array<TableFigure, 24> figures = {{
        {"triangles", "triangles", "", "/quality/after/triangles", 0},
        {"volume_mm3", "volume", "mm\u00B3", "/quality/after/volume", 1},
        {"area_mm2", "area", "mm\u00B2", "/quality/after/area", 1},
        {"openings", "openings", "", "/openings", 0},
        {"largest_distance_to_source_mm", "largest distance to the source", "mm",
         "/distance_to_source/largest_mm", 3},
        {"tetrahedra", "tetrahedra", "", "/volume_mesh/cells", 0},
        {"smallest_dihedral_deg", "smallest dihedral angle", "\u00B0",
         "/volume_mesh/smallest_dihedral_deg", 1},
        {"thinnest_place_mm", "thinnest place", "mm", "/print/smallest_wall_distance/distance_mm",
         2},
        {"dome_area_mm2", "dome area", "mm\u00B2", "/sac/dome_area_mm2", 1},
        {"neck_area_mm2", "neck area", "mm\u00B2", "/sac/neck_area_mm2", 1},
        {"sac_volume_mm3", "sac volume", "mm\u00B3", "/sac/volume_mm3", 1},
        {"neck_diameter_mm", "neck diameter", "mm", "/sac/neck_diameter_mm", 2},
        {"neck_width_mm", "neck width", "mm", "/sac/neck_width_mm", 2},
        {"neck_hydraulic_diameter_mm", "hydraulic neck diameter", "mm",
         "/sac/neck_hydraulic_diameter_mm", 2},
        {"sac_height_mm", "sac height", "mm", "/sac/height_mm", 2},
        {"sac_length_mm", "sac length", "mm", "/sac/length_mm", 2},
        {"sac_width_mm", "sac width", "mm", "/sac/width_mm", 2},
        {"parent_diameter_mm", "parent diameter", "mm", "/sac/parent_diameter_mm", 2},
        {"aspect_ratio", "aspect ratio", "", "/sac/aspect_ratio", 2},
        {"size_ratio", "size ratio", "", "/sac/size_ratio", 2},
        {"bottleneck_factor", "bottleneck factor", "", "/sac/bottleneck_factor", 2},
        {"undulation", "undulation", "", "/sac/undulation", 3},
        {"ellipticity", "ellipticity", "", "/sac/ellipticity", 3},
        {"nonsphericity", "non-sphericity", "", "/sac/nonsphericity", 3},
    }};
    return figures;
}

Json read_report(const fs::path& folder) {
    try {
        Json report =
            json_from_text(file_content(folder / "report.json"), "report.json", kLargestStoredJson);
        return report.is_object() && report.contains("products") ? report : Json();
    } catch (const IoError&) {
        return {};
    } catch (const InvalidInput&) {
        return {};
    }
}

Json figure_in(const Json& report, const TableFigure& figure) {
    const Json::json_pointer pointer(figure.pointer);
    if (!report.is_object() || !report.contains(pointer)) return {};
    const Json& found = report.at(pointer);
    if (found.is_array()) return found.size();
    return found.is_number() ? found : Json();
}

std::string content_if_any(const fs::path& file) {
    try {
        return file_content(file);
    } catch (const IoError&) {
        return {};
    }
}

std::string review_state(const fs::path& folder, const std::string& purpose) {
    const fs::path project = folder / "project.vbench";
    try {
        if (!fs::exists(project)) return "";
        if (!has_verdicts(project)) return "not reviewed";
        const Session session = Session::open(project, {.find = find_operation});
        return review_words(review_of(session, purpose));
    } catch (const IoError&) {
        return "open elsewhere";
    } catch (const Cancelled&) {
        throw;
    } catch (const std::exception&) {  // whatever a project from elsewhere holds
        return "unreadable";
    }
}

}  // namespace vesselbench
