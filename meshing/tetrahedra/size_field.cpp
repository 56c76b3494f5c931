#include "meshing/tetrahedra/size_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geometry/kernel/statistics.h"

namespace vesselbench {

namespace {

constexpr double kLargestGrid = 4e6;  // nodes; 32 MiB
constexpr float kUnset = std::numeric_limits<float>::max();

struct Offset {
    int i, j, k;
    float length;
};

// The 13 neighbours that come before a node in scan order; negated, those that come after it.
std::vector<Offset> half_neighbourhood() {
    std::vector<Offset> offsets;
    for (int k = -1; k <= 0; ++k)
        for (int j = -1; j <= 1; ++j)
            for (int i = -1; i <= 1; ++i)
                if (k < 0 || j < 0 || (j == 0 && i < 0))
                    offsets.push_back(
                        {i, j, k, static_cast<float>(std::sqrt(double(i * i + j * j + k * k)))});
    return offsets;
}

}  // namespace

std::vector<double> vertex_edge_lengths(const Surface& surface) {
    std::vector<double> lengths(surface.vertex_count(), 0.0);
    const CompressedRows& rings = surface.topology->rings();
    for (std::size_t v = 0; v < lengths.size(); ++v) {
        for (const auto u : rings.row(v))
            lengths[v] += (surface.points()[u] - surface.points()[v]).norm();
        if (!rings.row(v).empty()) lengths[v] /= static_cast<double>(rings.row(v).size());
    }
    return lengths;
}

SizeField::SizeField(const Surface& surface, double growth) {
    Eigen::AlignedBox3d box;
    for (const Vec3& p : surface.points()) box.extend(p);
    spacing_ = mean(vertex_edge_lengths(surface));
    const Vec3 extent = box.sizes();
    const auto nodes = [&] { return ((extent / spacing_).array() + 4.0).prod(); };
    while (nodes() > kLargestGrid) spacing_ *= 1.1;
    origin_ = box.min() - Vec3::Constant(spacing_);
    for (int k = 0; k < 3; ++k) count_[k] = static_cast<int>(std::ceil(extent[k] / spacing_)) + 3;
    nodes_.assign(index(0, 0, count_[2]), {kUnset, kUnset});
    seed(surface);
    sweep(growth);
}

void SizeField::seed(const Surface& surface) {
    const std::vector<double> lengths = vertex_edge_lengths(surface);
    for (std::size_t v = 0; v < lengths.size(); ++v) {
        const Vec3 q = (surface.points()[v] - origin_) / spacing_;
        Node& node = nodes_[index(int(std::lround(q.x())), int(std::lround(q.y())),
                                  int(std::lround(q.z())))];
        node.size = std::min(node.size, static_cast<float>(lengths[v]));
        node.distance = 0.0F;
    }
}

void SizeField::sweep(double growth) {
    const auto offsets = half_neighbourhood();
    const auto relax = [&](int i, int j, int k, int sign) {
        Node& node = nodes_[index(i, j, k)];
        for (const Offset& o : offsets) {
            const int a = i + sign * o.i, b = j + sign * o.j, c = k + sign * o.k;
            if (a < 0 || b < 0 || c < 0 || a >= count_[0] || b >= count_[1] || c >= count_[2])
                continue;
            const Node& near = nodes_[index(a, b, c)];
            if (near.distance == kUnset) continue;
            const float step = o.length * static_cast<float>(spacing_);
            node.size = std::min(node.size, near.size + static_cast<float>(growth) * step);
            node.distance = std::min(node.distance, near.distance + step);
        }
    };
    for (int round = 0; round < 2; ++round) {
        for (int k = 0; k < count_[2]; ++k)
            for (int j = 0; j < count_[1]; ++j)
                for (int i = 0; i < count_[0]; ++i) relax(i, j, k, 1);
        for (int k = count_[2] - 1; k >= 0; --k)
            for (int j = count_[1] - 1; j >= 0; --j)
                for (int i = count_[0] - 1; i >= 0; --i) relax(i, j, k, -1);
    }
}

double SizeField::size_of(const Node& node, double factor) {
    const double depth = std::min(1.0, node.distance / (2.0 * node.size));
    return node.size * (1.0 + (factor - 1.0) * depth);
}

double SizeField::at(const Vec3& place, double factor) const {
    const Vec3 q = (place - origin_) / spacing_;
    std::array<int, 3> low;
    Vec3 t;
    for (int k = 0; k < 3; ++k) {
        low[k] = std::clamp(static_cast<int>(std::floor(q[k])), 0, count_[k] - 2);
        t[k] = std::clamp(q[k] - low[k], 0.0, 1.0);
    }
    double size = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const int i = corner & 1, j = corner >> 1 & 1, k = corner >> 2;
        const double weight =
            (i ? t.x() : 1 - t.x()) * (j ? t.y() : 1 - t.y()) * (k ? t.z() : 1 - t.z());
        if (weight > 0.0)
            size += weight * size_of(nodes_[index(low[0] + i, low[1] + j, low[2] + k)], factor);
    }
    return size;
}

}  // namespace vesselbench
