#include "workbench/operations/shared/stack_axis.h"

#include <cmath>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/wording.h"
#include "smoothing/context/stack_orientation.h"
#include "smoothing/context/staircase_thresholds.h"

namespace vesselbench {

namespace {

constexpr const char* kAll = "all";

// For surfaces that show no voxels: vertices that were moved since have gentler steps than those of
// masks, and edges about as long as voxels, of which a slice is two or three.
constexpr double kUnknownTauTheta = 0.5;
constexpr double kEdgesPerSlice = 3.0;

bool asks_for_all(const Arguments& arguments) {
    const auto at = arguments.values().find("stack_axis");
    return at != arguments.values().end() && at->second == Value(std::string(kAll));
}

/// The direction given by the user; none: `all`, or absent.
std::optional<Vec3> given_axis(const Arguments& arguments, const std::string& operation = "") {
    if (asks_for_all(arguments)) return std::nullopt;
    const auto axis = arguments.optional_point("stack_axis");
    if (!axis) return std::nullopt;
    const Vec3 direction = axis->stableNormalized();
    constexpr double kUnit = 1e-12;  // an axis recorded by an earlier run keeps its bits
    if (std::abs(axis->norm() - 1.0) < kUnit) return axis;
    if (direction.allFinite() && direction.norm() > 0.5) return direction;
    throw UsageError((operation.empty() ? "" : operation + ": ") + "stack_axis = " +
                     to_text(*axis) + " has no direction: give three numbers, not all of them 0");
}

/// What is known of the image.
struct Voxels {
    std::optional<VoxelGrid> grid;
    ImagedAs as = ImagedAs::Intensities;
    std::string from = "image";
    std::optional<StackOrientation> estimate;  ///< none: the image itself is known
};

Voxels voxels_of(const Scene& scene, ContextFinder& finder) {
    const Surface& surface = *scene.surface;
    Voxels voxels;
    if (scene.sampling && scene.sampling->confidence > 0.0) {
        voxels.grid = {.axes = scene.sampling->axes, .spacing = scene.sampling->spacing};
    } else {
        voxels.estimate = estimate_stack_orientation(surface, finder.caps());
        voxels.grid = voxels.estimate->grid;
        voxels.from = "estimate";
    }
    if (voxels.grid && is_of_mask(*surface.topology, surface.points(), *voxels.grid))
        voxels.as = ImagedAs::Mask;
    return voxels;
}

/// The column of the grid along a direction; none: it has none there.
std::optional<int> column_along(const VoxelGrid& grid, const Vec3& direction) {
    constexpr double kAlong = 0.9998;  // cosine of 1 degree
    for (int k = 0; k < 3; ++k)
        if (std::abs(grid.axes.col(k).dot(direction)) > kAlong) return k;
    return std::nullopt;
}

std::string spacing_text(const VoxelGrid& grid) {
    return formatted(grid.spacing.x(), "%.3g") + " x " + formatted(grid.spacing.y(), "%.3g") +
           " x " + formatted(grid.spacing.z(), "%.3g") + " mm";
}

/// The voxels, as the reasons name them: "voxels of 0.3 x 0.3 x 0.6 mm".
std::string voxels_text(const Voxels& voxels) {
    return std::string(voxels.as == ImagedAs::Mask ? "a mask" : "intensities") +
           " with voxels of " + spacing_text(*voxels.grid) +
           (voxels.estimate ? ", as the triangles show" : "");
}

/// Axes and thresholds, if neither is given.
struct Decision {
    StaircaseChoice choice;
    std::optional<StaircaseThresholds> thresholds;  ///< none: the voxels are unknown
    bool by_surface = false;  ///< tau_theta is what stands out of the surface's own bends
};

Decision across_all(const Voxels& voxels, bool given) {
    Decision made;
    made.thresholds = thresholds_across_all(*voxels.grid, voxels.as);
    made.choice.axes = made.thresholds->axes;
    made.choice.axes_from = given ? "argument" : voxels.from;
    if (!given)
        made.choice.reasons["stack_axis"] = "all, because a mask whose voxels are nearly cubes (" +
                                            spacing_text(*voxels.grid) +
                                            ") has steps across all three axes";
    return made;
}

/// \return none if the axis is uncertain
std::optional<Decision> across_one(const Voxels& voxels, const std::optional<Vec3>& given) {
    Decision made;
    std::optional<int> column;
    Vec3 axis = Vec3::UnitZ();
    if (given) {
        axis = *given;
        made.choice.axes_from = "argument";
        if (voxels.grid && (!voxels.estimate || !voxels.grid->is_cubic()))
            column = column_along(*voxels.grid, axis);
    } else if (voxels.estimate) {
        if (!voxels.estimate->certain) return std::nullopt;
        axis = voxels.estimate->direction;
        made.choice.axes_from = "estimate";
        made.choice.confidence = voxels.estimate->confidence;
        if (voxels.grid) column = column_along(*voxels.grid, axis);
    } else {
        column = voxels.grid->longest();
        axis = voxels.grid->axes.col(*column);
        made.choice.axes_from = "image";
    }
    made.choice.axes = axis;
    if (column) made.thresholds = thresholds_across(*voxels.grid, *column, voxels.as);
    return made;
}

/// What a blurred step leaves stands out of a surface that is smooth otherwise, though it is far
/// gentler than the voxels' step.
void take_outstanding(const Surface& surface, const Voxels& voxels, Decision& made) {
    if (voxels.as == ImagedAs::Mask || !made.thresholds || surface.empty()) return;
    const double outstanding = three_digits(outstanding_change(
        orientation_change(*surface.topology, surface.points(), made.choice.axes)));
    if (outstanding >= made.thresholds->tau_theta) return;
    made.thresholds->tau_theta = outstanding;
    made.by_surface = true;
}

std::string step_text(const Voxels& voxels, const StaircaseThresholds& found, bool by_surface) {
    if (by_surface)
        return "the surface is smooth enough for a bend of that size to stand out: what blur "
               "leaves of a step in " +
               voxels_text(voxels);
    const std::string text = "a step of one voxel changes the orientation by " +
                             formatted(found.step, "%.2f") + " in " + voxels_text(voxels);
    if (voxels.as == ImagedAs::Mask) return text;
    return text + ", and by less after blur" +
           (found.tau_theta > found.step ? "; a thin vessel is round enough to bend by that much"
                                         : "");
}

void decide_thresholds(const Scene& scene, const Arguments& arguments, const Voxels& voxels,
                       Decision& made) {
    StaircaseChoice& choice = made.choice;
    if (!arguments.has("tau_theta")) take_outstanding(*scene.surface, voxels, made);
    const double edges = three_digits(kEdgesPerSlice * mean_edge_length(*scene.surface));
    choice.tau_theta = made.thresholds ? made.thresholds->tau_theta : kUnknownTauTheta;
    choice.tau_max = made.thresholds                       ? made.thresholds->tau_max
                     : edges > 0.0 && std::isfinite(edges) ? edges
                                                           : kEdgesPerSlice;
    if (const auto given = arguments.optional_real("tau_theta"))
        choice.tau_theta = *given;
    else
        choice.reasons["tau_theta"] =
            to_text(choice.tau_theta) + ", because " +
            (made.thresholds ? step_text(voxels, *made.thresholds, made.by_surface)
                             : "the voxels are unknown, and steps may have been smoothed");
    if (const auto given = arguments.optional_real("tau_max"))
        choice.tau_max = *given;
    else
        choice.reasons["tau_max"] =
            to_text(choice.tau_max) + " mm, " +
            (made.thresholds ? "the distance of the slices"
                             : "three mean edges, because the voxels are unknown");
}

}  // namespace

Value StaircaseChoice::axis_value() const {
    if (axes.size() > 1) return std::string(kAll);
    return *axes.begin();
}

std::optional<StaircaseChoice> staircase_choice(const Scene& scene, ContextFinder& finder,
                                                const Arguments& arguments) {
    const auto given = given_axis(arguments);
    if (given && arguments.has("tau_theta") && arguments.has("tau_max"))
        return StaircaseChoice{.axes = *given,
                               .axes_from = "argument",
                               .tau_theta = arguments.real("tau_theta"),
                               .tau_max = arguments.real("tau_max")};
    const Voxels voxels = voxels_of(scene, finder);
    const bool asked_for_all = asks_for_all(arguments);
    if (asked_for_all && !voxels.grid)
        throw DiagnosedFailure(
            {.code = "voxel-axes-unknown", .remedies = {{.arguments = {{"stack_axis", ""}}}}});
    const bool all =
        asked_for_all || (!given && voxels.grid && steps_across_all(*voxels.grid, voxels.as));
    std::optional<Decision> made =
        all ? across_all(voxels, asked_for_all) : across_one(voxels, given);
    if (!made) return std::nullopt;
    decide_thresholds(scene, arguments, voxels, *made);
    return std::move(made->choice);
}

void check_stack_axis(const Arguments& arguments, const std::string& operation) {
    static_cast<void>(given_axis(arguments, operation));
}

}  // namespace vesselbench
