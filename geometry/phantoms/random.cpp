#include "geometry/phantoms/random.h"

#include <cmath>
#include <numbers>

namespace vesselbench {

namespace {

std::uint64_t split_mix(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15ULL;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
    return x ^ (x >> 31);
}

}  // namespace

double uniform_noise(std::uint64_t seed, std::uint64_t index) {
    return static_cast<double>(split_mix(split_mix(seed) ^ index) >> 11) * 0x1.0p-53;
}

double normal_noise(std::uint64_t seed, std::uint64_t index) {
    const double a = 1.0 - uniform_noise(seed, 2 * index);
    const double b = uniform_noise(seed, 2 * index + 1);
    return std::sqrt(-2.0 * std::log(a)) * std::cos(2.0 * std::numbers::pi * b);
}

}  // namespace vesselbench
