#include "geometry/formats/vtk_xml_check.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <limits>
#include <optional>
#include <sstream>

#include "geometry/formats/image_bytes.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/printable.h"

namespace vesselbench {

namespace {

/// Largest content of a compressed byte [bytes]: zlib's limit, and far above LZ4's.
constexpr std::uint64_t kZlibRatio = 1032;
constexpr std::uint64_t kLzmaRatio = 8000;

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
    Checker(std::string_view bytes, const std::vector<VtkXmlElement>& elements,
            const std::string& name)
        : bytes_(bytes), elements_(elements), name_(name) {
        if (elements.back().name == "AppendedData") {
            raw_ = attribute(elements.back(), "encoding") == "raw";
            data_ = bytes.substr(content_at(elements.back()));
            if (!data_.starts_with('_')) damaged("its appended data is missing");
            data_.remove_prefix(1);
            data_ = data_.substr(0, data_.rfind("</AppendedData"));
        }
        const VtkXmlElement& file = elements.front();
        wide_ = attribute(file, "header_type") == "UInt64";
        big_endian_ = attribute(file, "byte_order") == "BigEndian";
        const std::string_view compressor = attribute(file, "compressor").value_or("");
        compressed_ = !compressor.empty();
        zlib_ = compressor.find("ZLib") != std::string_view::npos;
        ratio_ = !compressed_                                        ? 1
                 : compressor.find("LZMA") != std::string_view::npos ? kLzmaRatio
                                                                     : kZlibRatio;
    }

    void check_counts() const {
        for (const VtkXmlElement& element : elements_) {
            for (const char* key :
                 {"NumberOfPoints", "NumberOfVerts", "NumberOfLines", "NumberOfStrips",
                  "NumberOfPolys", "NumberOfCells", "NumberOfTuples"}) {
                const auto text = attribute(element, key);
                const auto count = number(text);
                if (text && (!count || *count / ratio_ > bytes_.size()))
                    damaged(std::string("it announces more data (") + key + ") than it can hold");
            }
            check_components(element);
        }
    }

    /// Whatever the element is called: VTK takes any element for an array where it expects one.
    void check_arrays() const {
        for (const VtkXmlElement& element : elements_) {
            const bool is_list = element.name == "Array" || attribute(element, "type") == "String";
            if (is_appended(element))
                check_appended(element);
            else if (attribute(element, "format") == "binary" && !is_list)
                check_inline(content_of(element));
            if (is_list) check_texts(element);
        }
    }

private:
    /// VTK allocates any number of components.
    void check_components(const VtkXmlElement& element) const {
        constexpr std::uint64_t kMost = 1000;
        const auto text = attribute(element, "NumberOfComponents");
        const std::uint64_t count = text ? number(text).value_or(0) : 1;
        if (count < 1 || count > kMost)
            throw InvalidInput(name_ + " announces an array with " + shortened(printable(*text)) +
                               " numbers per point or cell: it is damaged; copy or download it "
                               "again");
    }

    /// VTK goes by the offset, whatever the format says.
    static bool is_appended(const VtkXmlElement& element) {
        return attribute(element, "offset") || attribute(element, "format") == "appended";
    }

    /// Lists of texts: VTK writes as many as the data holds, beyond the announced number too.
    void check_texts(const VtkXmlElement& element) const {
        const auto texts = number(attribute(element, "NumberOfTuples"));
        const auto parts = number(attribute(element, "NumberOfComponents").value_or("1"));
        if (!texts || !parts) damaged("a list of texts does not announce its length");
        if (texts_in(element) > std::min(*texts, room_around(element)) * *parts)
            damaged("a list of texts is longer than announced");
    }

    /// Lists of a piece's points and cells are as long as the piece is large.
    [[nodiscard]] std::uint64_t room_around(const VtkXmlElement& list) const {
        const VtkXmlElement* around = parent_of(list);
        const VtkXmlElement* piece = around ? parent_of(*around) : nullptr;
        if (!piece || !attribute(*piece, "NumberOfPoints"))  // an image's piece has an extent
            return std::numeric_limits<std::uint64_t>::max();
        const auto count = [&](const char* key) {
            return number(attribute(*piece, key)).value_or(0);
        };
        if (around && around->name == "PointData") return count("NumberOfPoints");
        if (around && around->name == "CellData")
            return count("NumberOfVerts") + count("NumberOfLines") + count("NumberOfStrips") +
                   count("NumberOfPolys") + count("NumberOfCells");
        return std::numeric_limits<std::uint64_t>::max();
    }

    [[nodiscard]] const VtkXmlElement* parent_of(const VtkXmlElement& element) const {
        return element.parent ? &elements_[*element.parent] : nullptr;
    }

    /// Where VTK starts to read an element's data: behind the first '>', be it in a value.
    [[nodiscard]] std::size_t content_at(const VtkXmlElement& element) const {
        const auto close = bytes_.find('>', element.offset);
        const auto start = close == std::string_view::npos
                               ? close
                               : bytes_.find_first_not_of(" \t\n\v\f\r", close + 1);
        return std::min(start, bytes_.size());
    }

    [[nodiscard]] std::string_view content_of(const VtkXmlElement& element) const {
        const std::size_t start = content_at(element);
        return bytes_.substr(start, bytes_.find('<', start) - start);
    }

    /// Texts of a list, each of which ends with a zero.
    [[nodiscard]] std::uint64_t texts_in(const VtkXmlElement& list) const {
        if (is_appended(list))
            return zeros(content(data_.substr(*number(attribute(list, "offset"))), raw_));
        const std::string_view text = content_of(list);
        if (attribute(list, "format") != "binary") return zeros_written(text);
        if (text.empty()) return 0;
        check_block(text, false);
        return zeros(content(text, false));
    }

    /// Zeros among bytes written as numbers, of which VTK takes the last eight bits.
    [[nodiscard]] std::uint64_t zeros_written(std::string_view text) const {
        std::istringstream words{std::string(text)};
        std::uint64_t count = 0;
        for (std::string word; words >> word;) {
            int value = 0;
            const char* const end = word.data() + word.size();
            const auto [read, error] = std::from_chars(word.data(), end, value);
            if (error != std::errc{} || read != end)
                damaged("a list of texts has '" + shortened(printable(word)) +
                        "' where a byte should be");
            count += value % 256 == 0;
        }
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

    void check_appended(const VtkXmlElement& element) const {
        const auto offset = number(attribute(element, "offset"));
        if (!offset || *offset >= data_.size()) damaged("an array's appended data is missing");
        check_block(data_.substr(*offset), raw_);
    }

    void check_inline(std::string_view text) const {
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
        if (blocks == 0) {  // VTK takes one block off for a rest, and reads on where none is
            if (word_at(head(3), 2).value_or(1) != 0) damaged("an array without blocks has a rest");
            return;
        }
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

    std::string_view bytes_, data_;
    const std::vector<VtkXmlElement>& elements_;
    const std::string& name_;
    bool raw_ = false, wide_ = false, big_endian_ = false, compressed_ = false, zlib_ = false;
    std::uint64_t ratio_ = 1;
};

}  // namespace

std::vector<VtkXmlElement> require_vtk_xml(std::string_view bytes, const std::string& name) {
    std::vector<VtkXmlElement> elements = vtk_xml_elements(bytes, name);
    const Checker checker(bytes, elements, name);
    checker.check_counts();
    checker.check_arrays();
    return elements;
}

}  // namespace vesselbench
