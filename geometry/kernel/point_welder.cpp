#include "geometry/kernel/point_welder.h"

#include <bit>
#include <cstdint>
#include <limits>

namespace vesselbench {

namespace {

constexpr VertexId kFree = std::numeric_limits<VertexId>::max();

std::uint64_t mixed(std::uint64_t x) {  // finalizer of splitmix64
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
    return x ^ (x >> 31);
}

std::size_t hash_of(const Vec3& p) {
    std::uint64_t hash = 0x9e3779b97f4a7c15ULL;
    for (int k = 0; k < 3; ++k) hash = mixed(hash + std::bit_cast<std::uint64_t>(p[k] + 0.0));
    return hash;
}

}  // namespace

PointWelder::PointWelder(std::size_t expected_points) {
    slots_.assign(std::bit_ceil(2 * expected_points + 16), kFree);
    points_.reserve(expected_points);
}

VertexId PointWelder::add(const Vec3& point) {
    if (2 * points_.size() >= slots_.size()) grow();
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = hash_of(point) & mask;
    for (; slots_[slot] != kFree; slot = (slot + 1) & mask)
        if (points_[slots_[slot]] == point) return slots_[slot];
    slots_[slot] = static_cast<VertexId>(points_.size());
    points_.push_back(point);
    return slots_[slot];
}

void PointWelder::grow() {
    slots_.assign(2 * slots_.size(), kFree);
    const std::size_t mask = slots_.size() - 1;
    for (VertexId v = 0; v < points_.size(); ++v) {
        std::size_t slot = hash_of(points_[v]) & mask;
        while (slots_[slot] != kFree) slot = (slot + 1) & mask;
        slots_[slot] = v;
    }
}

}  // namespace vesselbench
