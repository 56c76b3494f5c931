#include "tests/support/stack_phantoms.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "geometry/image/extract_surface.h"
#include "geometry/phantoms/imaging.h"
#include "geometry/phantoms/random.h"

namespace vesselbench::test {

namespace {

constexpr double kBlur = 0.6;

/// A carotid artery: trunk 8 mm wide, branches of 6 and 4.4 mm.
const std::vector<PhantomPart> kVessel = {
    {"trunk", VesselShape{{Vec3(0, 0, -40), Vec3(2, 1, -15), Vec3(0, 0, 0)}, {4, 4, 4}}, 0.0},
    {"wide", VesselShape{{Vec3(0, 0, 0), Vec3(-8, 3, 15), Vec3(-9, 5, 40)}, {3.5, 3, 3}}, 1.5},
    {"narrow", VesselShape{{Vec3(0, 0, 0), Vec3(7, -4, 14), Vec3(11, -7, 38)}, {3, 2.2, 2.2}},
     1.5}};

/// A strap of muscle 25 x 8 mm and 130 mm long, oblique as the sternocleidomastoid is.
const std::vector<PhantomPart> kMuscle = {
    {"a", VesselShape{{Vec3(-24, -12, -55), Vec3(-4, 2, 0), Vec3(12, 20, 55)}, {3, 4, 3}}, 0.0},
    {"b", VesselShape{{Vec3(-20, -9, -55), Vec3(1, 6, 0), Vec3(16, 23, 55)}, {3, 4.5, 3}}, 4.0},
    {"c", VesselShape{{Vec3(-16, -6, -55), Vec3(6, 10, 0), Vec3(20, 26, 55)}, {3, 4.5, 3}}, 4.0},
    {"d", VesselShape{{Vec3(-12, -3, -55), Vec3(11, 14, 0), Vec3(24, 29, 55)}, {3, 4, 3}}, 4.0}};

/// A compact organ with two lobes.
const std::vector<PhantomPart> kLiver = {{"right", SphereShape{Vec3(-22, 0, 0), 38}, 0.0},
                                         {"below", SphereShape{Vec3(-30, 6, -25), 27}, 20.0},
                                         {"middle", SphereShape{Vec3(14, -4, 12), 26}, 20.0},
                                         {"left", SphereShape{Vec3(44, -9, 18), 17}, 20.0}};

const Vec3 kVesselVoxel(0.7, 0.7, kSlices), kMuscleVoxel(0.9, 0.9, kSlices),
    kLiverVoxel(1.6, 1.6, kSlices);

constexpr std::array<double, 5> kRemovedShares = {1.0 / 16, 1.0 / 8, 1.0 / 4, 1.0 / 2, 1.0};

PhantomDescription described(const std::vector<PhantomPart>& parts, const Vec3& voxel) {
    PhantomDescription d;
    d.parts = parts;
    d.imaging.spacing = voxel;
    d.imaging.blur.setConstant(kBlur);
    return d;
}

}  // namespace

PhantomDescription vessel_in_slices() {
    return described(kVessel, kVesselVoxel);
}

PhantomDescription muscle_in_slices() {
    return described(kMuscle, kMuscleVoxel);
}

PhantomDescription organ_in_slices() {
    return described(kLiver, kLiverVoxel);
}

Eigen::Matrix3d random_rotation(std::uint64_t seed) {
    const Eigen::Vector4d q(normal_noise(seed, 0), normal_noise(seed, 1), normal_noise(seed, 2),
                            normal_noise(seed, 3));
    return Eigen::Quaterniond(q.normalized()).toRotationMatrix();
}

// Grids are centred on the phantom's box: a speck that no voxel sees shifts the box.
PhantomDescription random_sphere(std::uint64_t seed, const Vec3& spacing) {
    const double radius = 13.0 + 11.0 * uniform_noise(seed, 10);
    Vec3 speck(radius + 0.5, radius + 0.5, radius + 0.5);
    for (int a = 0; a < 3; ++a)
        speck[a] += 2.0 * spacing[a] * uniform_noise(seed, 11 + static_cast<std::uint64_t>(a));
    PhantomDescription d;
    d.parts = {{"sphere", SphereShape{Vec3::Zero(), radius}, 0.0},
               {"speck", SphereShape{speck, 1e-3}, 0.0}};
    d.imaging.spacing = spacing;
    d.imaging.blur.setConstant(0.5 * std::floor(3.0 * uniform_noise(seed, 14)));  // 0 to 1 mm
    return d;
}

CutSphere cut_sphere(std::uint64_t seed) {
    CutSphere cut;
    cut.description = random_sphere(seed, Vec3(1, 1, kSlices));
    cut.share = kRemovedShares[static_cast<std::size_t>(5.0 * uniform_noise(seed, 20))];
    cut.rotation = random_rotation(seed);
    const PhantomField field(cut.description.parts);
    const Image whole = phantom_mask(cut.description, field);
    int top = 0;
    for (int k = 0; k < whole.size[2]; ++k)
        for (std::size_t i = 0, o = whole.offset(0, 0, k); i < whole.offset(0, 0, 1); ++i)
            if ((*whole.voxels)[o + i] > 0.0F) top = k;
    // The disc of the topmost slice, and a rectangle with about the share of it.
    int count = 0;
    for (std::size_t i = 0, o = whole.offset(0, 0, top); i < whole.offset(0, 0, 1); ++i)
        count += (*whole.voxels)[o + i] > 0.0F ? 1 : 0;
    const double disc = std::sqrt(count / std::numbers::pi);
    const Vec3 centre = whole.to_index(Vec3::Zero());
    const double width = cut.share >= 0.25 ? disc : disc * std::sqrt(cut.share * std::numbers::pi);
    const int i0 = static_cast<int>(std::lround(cut.share == 1.0 ? 0.0 : centre.x())),
              j0 = static_cast<int>(std::lround(cut.share >= 0.5 ? 0.0 : centre.y())),
              reach = static_cast<int>(std::lround(width));
    const auto last = [&](int from, int axis) {
        const int end = whole.size[static_cast<std::size_t>(axis)] - 1;
        return cut.share >= 0.5 ? end : std::min(from + std::max(reach, 1) - 1, end);
    };
    cut.description.imaging.deletions = {
        {{i0, j0, top}, {last(i0, 0), last(j0, 1), whole.size[2] - 1}}};
    return cut;
}

Surface imaged(const PhantomDescription& d) {
    const Image image = phantom_image(d, PhantomField(d.parts));
    ExtractionParameters p;
    p.method = ExtractionMethod::Threshold;
    p.threshold = 500.0;
    return extract_surface(image, {}, p).surface;
}

Surface of_mask(const PhantomDescription& d) {
    ExtractionParameters p;
    p.method = ExtractionMethod::Labels;
    return extract_surface(phantom_mask(d, PhantomField(d.parts)), {}, p).surface;
}

Surface of_masked_intensities(const PhantomDescription& d) {
    const PhantomField field(d.parts);
    ExtractionParameters p;
    p.method = ExtractionMethod::Masked;
    p.threshold = 500.0;
    return extract_surface(phantom_image(d, field), phantom_mask(d, field), p).surface;
}

Surface turned(const Surface& surface, const Eigen::Matrix3d& rotation) {
    Positions points = surface.points();
    for (Vec3& p : points) p = rotation * p;
    return surface.with_positions(std::move(points));
}

double degrees_between(const Vec3& a, const Vec3& b) {
    const double angle = std::asin(std::min(1.0, a.normalized().cross(b.normalized()).norm()));
    return angle * 180.0 / std::numbers::pi;
}

double share_of_flat_faces(const Surface& surface) {
    const double limit = std::cos(std::numbers::pi / 180.0);
    const auto flat = std::count_if(
        surface.triangles().begin(), surface.triangles().end(), [&](const Triangle& t) {
            const Vec3 n = area_normal(surface.points(), t);
            return n.norm() > 0.0 && std::abs(n.z()) >= limit * n.norm();
        });
    return static_cast<double>(flat) / static_cast<double>(surface.triangle_count());
}

}  // namespace vesselbench::test
