#pragma once

#include <string>

#include "tests/forest/dice.h"

namespace vesselbench::fuzz {

/// Damages a file in one to four places: bits, bytes and words set to extremes, numbers of its text
/// replaced, sizes and counts changed, parts removed, repeated, exchanged or taken from `other`,
/// the end cut off, brackets nested deep. The same dice give the same result.
/// \param other of the same format, maybe the same
[[nodiscard]] std::string mutated(std::string bytes, const std::string& other, forest::Dice& dice);

/// gzip's form of the bytes.
[[nodiscard]] std::string gzipped(const std::string& bytes);

/// The content of a gzip file; empty if it is none.
[[nodiscard]] std::string ungzipped(const std::string& bytes);

}  // namespace vesselbench::fuzz
