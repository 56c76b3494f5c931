// Vessels that are narrower than beside the place.

#include <algorithm>

#include "geometry/kernel/wording.h"
#include "geometry/vessel/narrowing/narrowing.h"
#include "workbench/findings/detectors.h"
#include "workbench/operations/shared/narrowing_evidence.h"

namespace vesselbench {

namespace {

/// As of exact tests.
constexpr double kMostCertain = 0.98;

const char* words_of(ImageVerdict verdict) {
    if (verdict == ImageVerdict::ContrastFalls) return "the contrast falls there";
    return verdict == ImageVerdict::ImageAgrees ? "the image agrees, so that it may be a stenosis"
                                                : "the image does not decide";
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
        if (const auto image = narrowing_evidence(scene, rings, narrow))
            evidence.words = {{"image", words_of(image->verdict)}};
        findings.push_back({.kind = "narrowing",
                            .place = narrow.place,
                            .size = 0.5 * (narrow.to - narrow.from),
                            .certainty = std::min(narrow.certainty, kMostCertain),
                            .evidence = std::move(evidence)});
    }
    return findings;
}

}  // namespace vesselbench
