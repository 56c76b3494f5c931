// The checks of our reading of thesis Sec. 5.3: a transcription of its text, without regard to
// speed, must agree with what smoothing/ computes.

#include <cmath>
#include <deque>
#include <limits>

#include <catch2/catch.hpp>
#include <tbb/global_control.h>

#include "geometry/formats/image_file.h"
#include "geometry/formats/surface_file.h"
#include "geometry/image/extract_surface.h"
#include "smoothing/context/caps.h"
#include "smoothing/context/staircase_weights.h"
#include "smoothing/context/staircases.h"
#include "tests/support/iso_surface.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

/// Eqs. 5.3 and 5.4, vertex by vertex: the orientation change.
std::vector<double> change_as_printed(const Surface& surface, const Vec3& stack) {
    const Positions& x = surface.points();
    std::vector<double> change(x.size(), 0.0);
    for (VertexId v = 0; v < x.size(); ++v) {
        double low = 2.0, high = -1.0;
        for (const Triangle& f : surface.triangles()) {
            if (f[0] != v && f[1] != v && f[2] != v) continue;
            const Vec3 n = (x[f[1]] - x[f[0]]).cross(x[f[2]] - x[f[0]]);
            if (!(n.norm() > 0.0)) continue;  // a face without area has no orientation
            const double theta = 1.0 - std::abs((n / n.norm()).dot(stack / stack.norm()));  // (5.3)
            low = std::min(low, theta);
            high = std::max(high, theta);
        }
        if (high >= low) change[v] = high - low;  // (5.4)
    }
    return change;
}

/// Distance to the closest staircase vertex that is connected within tau_max: a whole search from
/// every staircase vertex.
std::vector<double> distances_as_printed(const Surface& surface, const std::vector<bool>& staircase,
                                         double tau_max) {
    const Positions& x = surface.points();
    std::vector<double> distance(x.size(), kFar);
    for (VertexId s = 0; s < x.size(); ++s) {
        if (!staircase[s]) continue;
        std::vector<bool> seen(x.size(), false);
        std::deque<VertexId> queue{s};
        seen[s] = true;
        while (!queue.empty()) {
            const VertexId v = queue.front();
            queue.pop_front();
            distance[v] = std::min(distance[v], (x[v] - x[s]).norm());
            for (const VertexId u : surface.topology->rings().row(v))
                if (!seen[u] && (x[u] - x[s]).norm() <= tau_max) {
                    seen[u] = true;
                    queue.push_back(u);
                }
        }
    }
    return distance;
}

std::vector<double> weights_as_printed(const Surface& surface, const std::vector<double>& change,
                                       const StaircaseParameters& p) {
    const auto on_cap = [&](std::size_t v) { return !p.caps.empty() && p.caps[v] != 0; };
    std::vector<bool> staircase(change.size());
    for (std::size_t v = 0; v < change.size(); ++v)
        staircase[v] = change[v] > p.tau_theta && !on_cap(v);
    const auto d = distances_as_printed(surface, staircase, p.tau_max);
    double scale = p.tau_max;
    if (p.scaling == StaircaseScaling::Thesis) {
        scale = 0.0;
        for (const double value : d)
            if (value <= p.tau_max) scale = std::max(scale, value);
    }
    std::vector<double> weights;
    for (std::size_t v = 0; v < d.size(); ++v) {
        const double w = d[v] <= p.tau_max ? 1.0 - d[v] / scale : 0.0;             // (5.5)
        weights.push_back(on_cap(v) ? 0.0 : w * (1.0 - p.beta_min) + p.beta_min);  // (5.6), 5.3.4
    }
    return weights;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
    REQUIRE(a.size() == b.size());
    double largest = 0.0;
    for (std::size_t v = 0; v < a.size(); ++v) largest = std::max(largest, std::abs(a[v] - b[v]));
    return largest;
}

std::size_t count_above(const std::vector<double>& values, double limit) {
    return static_cast<std::size_t>(
        std::count_if(values.begin(), values.end(), [=](double value) { return value > limit; }));
}

/// A surface, the direction across its slices, and parameters that fit its size.
struct Sample {
    std::string name;
    Surface surface;
    Vec3 stack = Vec3::UnitZ();
    double tau_theta = 0.7, tau_max = 3.0;
};

/// All weights of a sample by both ways; 1e-12 apart at most.
void check_weights(const Sample& sample) {
    CAPTURE(sample.name);
    const Topology& topology = *sample.surface.topology;
    const Positions& points = sample.surface.points();
    const auto change = orientation_change(topology, points, sample.stack);
    const auto printed_change = change_as_printed(sample.surface, sample.stack);
    CHECK(largest_difference(change, printed_change) < 1e-12);
    CHECK(count_above(change, sample.tau_theta) > 100);
    const auto caps = cap_vertices(find_caps(sample.surface), points.size());
    const std::vector<StaircaseParameters> settings = {
        {.tau_theta = sample.tau_theta, .tau_max = sample.tau_max},
        {.tau_theta = sample.tau_theta, .tau_max = sample.tau_max, .beta_min = 0.1, .caps = caps},
        {.tau_theta = 0.6 * sample.tau_theta,
         .tau_max = 0.4 * sample.tau_max,
         .beta_min = 0.3,
         .scaling = StaircaseScaling::Thesis}};
    for (const StaircaseParameters& p : settings) {
        const auto weights = staircase_weights(topology, points, change, p);
        CHECK(largest_difference(weights, weights_as_printed(sample.surface, change, p)) < 1e-12);
        CHECK(count_above(weights, 0.99) > 100);
        CHECK(count_above(weights, p.beta_min) < weights.size());  // some lie beyond tau_max
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        CHECK((staircase_weights(topology, points, change, p) == weights));
    }
}

/// Marching cubes of some labels, as binary masks are drawn.
Sample mask_sample(const std::string& name, const std::vector<int>& labels, double tau_max) {
    const std::string path = shared_data("images/" + name);
    if (path.empty()) return {};
    const Image image = read_image(path);
    return {.name = name,
            .surface = extract_surface(image, std::nullopt,
                                       {.method = ExtractionMethod::Labels, .labels = labels})
                           .surface,
            .stack = sampling_of(image).axes.col(2),
            .tau_theta = 0.5,
            .tau_max = tau_max};
}

/// Lines 4 to 20 of Algorithm 1 for one region: the surface goes on to one side at all border
/// vertices.
bool one_direction(const Surface& surface, const Cap& cap) {
    std::vector<bool> in_region(surface.vertex_count(), false);
    for (const VertexId v : cap.vertices) in_region[v] = true;
    Vec3 normal = Vec3::Zero();
    for (const TriangleId t : cap.triangles)
        normal += area_normal(surface.points(), surface.triangles()[t]);
    normal.normalize();
    int orientation = 0;
    for (const VertexId v : cap.rim) {
        double farthest = 0.0, edge = 0.0;
        for (const VertexId u : surface.topology->rings().row(v)) {
            if (in_region[u]) continue;
            const Vec3 way = surface.points()[u] - surface.points()[v];
            edge = std::max(edge, way.norm());
            if (std::abs(way.dot(normal)) > std::abs(farthest)) farthest = way.dot(normal);
        }
        if (std::abs(farthest) <= 1e-3 * edge) continue;  // in the region's plane: no direction
        const int sign = farthest > 0.0 ? 1 : -1;
        if (orientation != 0 && sign != orientation) return false;
        orientation = sign;
    }
    return orientation != 0;
}

Surface without_patches(const Surface& surface) {
    return make_surface(surface.points(), {surface.triangles().begin(), surface.triangles().end()});
}

}  // namespace

SCENARIO("Staircase weights are those of Sec. 5.3 as printed", "[smoothing][staircases]") {
    const auto ball = [](const Vec3& p) {  // in slices 3 mm apart, as in a binary mask
        const double z = 3.0 * std::round(p.z() / 3.0);
        return std::max(Vec3(p.x(), p.y(), z).norm() - 9.0, std::abs(p.z()) - 9.0);
    };
    const Surface terraced = iso_surface(ball, {Vec3(-11, -11, -11), Vec3(11, 11, 11)}, 0.83);
    const double tau_max = GENERATE(1.0, 1.8), tau_theta = GENERATE(0.3, 0.7);
    check_weights({"ball", terraced, Vec3(0, 0, -5), tau_theta, tau_max});
}

SCENARIO("Staircase weights of real masks are those of Sec. 5.3 as printed",
         "[smoothing][staircases]") {
    for (const Sample& sample :
         {mask_sample("topcow_mr_roi_003_labels.nii.gz", {1}, 0.6),
          mask_sample("totalseg_example_labels_117.nii.gz", {5}, 4.5),
          mask_sample("totalseg_aorta_true_false_lumen.nii.gz", {1, 2}, 2.0)})
        if (!sample.name.empty()) check_weights(sample);
}

SCENARIO("Staircase weights of real raw surfaces are those of Sec. 5.3 as printed",
         "[smoothing][staircases]") {
    for (const char* name : {"vmtk_aorta_surface_open_ends.stl", "jk_carotid_left_lumen_raw.stl",
                             "vampy_aneurisk_C0015_artery.vtp"}) {
        const std::string path = shared_data(std::string("surfaces/") + name);
        if (path.empty()) return;
        check_weights({.name = name,
                       .surface = read_surface(path, LengthUnit::Millimetre).surface,
                       .stack = Vec3(0.2, -0.3, 1.0),
                       .tau_theta = 0.3,
                       .tau_max = 0.8});
    }
}

SCENARIO("Every cap found on real surfaces satisfies Algorithm 1 as printed", "[smoothing][caps]") {
    std::size_t found = 0;
    const auto check = [&](const std::string& name, const Surface& surface) {
        CAPTURE(name);
        for (const Cap& cap : find_caps(without_patches(surface))) {
            CHECK(cap.triangles.size() >= 10);
            CHECK(one_direction(surface, cap));
            ++found;
        }
    };
    for (const auto& [name, labels] : {std::pair("totalseg_example_labels_117.nii.gz", 52),
                                       std::pair("totalseg_example_labels_117.nii.gz", 5),
                                       std::pair("totalseg_aorta_true_false_lumen.nii.gz", 1)})
        if (const Sample sample = mask_sample(name, {labels}, 1.0); !sample.name.empty())
            check(name, sample.surface);
    for (const char* name :
         {"jk_carotid_left_lumen_capped.stl", "vmtk_aorta_surface.stl", "sv_demo_aortofemoral.vtp"})
        if (const std::string path = shared_data(std::string("surfaces/") + name); !path.empty())
            check(name, read_surface(path, LengthUnit::Millimetre).surface);
    if (!shared_data("README.md").empty()) CHECK(found >= 4);
}
