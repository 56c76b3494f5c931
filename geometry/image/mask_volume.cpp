#include "geometry/image/mask_volume.h"

#include "geometry/image/voxel_band.h"
#include "geometry/kernel/measure.h"

namespace vesselbench {

double volume_of_voxels(const Image& mask) {
    const auto share = [](int at, int size) { return at == 0 || at == size - 1 ? 0.5 : 1.0; };
    double count = 0.0;
    for (int k = 0; k < mask.size[2]; ++k)
        for (int j = 0; j < mask.size[1]; ++j) {
            const double of_line = share(k, mask.size[2]) * share(j, mask.size[1]);
            for (int i = 0; i < mask.size[0]; ++i)
                if (is_inside(mask.at(i, j, k))) count += of_line * share(i, mask.size[0]);
        }
    return count * mask.spacing().prod();
}

double wall_area(const Surface& surface) {
    double sum = 0.0;
    for (const PatchMeasures& patch : measure_patches(surface))
        if (patch.kind == PatchKind::Wall) sum += patch.area;
    return sum;
}

}  // namespace vesselbench
