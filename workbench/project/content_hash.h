#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace vesselbench {

/// SHA-256 of data added piece by piece.
class ContentHash {
public:
    ContentHash();
    ~ContentHash();
    ContentHash(const ContentHash&) = delete;
    ContentHash& operator=(const ContentHash&) = delete;

    void add(std::span<const std::byte> bytes);

    /// The digest in 64 hexadecimal digits; nothing may be added afterwards.
    [[nodiscard]] std::string hex();

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// SHA-256 of a text, as ContentHash::hex().
[[nodiscard]] std::string hash_of_text(std::string_view text);

/// SHA-256 of a file's content; of a folder: of the digests of its regular files, in the order of
/// their names.
/// \throw IoError if it cannot be read
[[nodiscard]] std::string hash_of_file(const std::filesystem::path& path);

}  // namespace vesselbench
