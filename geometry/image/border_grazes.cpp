#include "geometry/image/border_grazes.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "geometry/image/voxel_band.h"
#include "geometry/image/voxels.h"

namespace vesselbench {

namespace {

/// u, v of a voxel in a layer.
using LayerPlace = std::pair<int, int>;

/// A wall that touches the border spreads behind it: the section within some voxels to the sides
/// grows by the first factor from the contact to two layers behind it, and by the second one from
/// the next layer on. That of a vessel whose outermost layer is ragged grows at once only.
constexpr double kSpread = 1.6, kSpreadOn = 1.1;
constexpr int kReach = 3;
constexpr int kLayers = 4;

/// The voxels of a layer parallel to a side of the image.
class Layer {
public:
    /// \param side 2 a, 2 a + 1: at the start and the end of axis a \param behind [voxels]
    Layer(const Image& mask, int side, int behind)
        : mask_(mask),
          axis_(static_cast<std::size_t>(side / 2)),
          u_((axis_ + 1) % 3),
          v_((axis_ + 2) % 3),
          at_(side % 2 == 0 ? behind : mask.size[axis_] - 1 - behind) {}

    [[nodiscard]] int width() const { return mask_.size[u_]; }

    [[nodiscard]] int height() const { return mask_.size[v_]; }

    [[nodiscard]] std::size_t place(int u, int v) const {
        return static_cast<std::size_t>(v) * static_cast<std::size_t>(width()) +
               static_cast<std::size_t>(u);
    }

    [[nodiscard]] bool is_in(int u, int v) const {
        if (u < 0 || v < 0 || u >= width() || v >= height()) return false;
        VoxelIndex at{};
        at[axis_] = at_;
        at[u_] = u;
        at[v_] = v;
        return is_inside(mask_.at(at[0], at[1], at[2]));
    }

private:
    const Image& mask_;
    std::size_t axis_, u_, v_;
    int at_;
};

/// Calls visit(u, v) for the places at most `reach` from one.
template <class Visit>
void around(LayerPlace at, int reach, const Visit& visit) {
    for (int v = at.second - reach; v <= at.second + reach; ++v)
        for (int u = at.first - reach; u <= at.first + reach; ++u) visit(u, v);
}

/// The connected contact at a place; its voxels are marked as seen.
std::vector<LayerPlace> contact_at(const Layer& border, LayerPlace first,
                                   std::vector<std::uint8_t>& seen) {
    std::vector<LayerPlace> contact = {first};
    seen[border.place(first.first, first.second)] = 1;
    for (std::size_t i = 0; i < contact.size(); ++i)
        around(contact[i], 1, [&](int u, int v) {
            if (!border.is_in(u, v) || seen[border.place(u, v)] != 0) return;
            seen[border.place(u, v)] = 1;
            contact.emplace_back(u, v);
        });
    return contact;
}

/// Voxels of a layer near a contact.
double section_near(const std::vector<LayerPlace>& contact, const Layer& layer) {
    std::vector<std::uint8_t> seen(static_cast<std::size_t>(layer.width()) *
                                   static_cast<std::size_t>(layer.height()));
    double section = 0.0;
    for (const auto& at : contact)
        around(at, kReach, [&](int u, int v) {
            if (layer.is_in(u, v) && std::exchange(seen[layer.place(u, v)], 1) == 0) section += 1.0;
        });
    return section;
}

bool is_graze(const std::vector<LayerPlace>& contact, const Image& mask, int side) {
    const auto section = [&](int behind) {
        return section_near(contact, Layer(mask, side, behind));
    };
    return section(2) > kSpread * static_cast<double>(contact.size()) &&
           section(3) > kSpreadOn * section(1);
}

/// By place in a side's layer: 1 where a wall touches it.
struct Grazes {
    std::vector<std::uint8_t> touched;
    std::size_t count = 0;
};

Grazes grazes_of(const Image& mask, int side) {
    const Layer border(mask, side, 0);
    Grazes grazes;
    std::vector<std::uint8_t> seen(static_cast<std::size_t>(border.width()) *
                                   static_cast<std::size_t>(border.height()));
    grazes.touched = seen;
    if (mask.size[static_cast<std::size_t>(side / 2)] < 2 * kLayers) return grazes;
    for (int v = 0; v < border.height(); ++v)
        for (int u = 0; u < border.width(); ++u) {
            if (!border.is_in(u, v) || seen[border.place(u, v)] != 0) continue;
            const auto contact = contact_at(border, {u, v}, seen);
            if (!is_graze(contact, mask, side)) continue;
            ++grazes.count;
            for (const auto& at : contact) grazes.touched[border.place(at.first, at.second)] = 1;
        }
    return grazes;
}

/// By side: 1 where the mask gets a layer of voxels.
using WidenedSides = std::array<int, 6>;

/// The mask with a voxel beyond the sides: outside where a wall touches the border, else as the
/// border.
Image with_border(const Image& mask, const std::array<Grazes, 6>& grazes,
                  const WidenedSides& sides) {
    Image wider = mask;
    Vec3 first;
    for (std::size_t a = 0; a < 3; ++a) {
        wider.size[a] += sides[2 * a] + sides[2 * a + 1];
        first[static_cast<Eigen::Index>(a)] = -sides[2 * a];
    }
    wider.index_to_patient.topRightCorner<3, 1>() = mask.to_patient(first);
    const auto value = [&](const VoxelIndex& at) {
        VoxelIndex nearest = at;
        for (std::size_t a = 0; a < 3; ++a)
            nearest[a] = std::min(std::max(at[a], 0), mask.size[a] - 1);
        for (std::size_t a = 0; a < 3; ++a) {
            if (nearest[a] == at[a]) continue;
            const std::size_t side = 2 * a + (at[a] < 0 ? 0 : 1), u = (a + 1) % 3, v = (a + 2) % 3;
            const Layer border(mask, static_cast<int>(side), 0);
            if (grazes[side].touched[border.place(nearest[u], nearest[v])] != 0) return 0.0f;
        }
        return mask.at(nearest[0], nearest[1], nearest[2]);
    };
    std::vector<float> voxels;
    voxels.reserve(wider.voxel_count());
    for (int k = -sides[4]; k < mask.size[2] + sides[5]; ++k)
        for (int j = -sides[2]; j < mask.size[1] + sides[3]; ++j)
            for (int i = -sides[0]; i < mask.size[0] + sides[1]; ++i)
                voxels.push_back(value({i, j, k}));
    return with_voxels(std::move(wider), std::move(voxels));
}

}  // namespace

FreedMask without_grazes(const Image& mask, FreedSides sides) {
    std::array<Grazes, 6> grazes;
    WidenedSides widened{};
    FreedMask freed{.mask = mask};
    for (std::size_t side = 0; side < 6; ++side) {
        grazes[side] = grazes_of(mask, static_cast<int>(side));
        freed.grazes += grazes[side].count;
        widened[side] = sides == FreedSides::All || grazes[side].count > 0 ? 1 : 0;
    }
    if (freed.grazes > 0) freed.mask = with_border(mask, grazes, widened);
    return freed;
}

}  // namespace vesselbench
