#pragma once

#include <cstdint>

namespace vesselbench {

/// Standard normal numbers as a function of (seed, index) alone: the same bits for any number of
/// threads and with any standard library. Mixing by SplitMix64 (Steele et al. 2014), normals by Box
/// and Muller (1958).
[[nodiscard]] double normal_noise(std::uint64_t seed, std::uint64_t index);

/// Uniform in [0, 1), by the same scheme.
[[nodiscard]] double uniform_noise(std::uint64_t seed, std::uint64_t index);

}  // namespace vesselbench
