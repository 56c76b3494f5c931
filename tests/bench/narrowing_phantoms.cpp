#include "tests/bench/narrowing_phantoms.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "geometry/image/extract_surface.h"
#include "geometry/image/threshold.h"
#include "geometry/kernel/statistics.h"
#include "geometry/kernel/surface_distance.h"
#include "geometry/phantoms/imaging.h"
#include "tests/forest/dice.h"
#include "tests/forest/ends.h"
#include "tests/forest/grow.h"

namespace vesselbench::bench {

namespace {

using namespace forest;

constexpr double kLeastVoxels = 6.0;     ///< diameter of the thinnest vessel
constexpr double kMostVoxels = 0.3e6;    ///< of an image with cubic ones
constexpr double kLineStep = 1.0;        ///< of a vessel's points [diameters]; with a fault, half
constexpr std::size_t kMostPlanted = 2;  ///< in one tree

double bell(double x) {
    return std::abs(x) < 1.0 ? 0.5 * (1.0 + std::cos(std::numbers::pi * x)) : 0.0;
}

Plan plan_of(Dice& dice, std::uint64_t seed) {
    Plan plan;
    plan.seed = seed;
    plan.kind = CaseKind::IntensityImage;
    plan.ends = dice.whole(3, 6);
    plan.trunk = dice.between(4.0, 8.0);
    plan.exponent = dice.between(2.4, 3.0);
    plan.tortuosity = dice.chance(0.3) ? 0.5 : 0.2;
    plan.sacs = dice.chance(0.25) ? 1 : 0;
    return plan;
}

/// Free range of a branch: away from its furcations and its tip [mm].
std::pair<double, double> free_range(const Branch& branch) {
    const double radius = branch.line.back().radius;
    return {branch.free_from + radius, branch.length - (branch.to_node ? 3.0 : 2.0) * radius};
}

std::vector<PlantedNarrowing> places_in(const Tree& tree, PhantomFault fault, Dice& dice) {
    std::vector<PlantedNarrowing> places;
    for (std::size_t b = 0; b < tree.branches.size() && places.size() < kMostPlanted; ++b) {
        const auto [low, high] = free_range(tree.branches[b]);
        const double radius = at_abscissa(tree.branches[b].line, 0.5 * (low + high)).radius;
        if (high - low < 10.0 * radius) continue;
        const double reach = std::min(2.0 * radius * dice.between(1.0, 2.5), 0.3 * (high - low));
        const double middle = dice.between(low + 1.2 * reach, high - 1.2 * reach);
        const LinePoint at = at_abscissa(tree.branches[b].line, middle);
        if (std::ranges::any_of(tree.sacs, [&](const Sac& sac) {
                return (sac.centre - at.at).norm() < sac.radius + reach + 2.0 * at.radius;
            }))
            continue;
        const double share = dice.between(0.1, 0.6);
        const Vec3 aside = dice.across(tangent_at(tree.branches[b].line, middle));
        const bool to_one_side = dice.chance(0.5);
        places.push_back({.branch = b,
                          .middle = middle,
                          .reach = reach,
                          .centre = at.at,
                          .radius = at.radius,
                          .share = fault == PhantomFault::Stenosis ? share : 0.0,
                          .aside = to_one_side ? aside : Vec3(Vec3::Zero())});
    }
    return places;
}

/// The point of the lumen's axis, with a stenosis if one is planted there.
LinePoint lumen_at(const Branch& branch, const PlantedNarrowing* place, double s) {
    LinePoint p = at_abscissa(branch.line, s);
    if (place == nullptr) return p;
    const double narrowed = place->share * bell((s - place->middle) / place->reach);
    p.at += narrowed * p.radius * place->aside;
    p.radius *= 1.0 - narrowed;
    return p;
}

VesselShape shape_of(const Branch& branch, const PlantedNarrowing* place) {
    VesselShape shape;
    const double step = (place != nullptr ? 1.0 : 2.0) * kLineStep * branch.line.back().radius;
    const int steps = std::max(2, static_cast<int>(branch.length / step));
    for (int i = 0; i <= steps; ++i) {
        const LinePoint p = lumen_at(branch, place, branch.length * i / steps);
        shape.points.push_back(p.at);
        shape.radii.push_back(p.radius);
    }
    return shape;
}

PhantomDescription description_of(const Tree& tree, const std::vector<PlantedNarrowing>& places,
                                  PhantomFault fault, double voxel, Dice& dice) {
    PhantomDescription description;
    for (std::size_t b = 0; b < tree.branches.size(); ++b) {
        const auto place = std::ranges::find(places, b, &PlantedNarrowing::branch);
        const double blend = b == 0 ? 0.0 : 0.5 * tree.branches[b].line.back().radius;
        description.parts.push_back(
            {"vessel_" + std::to_string(b),
             shape_of(tree.branches[b], place != places.end() ? &*place : nullptr), blend});
    }
    for (const Sac& sac : tree.sacs)
        description.parts.push_back({"sac", SphereShape{sac.centre, sac.radius}, sac.blend});
    PhantomImaging& imaging = description.imaging;
    const double slice = dice.chance(0.5) ? 1.0 : 1.5;
    imaging.spacing = Vec3(voxel / slice, voxel / slice, voxel);
    imaging.margin = 4.0 * voxel;
    imaging.blur = dice.between(0.5, 1.3) * imaging.spacing;
    imaging.noise = dice.between(10.0, 60.0);
    imaging.inhomogeneity = dice.between(0.0, 0.15);
    for (const PlantedNarrowing& place : places) {
        const double core = dice.between(0.3, 0.47), wall = core + dice.between(0.0, 0.5);
        if (fault != PhantomFault::Dip) continue;
        imaging.dips.push_back({.part = "vessel_" + std::to_string(place.branch),
                                .centre = place.centre,
                                .reach = place.reach,
                                .core = core,
                                .wall = wall});
    }
    return description;
}

Surface extracted(const Image& image, bool local) {
    ExtractionParameters parameters;
    parameters.method = ExtractionMethod::Threshold;
    parameters.threshold = bright_threshold(image);
    parameters.local_levels = local;
    parameters.with_topology = false;
    return extract_surface(image, std::nullopt, parameters).surface;
}

/// Radius of the circle of the section's area; 0 where a direction has no wall.
double section_radius(const SurfaceDistance& wall, const Vec3& centre, const Vec3& tangent,
                      double reach) {
    constexpr int kAngles = 48;
    Eigen::Index smallest = 0;
    tangent.cwiseAbs().minCoeff(&smallest);
    const Vec3 first = tangent.cross(Vec3::Unit(smallest)).normalized();
    const Vec3 second = tangent.cross(first);
    double sum = 0.0;
    for (int k = 0; k < kAngles; ++k) {
        const double turn = 2.0 * std::numbers::pi * k / kAngles;
        const auto hit =
            wall.first_hit(centre, std::cos(turn) * first + std::sin(turn) * second, reach);
        if (!hit || !hit->from_inside) return 0.0;
        sum += hit->distance * hit->distance;
    }
    return std::sqrt(sum / kAngles);
}

}  // namespace

std::string to_string(PhantomFault fault) {
    return fault == PhantomFault::Dip        ? "dip"
           : fault == PhantomFault::Stenosis ? "stenosis"
                                             : "clean";
}

PhantomFault fault_from(const std::string& name) {
    for (const PhantomFault fault :
         {PhantomFault::Dip, PhantomFault::Stenosis, PhantomFault::Clean})
        if (to_string(fault) == name) return fault;
    throw std::invalid_argument("no such fault: " + name);
}

NarrowingPhantom::NarrowingPhantom(PhantomFault fault, std::uint64_t seed) {
    Dice dice(seed);
    // The first tree of the seed that an image of few voxels shows, and that has room.
    for (std::uint64_t attempt = 0; planted.empty(); ++attempt) {
        if (attempt == 1000) throw std::runtime_error("no tree of this seed fits an image");
        tree_ = grow(plan_of(dice, 1000 * seed + attempt));
        for (Branch& branch : tree_.branches)
            branch.line = part_of(branch.line, 0.0, branch.length);
        voxel = 2.0 * thinnest_radius(tree_) / dice.between(kLeastVoxels, 9.0);
        if (box_of(tree_).volume() < kMostVoxels * voxel * voxel * voxel)
            planted = places_in(tree_, fault, dice);
    }
    PhantomDescription description = description_of(tree_, planted, fault, voxel, dice);
    description.seed = seed;
    if (fault == PhantomFault::Clean) planted.clear();
    image = phantom_image(description, PhantomField(description.parts));
}

Surface NarrowingPhantom::surface() const {
    return extracted(image, false);
}

Surface NarrowingPhantom::local_surface() const {
    return extracted(image, true);
}

std::vector<NarrowingPhantom::Ratio> NarrowingPhantom::ratios(const Surface& surface,
                                                              const PlantedNarrowing& place) const {
    const Branch& branch = tree_.branches[place.branch];
    const auto [low, high] = free_range(branch);
    const SurfaceDistance wall(surface);
    std::vector<Ratio> ratios;
    for (double s = low; s <= high; s += 0.15 * place.radius) {
        const LinePoint p = at_abscissa(branch.line, s);
        const double found = section_radius(wall, lumen_at(branch, &place, s).at,
                                            tangent_at(branch.line, s), 3.0 * p.radius);
        ratios.push_back({s, found / p.radius, p.radius});
    }
    return ratios;
}

double NarrowingPhantom::share(const Surface& surface, const PlantedNarrowing& place) const {
    std::vector<double> beside;
    double least = 1.0;
    for (const Ratio& r : ratios(surface, place)) {
        if (std::abs(r.along - place.middle) < place.reach)
            least = std::min(least, r.ratio);
        else if (r.ratio > 0.0)
            beside.push_back(r.ratio);
    }
    return beside.empty() ? 0.0 : 1.0 - least / median(std::move(beside));
}

double NarrowingPhantom::radius_error(const Surface& surface, const PlantedNarrowing& place) const {
    double sum = 0.0, count = 0.0;
    for (const Ratio& r : ratios(surface, place)) {
        if (std::abs(r.along - place.middle) >= place.reach) continue;
        const double error = (1.0 - r.ratio) * r.radius;
        sum += error * error;
        count += 1.0;
    }
    return count > 0.0 ? std::sqrt(sum / count) : 0.0;
}

std::size_t NarrowingPhantom::moved_outside(const Surface& before, const Surface& after,
                                            const PlantedNarrowing& place) const {
    std::size_t count = 0;
    for (std::size_t v = 0; v < before.vertex_count(); ++v)
        if (before.points()[v] != after.points()[v] &&
            (before.points()[v] - place.centre).norm() > 3.0 * place.reach + 6.0 * place.radius)
            ++count;
    return count;
}

}  // namespace vesselbench::bench
