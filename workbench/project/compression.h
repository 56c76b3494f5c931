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
/// \param result of the same size
void unshuffle(std::span<const std::byte> bytes, std::size_t word, std::span<std::byte> result);

/// What several stored things together may hold: a file from a stranger must not demand more memory
/// than its size makes plausible.
/// \param size [bytes] of all contents
/// \param file [bytes] of the file that holds them
/// \param free [bytes] that any file may demand
/// \param ratio largest plausible ratio of the contents to the file [-]
/// \throw InvalidInput if the size is above both `free` and the ratio times the file's
void require_plausible(std::uint64_t size, std::uint64_t file, std::uint64_t free,
                       std::uint64_t ratio = 1000);

}  // namespace vesselbench
