#include "geometry/kernel/surface_key.h"

#include <cstdint>
#include <string>
#include <vector>

#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

ContentKey key_of_positions(const Positions& positions) {
    static_assert(sizeof(Vec3) == 3 * sizeof(double));
    return content_key(std::as_bytes(std::span<const Vec3>(positions)));
}

ContentKey key_of_patches(const std::vector<Patch>& patches) {
    std::string text;
    for (const Patch& patch : patches) text += to_string(patch.kind) + ' ' + patch.name + '\0';
    return content_key(std::span<const char>(text));
}

}  // namespace

ContentKey shape_key(const Surface& surface, DerivedCache& cache) {
    if (surface.empty()) throw InvalidInput("the surface is empty");
    const ContentKey positions =
        cache.key_of(surface.positions, [&] { return key_of_positions(surface.points()); });
    return content_key({surface.topology->key(), positions});
}

ContentKey shape_key(const Topology& topology, const Positions& positions) {
    return content_key({topology.key(), key_of_positions(positions)});
}

ContentKey shape_key(const Positions& positions, std::span<const Triangle> triangles) {
    return content_key({topology_key(triangles, positions.size()), key_of_positions(positions)});
}

ContentKey surface_key(const Surface& surface, DerivedCache& cache) {
    const ContentKey shape = shape_key(surface, cache);
    const ContentKey labels = cache.key_of(surface.patch_labels, [&] {
        return content_key(std::span<const std::uint16_t>(*surface.patch_labels));
    });
    return content_key({shape, labels, key_of_patches(surface.patches)});
}

}  // namespace vesselbench
