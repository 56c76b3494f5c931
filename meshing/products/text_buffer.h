#pragma once

#include <charconv>
#include <string>
#include <string_view>

namespace vesselbench {

/// A fast text builder; numbers do not depend on the locale.
class TextBuffer {
public:
    TextBuffer& operator<<(std::string_view text) {
        text_ += text;
        return *this;
    }

    TextBuffer& operator<<(char c) {
        text_ += c;
        return *this;
    }

    TextBuffer& operator<<(std::size_t number) {
        char digits[24];
        text_.append(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
        return *this;
    }

    TextBuffer& operator<<(std::uint32_t number) { return *this << std::size_t{number}; }

    TextBuffer& operator<<(int number) {
        char digits[16];
        text_.append(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
        return *this;
    }

    /// Shortest text that reads back to the same bits.
    TextBuffer& operator<<(double number) {
        char digits[32];
        text_.append(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
        return *this;
    }

    [[nodiscard]] const std::string& text() const { return text_; }

private:
    std::string text_;
};

}  // namespace vesselbench
