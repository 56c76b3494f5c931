#include "geometry/image/simple_voxel.h"

#include <cstddef>
#include <cstdlib>
#include <vector>

namespace vesselbench {

namespace {

constexpr std::size_t kCentre = 13;

struct Step {
    int i = 0, j = 0, k = 0;
};

Step step_to(std::size_t at) {
    const int n = static_cast<int>(at);
    return {n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
}

/// Axes along which two voxels differ by one; more than 3: they do not touch.
int apart(const Step& a, const Step& b) {
    const int i = std::abs(a.i - b.i), j = std::abs(a.j - b.j), k = std::abs(a.k - b.k);
    return i > 1 || j > 1 || k > 1 ? 4 : i + j + k;
}

/// Connected parts of one side around the centre that touch the centre in its own sense.
/// \param faces connected by faces, within the 18-neighbourhood; else by any contact
int parts_around(const VoxelSurroundings& inside, bool side, bool faces) {
    const auto belongs = [&](std::size_t at) {
        return at != kCentre && inside[at] == side && (!faces || apart(step_to(at), Step{}) <= 2);
    };
    const int reach = faces ? 1 : 3;
    std::array<bool, 27> seen{};
    int parts = 0;
    for (std::size_t start = 0; start < inside.size(); ++start) {
        if (!belongs(start) || seen[start] || apart(step_to(start), Step{}) > reach) continue;
        ++parts;
        std::vector<std::size_t> front = {start};
        seen[start] = true;
        while (!front.empty()) {
            const std::size_t at = front.back();
            front.pop_back();
            for (std::size_t next = 0; next < inside.size(); ++next) {
                if (seen[next] || !belongs(next) || apart(step_to(at), step_to(next)) > reach)
                    continue;
                seen[next] = true;
                front.push_back(next);
            }
        }
    }
    return parts;
}

}  // namespace

bool is_simple(const VoxelSurroundings& inside) {
    for (const bool faces : {false, true})
        if (parts_around(inside, true, faces) != 1 || parts_around(inside, false, !faces) != 1)
            return false;
    return true;
}

}  // namespace vesselbench
