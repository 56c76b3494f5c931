#include "geometry/vessel/narrowing/image_evidence.h"

#include <algorithm>
#include <cmath>

#include "geometry/kernel/statistics.h"
#include "geometry/vessel/narrowing/section_profile.h"

namespace vesselbench {

namespace {

constexpr double kBeside = 6.0;    ///< vessel beside the narrowing that it is compared with [radii]
constexpr double kDeepPart = 0.8;  ///< of the depth: where a section counts as the narrowing's
constexpr double kAround = 2.5;    ///< profiles end so far beyond the expected wall [voxels]
constexpr double kCore = 0.4;      ///< of the wall's radius: the core

/// Values from `low` to `high`, evenly.
std::vector<double> steps(double low, double high, int count) {
    std::vector<double> values;
    for (int i = 0; i < count; ++i) values.push_back(low + (high - low) * i / (count - 1));
    return values;
}

double core_value(const SectionProfile& profile) {
    std::vector<double> core;
    for (std::size_t i = 0; i < profile.radii.size(); ++i)
        if (core.empty() || profile.radii[i] < kCore * profile.wall)
            core.push_back(profile.values[i]);
    return mean(core);
}

/// Of the contrast over the section, as a volume of length 1.
double integral_of(const SectionProfile& profile, double background) {
    double sum = 0.0;
    for (std::size_t i = 0; i < profile.radii.size(); ++i)
        sum += (profile.values[i] - background) * profile.radii[i];
    return sum * (profile.radii[1] - profile.radii[0]);
}

/// Where the profile changes most, between differences over one voxel. \param sign of the contrast
double steepest(const SectionProfile& profile, double sign) {
    constexpr std::size_t kOver = 4;  // steps of a profile in a voxel
    double most = 0.0, at = profile.wall;
    for (std::size_t i = 0; i + kOver < profile.radii.size(); ++i) {
        const double fall = sign * (profile.values[i] - profile.values[i + kOver]);
        if (fall <= most) continue;
        most = fall;
        at = 0.5 * (profile.radii[i] + profile.radii[i + kOver]);
    }
    return at;
}

ImageVerdict verdict_of(const ImageEvidence& evidence, const Narrowing& narrowing) {
    const double width = (evidence.lumen_radius - narrowing.found_radius) / narrowing.depth();
    if (evidence.misfit_falls < 0.6 * evidence.misfit_agrees && evidence.lumen_contrast < 0.9 &&
        width > 0.5)
        return ImageVerdict::ContrastFalls;
    if (evidence.misfit_agrees < 0.6 * evidence.misfit_falls && width < 0.5)
        return ImageVerdict::ImageAgrees;
    return ImageVerdict::CannotTell;
}

}  // namespace

std::string to_string(ImageVerdict verdict) {
    switch (verdict) {
        case ImageVerdict::ContrastFalls:
            return "contrast-falls";
        case ImageVerdict::ImageAgrees:
            return "image-agrees";
        case ImageVerdict::CannotTell:
            break;
    }
    return "cannot-tell";
}

std::optional<ImageEvidence> image_evidence(const Image& image, const std::vector<WallRing>& rings,
                                            const Narrowing& narrowing) {
    const double voxel = image.spacing().maxCoeff();
    const double around = kAround * voxel + std::max(0.0, narrowing.depth());
    const RadiusCourse course = radius_course(rings, narrowing.from, narrowing.to);
    if (course.along.empty()) return std::nullopt;
    const auto is_deep = [&](const WallRing& ring) {
        const double depth = course.expected_at(ring.along) - course.found_at(ring.along);
        return ring.is_whole() && ring.along >= narrowing.from && ring.along <= narrowing.to &&
               depth >= kDeepPart * narrowing.depth();
    };
    const double beyond = kBeside * narrowing.expected_radius;
    const auto is_beside = [&](const WallRing& ring) {
        const bool before = ring.along < narrowing.from && ring.along > narrowing.from - beyond;
        const bool after = ring.along > narrowing.to && ring.along < narrowing.to + beyond;
        return ring.is_whole() && (before || after);
    };
    const auto narrow = section_profile(image, rings, is_deep, around);
    const auto beside = section_profile(image, rings, is_beside, around);
    if (!narrow || !beside) return std::nullopt;
    const double shortest = image.spacing().minCoeff();
    const DiscFit healthy =
        fitted_disc(*beside, {.radii = steps(0.85 * beside->wall, 1.25 * beside->wall, 21),
                              .blurs = steps(0.3 * shortest, 1.6 * voxel, 14)});
    if (healthy.contrast == 0.0) return std::nullopt;
    // The wall found at the threshold is not quite the image's edge: so it is with the expected
    // one.
    const double offset = healthy.radius - beside->wall;
    const double expected = narrowing.expected_radius + offset;
    const DiscFit any = fitted_disc(
        *narrow,
        {.radii = steps(0.6 * narrow->wall, 1.25 * expected, 41), .blurs = {healthy.blur}});
    const DiscFit falls =
        fitted_disc(*narrow, {.radii = {expected}, .blurs = {healthy.blur}, .may_fall = true});
    const DiscFit agrees =
        fitted_disc(*narrow, {.radii = steps(0.6 * narrow->wall, 1.1 * expected, 31),
                              .blurs = {healthy.blur},
                              .contrast = healthy.contrast});
    ImageEvidence evidence;
    evidence.core_contrast =
        (core_value(*narrow) - any.background) / (core_value(*beside) - healthy.background);
    evidence.integral =
        integral_of(*narrow, any.background) / integral_of(*beside, healthy.background);
    evidence.edge_radius = steepest(*narrow, healthy.contrast);
    evidence.lumen_radius = any.radius - offset;
    evidence.lumen_contrast = any.contrast / healthy.contrast;
    evidence.misfit_falls = falls.misfit / std::abs(healthy.contrast);
    evidence.misfit_agrees = agrees.misfit / std::abs(healthy.contrast);
    evidence.verdict = verdict_of(evidence, narrowing);
    return evidence;
}

}  // namespace vesselbench
