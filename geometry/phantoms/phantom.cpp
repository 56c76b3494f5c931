#include "geometry/phantoms/phantom.h"

#include <utility>

#include "geometry/phantoms/exact_surface.h"
#include "geometry/phantoms/field.h"
#include "geometry/phantoms/imaging.h"
#include "geometry/phantoms/random.h"

namespace vesselbench {

Phantom make_phantom(const PhantomDescription& description, const Progress& progress) {
    const PhantomField field(description.parts);
    const auto surface_box = [&](const PhantomField& f) {
        Eigen::AlignedBox3d box = f.bounds();
        return Eigen::AlignedBox3d(box.min() - Vec3::Constant(2.3 * description.surface_edge),
                                   box.max() + Vec3::Constant(2.3 * description.surface_edge));
    };
    const auto surface_of = [&](const PhantomField& f, const Progress& part) {
        return exact_surface(f, surface_box(f), description.surface_edge, part);
    };
    Phantom phantom;
    phantom.image = phantom_image(description, field, progress.part(0.0, 0.4));
    phantom.mask = phantom_mask(description, field, progress.part(0.4, 0.6));
    phantom.exact = surface_of(field, progress.part(0.6, 0.9));
    if (description.surface_noise > 0.0) {
        Positions noisy = phantom.exact.points();
        for (std::size_t v = 0; v < noisy.size(); ++v) {
            progress.check_cancelled();
            noisy[v] += description.surface_noise * normal_noise(description.seed, v) *
                        field.gradient(noisy[v]).normalized();
        }
        phantom.noisy = phantom.exact.with_positions(std::move(noisy));
    }
    if (!description.neighbours.empty()) {
        const PhantomField other(description.neighbours);
        phantom.neighbour = surface_of(other, progress.part(0.9, 1.0));
    }
    return phantom;
}

}  // namespace vesselbench
