#pragma once

#include <cstddef>
#include <string>

namespace vesselbench::test {

/// What packed_text() packed. \param size of the bytes; fails the test if there are others
[[nodiscard]] std::string unpacked(const std::string& text, std::size_t size);

}  // namespace vesselbench::test
