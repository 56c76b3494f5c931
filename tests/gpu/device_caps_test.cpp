#include "gpu/device_caps.h"

#include <algorithm>

#include <catch2/catch.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/errors.h"
#include "smoothing/filters/laplace.h"
#include "tests/gpu/device_support.h"
#include "tests/support/shapes.h"
#include "tests/support/stack_phantoms.h"
#include "tests/support/surface_facts.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

/// Number of vertices that only one of them assigns to a cap.
std::size_t differing(const std::vector<Cap>& a, const std::vector<Cap>& b, std::size_t count) {
    const auto in_a = cap_vertices(a, count), in_b = cap_vertices(b, count);
    std::size_t others = 0;
    for (std::size_t v = 0; v < count; ++v) others += in_a[v] != in_b[v] ? 1 : 0;
    return others;
}

Surface smoothed(const Surface& surface, int iterations) {
    return surface.with_positions(
        laplace(*surface.topology, surface.points(), {.lambda = 0.5}, {.iterations = iterations}));
}

/// Surfaces with flat ends, with the slice steps and voxel facets of masks; raw and slightly
/// smoothed.
std::vector<NamedSurface> surfaces_with_ends() {
    std::vector<NamedSurface> all = varied_surfaces();
    all.push_back({"closed tube", closed_tube(3.0, 20.0, 48, 60)});
    all.push_back({"two tubes", merged(closed_tube(3.0, 20.0, 48, 60), cube(8.0))});
    all.push_back({"cube", cube(10.0)});
    all.push_back({"vessel in slices", of_mask(vessel_in_slices())});
    all.push_back({"muscle in slices", imaged(muscle_in_slices())});
    for (const int iterations : {3, 30})
        all.push_back({"smoothed vessel", smoothed(of_mask(vessel_in_slices()), iterations)});
    for (const char* name : {"jk_carotid_left_lumen_raw.stl", "vmtk_aorta_surface.stl"})
        if (const std::string path = shared_data(std::string("surfaces/") + name); !path.empty())
            all.push_back({"raw " + std::string(name), read_surface(path).surface});
    return all;
}

}  // namespace

SCENARIO("The device finds the same caps as the CPU", "[gpu][caps]") {
    const auto test = test_device();
    if (!test) return;
    std::size_t found_at_all = 0;
    for (const auto& [name, surface] : surfaces_with_ends()) {
        const auto device = uploaded(*test, surface);
        for (const CapParameters& parameters :
             {CapParameters{}, CapParameters{.flat_angle_deg = 15.0, .smallest_faces = 2},
              CapParameters{.flat_angle_deg = 1.0, .smallest_faces = 60}}) {
            CAPTURE(name, parameters.flat_angle_deg);
            const auto wanted = find_caps(surface, parameters);
            const auto found = find_caps(*device, parameters);
            CHECK(differing(found, wanted, surface.vertex_count()) == 0);
            REQUIRE(found.size() == wanted.size());
            for (std::size_t i = 0; i < found.size(); ++i) {
                CHECK(found[i].triangles == wanted[i].triangles);
                CHECK(found[i].rim == wanted[i].rim);
                CHECK((found[i].normal - wanted[i].normal).norm() < 1e-12);
            }
            found_at_all += found.size();
        }
    }
    CHECK(found_at_all > 10);
}

SCENARIO("Patches are caps on the device, too", "[gpu][caps]") {
    const auto test = test_device();
    if (!test) return;
    Surface tube = closed_tube(3.0, 20.0, 48, 60);
    PatchLabels labels(tube.triangle_count(), 0);
    for (TriangleId t = 0; t < 40; ++t) labels[t] = 1;
    tube.patches = {{.name = "wall"}, {.name = "inlet", .kind = PatchKind::Inlet}};
    tube.patch_labels = std::make_shared<const PatchLabels>(std::move(labels));
    const auto wanted = find_caps(tube);
    const auto found = find_caps(*uploaded(*test, tube));
    CHECK(std::ranges::count_if(found, [](const Cap& c) { return c.from_patch; }) == 1);
    REQUIRE(found.size() == wanted.size());
    for (std::size_t i = 0; i < found.size(); ++i) CHECK(found[i].triangles == wanted[i].triangles);
}

SCENARIO("A failing search for caps reports it", "[gpu][caps]") {
    auto test = test_device();
    if (!test) return;
    const Surface sphere = icosphere(5.0, 3);
    CHECK_THROWS_AS(find_caps(*uploaded(*test, sphere), {.flat_angle_deg = 50.0}), InvalidInput);
    CHECK_THROWS_AS(find_caps(*uploaded(*test, sphere), {.smallest_faces = 0}), InvalidInput);
    Device dying = current_device();
    dying.lost = [] { return true; };
    CHECK_THROWS_AS(find_caps(DeviceSurface(dying, sphere)), GpuUnavailable);
    Device small = test->device;
    small.limits.largest_storage_block = 24 * sphere.triangle_count() - 1;
    small.limits.largest_view = 100;
    CHECK_THROWS_WITH(find_caps(DeviceSurface(small, sphere)),
                      Catch::Contains("the device allows"));
    test->reports.reset();
    Device broken = test->device;
    auto shaders = *broken.shaders;
    shaders["join_parts.comp"] = "#version 430 core\nthis is no shader";
    broken.shaders = &shaders;
    CHECK_THROWS_WITH(find_caps(DeviceSurface(broken, sphere)), Catch::Contains("join_parts"));
}
