#include "geometry/phantoms/phantom.h"

#include <utility>

#include "geometry/phantoms/exact_surface.h"
#include "geometry/phantoms/field.h"
#include "geometry/phantoms/imaging.h"
#include "geometry/phantoms/random.h"

namespace vesselbench {

Phantom make_phantom(const PhantomDescription& description) {
    const PhantomField field(description.parts);
    const auto surface_box = [&](const PhantomField& f) {
        Eigen::AlignedBox3d box = f.bounds();
        return Eigen::AlignedBox3d(box.min() - Vec3::Constant(2.3 * description.surface_edge),
                                   box.max() + Vec3::Constant(2.3 * description.surface_edge));
    };
    Phantom phantom;
    phantom.image = phantom_image(description, field);
    phantom.mask = phantom_mask(description, field);
    phantom.exact = exact_surface(field, surface_box(field), description.surface_edge);
    if (description.surface_noise > 0.0) {
        Positions noisy = phantom.exact.points();
        for (std::size_t v = 0; v < noisy.size(); ++v)
            noisy[v] += description.surface_noise * normal_noise(description.seed, v) *
                        field.gradient(noisy[v]).normalized();
        phantom.noisy = phantom.exact.with_positions(std::move(noisy));
    }
    if (!description.neighbours.empty()) {
        const PhantomField other(description.neighbours);
        phantom.neighbour = exact_surface(other, surface_box(other), description.surface_edge);
    }
    return phantom;
}

}  // namespace vesselbench
