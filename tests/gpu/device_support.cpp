#include "tests/gpu/device_support.h"

#include <algorithm>
#include <random>

#include <catch2/catch.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/vessel/repair/repair.h"
#include "tests/gpu/watched_context.h"
#include "tests/support/shapes.h"
#include "tests/support/skip.h"

namespace vesselbench::test {

namespace {

void fail_by_report(const std::string& text) {
    FAIL_CHECK("OpenGL reported: " << text);
}

/// Without coincident triangles, whose summed normals are rounding errors only.
Surface repaired(const Surface& surface) {
    return repair(surface).surface;
}

}  // namespace

std::optional<TestDevice> test_device() {
    try {
        TestDevice test;
        test.reports = std::make_unique<DebugOutput>(fail_by_report);
        return test;
    } catch (const GpuUnavailable& error) {
        skip(error.what());
        return std::nullopt;
    }
}

HeldDevice watched_device() {
    auto context = std::make_shared<WatchedContext>();
    return {std::move(context), current_device()};
}

std::shared_ptr<const DeviceSurface> uploaded(const TestDevice& test, const Surface& surface) {
    return std::make_shared<const DeviceSurface>(test.device, surface);
}

std::vector<NamedSurface> varied_surfaces() {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> offset(-0.1, 0.1);
    const Vec3 centre(100.0, -250.0, 40.0);
    std::vector<NamedSurface> all{
        {"noisy sphere",
         mapped(icosphere(10.0, 4, centre),
                [&](const Vec3& p) { return Vec3(p + 0.1 * offset(random) * (p - centre)); })},
        {"open tube", open_tube(2.0, 30.0, 40, 60)}};
    for (const char* name : {"v4a_ideal_bifurcation_aneurysm.stl", "vampy_left_atrium.vtp",
                             "jk_carotid_left_lumen_raw.stl", "vmtk_aorta_surface_open_ends.stl"})
        if (const std::string path = shared_data(std::string("surfaces/") + name); !path.empty())
            all.push_back({name, repaired(read_surface(path).surface)});
    return all;
}

std::vector<double> relative_distances(const Positions& a, const Positions& b) {
    const double diagonal = bounds(a).diagonal();
    std::vector<double> distances(a.size());
    for (std::size_t v = 0; v < a.size(); ++v) distances[v] = (a[v] - b[v]).norm() / diagonal;
    std::ranges::sort(distances);
    return distances;
}

}  // namespace vesselbench::test
