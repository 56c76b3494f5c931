#include "geometry/formats/vtk_xml_check.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <sstream>

#include "geometry/formats/image_bytes.h"
#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

/// Largest content of a compressed byte [bytes]: zlib's limit, and far above LZ4's.
constexpr std::uint64_t kZlibRatio = 1032;
constexpr std::uint64_t kLzmaRatio = 8000;

/// The text of an attribute (`offset="12"`) of a tag; nothing if it has none.
std::optional<std::string_view> attribute(std::string_view tag, const std::string& key) {
    const std::string start = " " + key + "=\"";
    auto at = tag.find(start);
    if (at == std::string_view::npos) return std::nullopt;
    at += start.size();
    return tag.substr(at, tag.find('"', at) - at);
}

std::optional<std::uint64_t> number(std::optional<std::string_view> text) {
    std::uint64_t value = 0;
    if (!text) return std::nullopt;
    const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), value);
    if (error != std::errc{} || end != text->data() + text->size()) return std::nullopt;
    return value;
}

/// The first bytes of a base64 text.
std::string decoded(std::string_view text, std::size_t wanted) {
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : text) {
        const auto digit = kDigits.find(c);
        if (digit == std::string_view::npos || bytes.size() >= wanted) break;
        bits = (bits << 6U) | static_cast<std::uint32_t>(digit);
        if ((count += 6) < 8) continue;
        count -= 8;
        bytes += static_cast<char>((bits >> static_cast<unsigned>(count)) & 0xffU);
    }
    return bytes;
}

class Checker {
public:
    Checker(std::string_view bytes, const std::string& name) : name_(name) {
        const auto appended = bytes.find("<AppendedData");
        head_ = bytes.substr(0, appended);
        if (appended != std::string_view::npos) {
            const std::string_view rest = bytes.substr(appended);
            const auto begin = rest.find('_');
            if (begin == std::string_view::npos) damaged("its appended data is missing");
            raw_ = attribute(rest.substr(0, begin), "encoding") == "raw";
            data_ = rest.substr(begin + 1);
            data_ = data_.substr(0, data_.rfind("</AppendedData"));
        }
        const std::string_view file = tag_at(head_.find("<VTKFile"));
        wide_ = attribute(file, "header_type") == "UInt64";
        big_endian_ = attribute(file, "byte_order") == "BigEndian";
        const std::string_view compressor = attribute(file, "compressor").value_or("");
        compressed_ = !compressor.empty();
        zlib_ = compressor.find("ZLib") != std::string_view::npos;
        ratio_ = !compressed_                                        ? 1
                 : compressor.find("LZMA") != std::string_view::npos ? kLzmaRatio
                                                                     : kZlibRatio;
        size_ = bytes.size();
    }

    void check_counts() const {
        for (const char* key : {"NumberOfPoints", "NumberOfVerts", "NumberOfLines",
                                "NumberOfStrips", "NumberOfPolys", "NumberOfTuples"}) {
            const std::string start = std::string(" ") + key + "=\"";
            for (auto at = head_.find(start); at != std::string_view::npos;
                 at = head_.find(start, at + 1)) {
                const auto count = number(attribute(head_.substr(at), key));
                if (!count || *count / ratio_ > size_)
                    damaged(std::string("it announces more data (") + key + ") than it can hold");
            }
        }
    }

    void check_arrays() const {
        for (auto at = head_.find("<DataArray"); at != std::string_view::npos;
             at = head_.find("<DataArray", at + 1)) {
            const std::string_view tag = tag_at(at);
            const auto format = attribute(tag, "format");
            if (format == "appended")
                check_appended(tag);
            else if (format == "binary")
                check_inline(head_.substr(at + tag.size()));
        }
    }

    /// Lists of texts: VTK writes as many as the data holds, beyond the announced number too.
    void check_texts() const {
        for (auto at = head_.find("<Array"); at != std::string_view::npos;
             at = head_.find("<Array", at + 1)) {
            const std::string_view tag = tag_at(at);
            const auto texts = number(attribute(tag, "NumberOfTuples"));
            const auto parts = number(attribute(tag, "NumberOfComponents").value_or("1"));
            if (!texts || !parts) damaged("a list of texts does not announce its length");
            if (texts_in(tag, head_.substr(at + tag.size())) > *texts * std::min(*parts, size_))
                damaged("a list of texts is longer than announced");
        }
    }

private:
    /// Texts of a list, each of which ends with a zero. \param rest of the file after the tag
    [[nodiscard]] std::uint64_t texts_in(std::string_view tag, std::string_view rest) const {
        const auto format = attribute(tag, "format");
        const std::string_view text =
            rest.substr(0, rest.find('<', 1)).substr(rest.empty() ? 0 : 1);
        if (format == "appended") {
            check_appended(tag);
            return zeros(content(data_.substr(*number(attribute(tag, "offset"))), raw_));
        }
        if (format == "binary") {
            const auto first = text.find_first_not_of(" \t\r\n");
            if (first == std::string_view::npos) return 0;
            check_block(text.substr(first), false);
            return zeros(content(text.substr(first), false));
        }
        std::istringstream words{std::string(text)};
        std::uint64_t count = 0;
        for (std::string word; words >> word;) count += std::strtol(word.c_str(), nullptr, 10) == 0;
        return count;
    }

    static std::uint64_t zeros(const std::string& bytes) {
        return static_cast<std::uint64_t>(std::ranges::count(bytes, '\0'));
    }

    /// The bytes of a checked block.
    [[nodiscard]] std::string content(std::string_view block, bool raw) const {
        const std::size_t word = wide_ ? 8 : 4;
        const auto plain = [&](std::string_view part, std::size_t wanted) {
            std::string bytes = raw ? std::string(part.substr(0, wanted)) : decoded(part, wanted);
            if (bytes.size() < wanted) damaged("a list of texts is cut off");
            bytes.resize(wanted);
            return bytes;
        };
        const std::uint64_t first = *word_at(plain(block, word), 0);
        if (!compressed_) return plain(block, word + first).substr(word);
        if (first == 0) return {};
        if (!zlib_) damaged("its texts are compressed in an unusual way (use zlib)");
        const std::size_t head_bytes = (3 + first) * word;
        const std::string head = plain(block, head_bytes);
        block.remove_prefix(std::min(block.size(), raw ? head_bytes : (head_bytes + 2) / 3 * 4));
        std::uint64_t stored = 0;
        for (std::uint64_t i = 0; i < first; ++i) stored += *word_at(head, 3 + i);
        const std::string all = plain(block, stored);
        std::string result;
        std::size_t at = 0;
        for (std::uint64_t i = 0; i < first; ++i) {
            const std::uint64_t bytes = *word_at(head, 3 + i), last = *word_at(head, 2);
            const bool is_short = i + 1 == first && last != 0;
            result += inflated(std::string_view(all).substr(at, bytes),
                               is_short ? last : *word_at(head, 1), name_);
            at += bytes;
        }
        return result;
    }

    [[noreturn]] void damaged(const std::string& what) const {
        throw InvalidInput(name_ + ": " + what + ": it is damaged; copy or download it again");
    }

    [[nodiscard]] std::string_view tag_at(std::size_t at) const {
        if (at == std::string_view::npos) return {};
        return head_.substr(at, head_.find('>', at) - at);
    }

    void check_appended(std::string_view tag) const {
        const auto offset = number(attribute(tag, "offset"));
        if (!offset || *offset >= data_.size()) damaged("an array's appended data is missing");
        check_block(data_.substr(*offset), raw_);
    }

    void check_inline(std::string_view text) const {
        const auto first = text.find_first_not_of("> \t\r\n");
        if (first == std::string_view::npos) damaged("an array's data is missing");
        text = text.substr(first, text.find('<', first) - first);
        if (!text.empty()) check_block(text, false);
    }

    /// The first words of a block of data, which VTK trusts.
    void check_block(std::string_view block, bool raw) const {
        const std::size_t word = wide_ ? 8 : 4;
        const std::uint64_t available = raw ? block.size() : block.size() / 4 * 3;
        const auto head = [&](std::size_t words) {
            return raw ? std::string(block.substr(0, words * word)) : decoded(block, words * word);
        };
        const auto first = word_at(head(1), 0);
        if (!first) damaged("an array's data is missing");
        if (!compressed_) {
            if (*first > available) damaged("an array is longer than the file");
            return;
        }
        const std::uint64_t blocks = *first;
        if (blocks == 0) return;
        if (blocks > available / word) damaged("an array's data is missing");
        const std::string words = head(3 + blocks);
        const auto size = word_at(words, 1), last = word_at(words, 2);
        std::uint64_t stored = 0;
        for (std::uint64_t i = 0; i < blocks; ++i) {
            const auto part = word_at(words, 3 + i);
            if (!part || *part > available - stored) damaged("an array's data is missing");
            stored += *part;
        }
        if (!size || !last || *size == 0 || *last > *size ||
            *size > available * ratio_ / blocks + kSmallBlock)
            damaged("an array's blocks have an impossible size");
    }

    [[nodiscard]] std::optional<std::uint64_t> word_at(const std::string& bytes,
                                                       std::size_t index) const {
        const std::size_t word = wide_ ? 8 : 4, at = index * word;
        if (at + word > bytes.size()) return std::nullopt;
        std::uint64_t value = 0;
        for (std::size_t i = 0; i < word; ++i) {
            const std::size_t place = big_endian_ ? at + i : at + word - 1 - i;
            value = (value << 8U) | static_cast<unsigned char>(bytes[place]);
        }
        return value;
    }

    /// VTK's usual block size [bytes], which short arrays announce as well.
    static constexpr std::uint64_t kSmallBlock = std::uint64_t{1} << 20;

    const std::string& name_;
    std::string_view head_, data_;
    bool raw_ = false, wide_ = false, big_endian_ = false, compressed_ = false, zlib_ = false;
    std::uint64_t ratio_ = 1, size_ = 0;
};

}  // namespace

void require_vtk_xml(std::string_view bytes, const std::string& name) {
    if (bytes.find("<VTKFile") == std::string_view::npos)
        throw InvalidInput(name + " is not a VTK XML file: '<VTKFile' is missing");
    if (bytes.rfind("</VTKFile>") == std::string_view::npos)
        throw InvalidInput(
            name + " ends without '</VTKFile>': it is truncated; copy or download it again");
    const Checker checker(bytes, name);
    checker.check_counts();
    checker.check_arrays();
    checker.check_texts();
}

}  // namespace vesselbench
