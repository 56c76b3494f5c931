#include "tests/support/forked_vessel.h"

#include <cmath>
#include <vector>

#include "geometry/kernel/edges.h"
#include "geometry/phantoms/exact_surface.h"
#include "geometry/phantoms/field.h"
#include "geometry/phantoms/phantom.h"

namespace vesselbench::test {

Surface forked_vessel(double left, double right, double scale) {
    const auto vessel = [&](const Vec3& to, double from, double radius) {
        return VesselShape{.points = {Vec3::Zero(), scale * to},
                           .radii = {scale * from, scale * radius},
                           .flat_ends = true};
    };
    const std::vector<PhantomPart> parts = {
        {.name = "trunk", .shape = vessel(Vec3(0, 0, -20), kForkTrunk, kForkTrunk)},
        {.name = "left", .shape = vessel(Vec3(-10, 0, 17), left, left), .blend = 0.3 * scale},
        {.name = "right", .shape = vessel(Vec3(10, 0, 17), right, right), .blend = 0.3 * scale}};
    const PhantomField field(parts);
    const Surface closed = exact_surface(field, field.bounds(), 0.35 * scale);
    std::vector<bool> keep;
    for (const Triangle& t : closed.triangles()) {
        const Vec3 middle =
            (closed.points()[t[0]] + closed.points()[t[1]] + closed.points()[t[2]]) / 3.0;
        keep.push_back(std::abs(middle.z()) < (middle.z() < 0.0 ? 18.0 : 14.0) * scale);
    }
    return select_triangles(closed, keep);
}

}  // namespace vesselbench::test
