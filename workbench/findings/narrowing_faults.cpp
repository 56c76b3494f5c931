// Vessels that are narrower than beside the place.

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "geometry/kernel/wording.h"
#include "geometry/vessel/centerlines/branch_queries.h"
#include "geometry/vessel/narrowing/narrowing.h"
#include "workbench/findings/detectors.h"
#include "workbench/operations/shared/narrowing_evidence.h"

namespace vesselbench {

namespace {

/// As of exact tests.
constexpr double kMostCertain = 0.98;

constexpr double kNearFurcation = 4.0;  ///< plaques arise there [radii]
constexpr double kLong = 2.0;           ///< narrows gradually [radii]
constexpr double kFewVoxels = 2.0;      ///< of depth: the image hardly shows it

const char* words_of(ImageVerdict verdict) {
    if (verdict == ImageVerdict::ContrastFalls) return "the contrast falls there";
    return verdict == ImageVerdict::ImageAgrees ? "the image agrees, so that it may be a stenosis"
                                                : "the image does not decide";
}

/// How far a narrowing is from the nearest furcation of its branch [mm]; infinite: it has none.
double from_furcation(const CenterlineGraph& graph, const Narrowing& narrow) {
    const CenterlineBranch& branch = graph.branches[narrow.branch];
    double least = std::numeric_limits<double>::infinity();
    if (!graph.nodes[branch.start_node].is_tip()) least = narrow.from;
    if (!graph.nodes[branch.end_node].is_tip())
        least = std::min(least, branch_length(branch) - narrow.to);
    return std::max(least, 0.0);
}

std::vector<Diagnostic> for_stenosis(const CenterlineGraph& graph, const Narrowing& narrow,
                                     const std::optional<ImageEvidence>& image) {
    std::vector<Diagnostic> evidence;
    if (image && image->verdict == ImageVerdict::ImageAgrees)
        evidence.push_back({.code = "reading-image-agrees",
                            .figures = {{"contrast_percent", 100.0 * image->lumen_contrast},
                                        {"lumen_mm", 2.0 * image->lumen_radius}}});
    const double away = from_furcation(graph, narrow);
    if (away < kNearFurcation * narrow.expected_radius)
        evidence.push_back({.code = "reading-at-furcation", .figures = {{"distance_mm", away}}});
    if (narrow.to - narrow.from > kLong * narrow.expected_radius)
        evidence.push_back(
            {.code = "reading-gradual", .figures = {{"length_mm", narrow.to - narrow.from}}});
    return evidence;
}

std::vector<Diagnostic> for_artefact(const Narrowing& narrow,
                                     const std::optional<ImageEvidence>& image,
                                     const Scene& scene) {
    std::vector<Diagnostic> evidence;
    if (image && image->verdict == ImageVerdict::ContrastFalls)
        evidence.push_back({.code = "reading-contrast-falls",
                            .figures = {{"contrast_percent", 100.0 * image->lumen_contrast},
                                        {"lumen_mm", 2.0 * image->lumen_radius}}});
    if (!scene.sampling) return evidence;
    const double voxels = narrow.depth() / scene.sampling->spacing.maxCoeff();
    if (voxels < kFewVoxels)
        evidence.push_back({.code = "reading-shallow", .figures = {{"voxels", voxels}}});
    return evidence;
}

/// The image decides which comes first; where it does not, the pathology does.
std::vector<Reading> narrowing_readings(const Narrowing& narrow, const CenterlineGraph& graph,
                                        const std::optional<ImageEvidence>& image,
                                        const Scene& scene) {
    std::vector<Reading> readings = {
        {.key = "stenosis",
         .name = "stenosis",
         .anatomy = true,
         .evidence = for_stenosis(graph, narrow, image)},
        {.key = "artefact", .name = "artefact", .evidence = for_artefact(narrow, image, scene)}};
    if (image && image->verdict == ImageVerdict::ContrastFalls)
        std::swap(readings.front(), readings.back());
    return readings;
}

}  // namespace

std::vector<Finding> find_narrow_vessels(FindingSubject& subject, const Progress& progress) {
    const auto& lines = subject.lines(progress);
    const Scene& scene = subject.scene();
    NarrowingParameters parameters;
    if (scene.sampling) parameters.resolution = scene.sampling->spacing.maxCoeff();
    std::vector<Finding> findings;
    for (const Narrowing& narrow :
         find_narrowings(subject.surface(), *lines.graph, parameters, progress)) {
        Diagnostic evidence{
            .code = "found-narrowing",
            .figures = {{"found_mm", narrow.found_radius},
                        {"expected_mm", narrow.expected_radius},
                        {"length_mm", narrow.to - narrow.from}},
            .remedies = {{.operation = "correct-narrowing",
                          .arguments = {{"at", coordinates_argument(narrow.place)}}}}};
        const auto rings = wall_rings(subject.surface(), *lines.graph, narrow.branch, progress);
        const auto image = narrowing_evidence(scene, rings, narrow);
        if (image) evidence.words = {{"image", words_of(image->verdict)}};
        findings.push_back({.kind = "narrowing",
                            .place = narrow.place,
                            .size = 0.5 * (narrow.to - narrow.from),
                            .certainty = std::min(narrow.certainty, kMostCertain),
                            .evidence = std::move(evidence),
                            .readings = narrowing_readings(narrow, *lines.graph, image, scene)});
    }
    return findings;
}

}  // namespace vesselbench
