#pragma once

#include <cstdint>
#include <span>

#include "workbench/project/bytes.h"

namespace vesselbench {

/// zstd at its fastest regular level, with a checksum of the content.
[[nodiscard]] Bytes compress(std::span<const std::byte> bytes);

/// \param size of the content, as stored beside it
/// \throw InvalidInput if the blob is damaged, its content has another size, or the size is more
/// than 40000 times the blob's (1000 times, above 256 MiB); nothing is then allocated
[[nodiscard]] Bytes decompress(std::span<const std::byte> blob, std::uint64_t size);

/// Stores the first bytes of all words first, then the second bytes, ...: numbers of similar size
/// compress better this way. A remainder shorter than a word stays at the end.
[[nodiscard]] Bytes shuffle(std::span<const std::byte> bytes, std::size_t word);
[[nodiscard]] Bytes unshuffle(std::span<const std::byte> bytes, std::size_t word);

}  // namespace vesselbench
