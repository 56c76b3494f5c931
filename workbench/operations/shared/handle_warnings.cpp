#include "workbench/operations/shared/handle_warnings.h"

#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/wording.h"
#include "meshing/stamp/separate.h"

namespace vesselbench {

namespace {

/// More handles are noise: their number says it.
constexpr int kMostNamed = 5;

/// A ring shorter than this many of its widths goes around less than a vessel does: a hole in a
/// contact.
constexpr double kShortest = 8.0;

}  // namespace

Diagnostic handle_warning(const SurfaceHandle& handle) {
    const bool artefact = handle.length < kShortest * handle.width;
    return {.code = artefact ? "handle-artefact" : "handle",
            .place = handle.centre,
            .figures = {{"width_mm", handle.width}, {"length_mm", handle.length}},
            .remedies = {{.operation = "separate",
                          .arguments = {{"at", coordinates_argument(handle.centre)}}}}};
}

namespace {

/// A contact that is wider than the thinner vessel is none of two vessels alone [-].
constexpr double kWidestContact = 1.05;

/// Two vessels touch at the handle, and can be parted there.
bool can_be_parted(const Surface& surface, const SurfaceHandle& handle, const Progress& progress) {
    const SeparateParameters parameters{.at = handle.centre, .gap = mean_edge_length(surface)};
    try {
        const SeparateReport report =
            separate(surface, distance_to(surface), parameters, progress.silent()).report;
        return report.waist <= kWidestContact &&
               (report.genus_after < report.genus_before ||
                report.components_after > report.components_before);
    } catch (const AlgorithmFailure&) {
        return false;
    } catch (const InvalidInput&) {
        return false;
    }
}

}  // namespace

std::vector<Diagnostic> handle_warnings(const Surface& surface, const Progress& progress) {
    const int genus = connectivity(*surface.topology).genus.value_or(0);
    if (genus <= 0) return {};
    if (genus > kMostNamed) return {{.code = "many-handles", .figures = {{"handles", genus}}}};
    std::vector<Diagnostic> warnings;
    for (const SurfaceHandle& handle : handles_of(surface, progress.silent())) {
        warnings.push_back(handle_warning(handle));
        if (!can_be_parted(surface, handle, progress)) warnings.back().remedies.clear();
    }
    return warnings;
}

}  // namespace vesselbench
