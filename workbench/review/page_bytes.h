#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace vesselbench {

/// Appends numbers as the review page reads them: each as its difference to the one before it (in
/// the numbers' own range), all lowest bytes first, then all second ones ...; so that neighbours in
/// space give long runs of equal bytes.
void append_plane(std::string& bytes, std::span<const std::uint16_t> numbers);
void append_plane(std::string& bytes, std::span<const std::uint32_t> numbers);

/// Little endian.
void append_number(std::string& bytes, std::uint16_t number);
void append_number(std::string& bytes, std::uint32_t number);

/// The bytes in zlib's format, as base64 text.
/// \throw AlgorithmFailure if there is no memory for it
[[nodiscard]] std::string packed_text(const std::string& bytes);

}  // namespace vesselbench
