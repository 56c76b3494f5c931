#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "geometry/kernel/errors.h"

namespace vesselbench {

using Bytes = std::vector<std::byte>;

/// Takes bytes, piece by piece.
using ByteSink = std::function<void(std::span<const std::byte>)>;

/// Appends numbers, texts and arrays to a byte string, little-endian as in memory.
class ByteWriter {
public:
    template <class T>
    requires std::is_trivially_copyable_v<T>

    void put(const T& value) { append(std::as_bytes(std::span(&value, 1))); }

    void put_text(const std::string& text) {
        put<std::uint64_t>(text.size());
        append(std::as_bytes(std::span(text)));
    }

    void append(std::span<const std::byte> bytes) {
        bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    }

    [[nodiscard]] const Bytes& bytes() const { return bytes_; }

    [[nodiscard]] Bytes take() { return std::move(bytes_); }

private:
    Bytes bytes_;
};

/// Reads them back. Every read is checked: truncated data throws InvalidInput.
class ByteReader {
public:
    explicit ByteReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

    template <class T>
    requires std::is_trivially_copyable_v<T>

    [[nodiscard]] T get() {
        T value;
        std::memcpy(&value, get_bytes(sizeof(T)).data(), sizeof(T));
        return value;
    }

    [[nodiscard]] std::string get_text() {
        const auto text = get_bytes(get<std::uint64_t>());
        return {reinterpret_cast<const char*>(text.data()), text.size()};
    }

    /// The next `count` bytes. \throw InvalidInput if there are fewer
    [[nodiscard]] std::span<const std::byte> get_bytes(std::uint64_t count) {
        if (count > bytes_.size()) throw InvalidInput("the stored data is truncated");
        const auto head = bytes_.first(static_cast<std::size_t>(count));
        bytes_ = bytes_.subspan(static_cast<std::size_t>(count));
        return head;
    }

    [[nodiscard]] std::size_t left() const { return bytes_.size(); }

private:
    std::span<const std::byte> bytes_;
};

}  // namespace vesselbench
