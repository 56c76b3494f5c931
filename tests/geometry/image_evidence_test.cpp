#include "geometry/vessel/narrowing/image_evidence.h"

#include <catch2/catch.hpp>

#include "geometry/image/extract_surface.h"
#include "geometry/image/threshold.h"
#include "geometry/phantoms/imaging.h"
#include "geometry/vessel/narrowing/named_narrowing.h"
#include "geometry/vessel/narrowing/section_profile.h"

using namespace vesselbench;

namespace {

/// A tube of 2 mm radius along an oblique axis, narrower by 40 % or darker in its middle.
PhantomDescription tube(bool stenosis, bool dip) {
    const Vec3 axis = Vec3(0.3, 0.2, 0.9).normalized();
    VesselShape vessel;
    for (int i = 0; i <= 18; ++i) {
        vessel.points.push_back((2.0 * i - 18.0) * axis);
        const double away = std::abs(i - 9) / 3.0;
        vessel.radii.push_back(stenosis && away < 1.0 ? 2.0 - 0.8 * (1.0 - away * away) : 2.0);
    }
    PhantomDescription description;
    description.parts = {{"tube", vessel, 0.0}};
    description.imaging.spacing = Vec3::Constant(0.5);
    description.imaging.blur = Vec3::Constant(0.5);
    description.imaging.noise = 30.0;
    if (dip)
        description.imaging.dips = {
            {.part = "tube", .centre = Vec3::Zero(), .reach = 6.0, .core = 0.4, .wall = 0.65}};
    return description;
}

struct Judged {
    Image image;
    NamedNarrowing named;
    ImageEvidence evidence;
};

Judged judged(const PhantomDescription& description, double sign = 1.0) {
    Judged result{.image = phantom_image(description, PhantomField(description.parts))};
    ExtractionParameters parameters{.method = ExtractionMethod::Threshold};
    parameters.threshold = bright_threshold(result.image);
    const Surface surface = extract_surface(result.image, std::nullopt, parameters).surface;
    auto voxels = std::make_shared<std::vector<float>>(*result.image.voxels);
    for (float& value : *voxels) value *= static_cast<float>(sign);
    result.image.voxels = voxels;
    result.named = narrowing_at(surface, {.at = Vec3::Zero(), .parameters = {.resolution = 0.3}});
    result.evidence =
        image_evidence(result.image, result.named.rings, result.named.narrowing).value();
    return result;
}

}  // namespace

SCENARIO("The image tells a fall of the contrast from a narrow lumen", "[geometry][narrowing]") {
    const double sign = GENERATE(1.0, -1.0);  // dark vessels are judged alike
    const Judged dip = judged(tube(false, true), sign);
    CHECK(dip.evidence.verdict == ImageVerdict::ContrastFalls);
    CHECK(dip.evidence.core_contrast == Approx(0.6).margin(0.06));
    const Judged stenosis = judged(tube(true, false), sign);
    CHECK(stenosis.evidence.verdict == ImageVerdict::ImageAgrees);
    CHECK(stenosis.evidence.core_contrast > 0.9);
    CHECK(stenosis.evidence.lumen_radius == Approx(1.2).epsilon(0.15));
    CHECK(stenosis.evidence.edge_radius == Approx(1.2).epsilon(0.2));
    CHECK(stenosis.evidence.integral == Approx(0.36).margin(0.08));
}

SCENARIO("An image that does not show the place says nothing", "[geometry][narrowing]") {
    Judged dip = judged(tube(false, true));
    dip.image.index_to_patient(0, 3) += 1000.0;
    CHECK_FALSE(image_evidence(dip.image, dip.named.rings, dip.named.narrowing).has_value());
}

SCENARIO("A blurred disc keeps its integral and is half at a straight edge",
         "[geometry][narrowing]") {
    CHECK(blurred_disc(0.0, 3.0, 0.1) == Approx(1.0).epsilon(1e-3));
    CHECK(blurred_disc(0.0, 1.0, 1.0) == Approx(1.0 - std::exp(-0.5)).epsilon(1e-3));
    CHECK(blurred_disc(50.0, 50.0, 1.0) == Approx(0.5).margin(0.01));
    double integral = 0.0;
    for (double r = 0.005; r < 12.0; r += 0.01) integral += blurred_disc(r, 2.0, 1.0) * r * 0.01;
    CHECK(integral == Approx(2.0).epsilon(0.01));
}
