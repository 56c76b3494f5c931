#include "tests/fuzz/mutator.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <utility>
#include <vector>

#include <zlib.h>

namespace vesselbench::fuzz {

namespace {

using forest::Dice;

constexpr std::size_t kHeader = 512;         // most of what announces sizes lies there
constexpr std::size_t kLargest = 1U << 20U;  // [bytes] mutations do not grow beyond it

constexpr std::array<std::uint64_t, 16> kWords = {0,
                                                  1,
                                                  2,
                                                  0x7f,
                                                  0x80,
                                                  0xff,
                                                  0x7fff,
                                                  0x8000,
                                                  0xffff,
                                                  0x7fffffff,
                                                  0x80000000,
                                                  0xffffffff,
                                                  0x20000001,
                                                  std::uint64_t{1} << 40U,
                                                  0x7fffffffffffffff,
                                                  ~std::uint64_t{0}};

constexpr std::array kNumbers = {"0",
                                 "-1",
                                 "1",
                                 "2",
                                 "255",
                                 "65536",
                                 "2147483647",
                                 "2147483648",
                                 "-2147483649",
                                 "4294967295",
                                 "4294967297",
                                 "9223372036854775807",
                                 "18446744073709551616",
                                 "99999999999999999999999",
                                 "1e308",
                                 "-1e309",
                                 "1e-320",
                                 "nan",
                                 "inf",
                                 "0x7f",
                                 "1e9",
                                 "1000000",
                                 "-0.0",
                                 "3.5"};

template <class List>
const auto& one_of(const List& list, Dice& dice) {
    return list[dice.whole(0, static_cast<int>(list.size()) - 1)];
}

/// A place in the bytes, often near their beginning.
std::size_t place_in(const std::string& bytes, Dice& dice) {
    const std::size_t end = dice.chance(0.5) ? std::min(bytes.size(), kHeader) : bytes.size();
    return static_cast<std::size_t>(dice.whole(0, static_cast<int>(end) - 1));
}

/// A part of the bytes, mostly short.
std::string part_of(const std::string& bytes, Dice& dice) {
    const std::size_t at = place_in(bytes, dice);
    const int left = static_cast<int>(bytes.size() - at);
    const int length = dice.chance(0.7) ? std::min(left, dice.whole(1, 64)) : dice.whole(1, left);
    return bytes.substr(at, static_cast<std::size_t>(length));
}

void flip_bit(std::string& bytes, Dice& dice) {
    char& byte = bytes[place_in(bytes, dice)];
    byte = static_cast<char>(byte ^ (1 << dice.whole(0, 7)));
}

/// One to eight bytes of either byte order.
void set_word(std::string& bytes, Dice& dice) {
    const std::size_t size = std::size_t{1} << static_cast<unsigned>(dice.whole(0, 3));
    std::size_t at = place_in(bytes, dice);
    if (dice.chance(0.7)) at -= at % size;
    if (at + size > bytes.size()) return;
    const std::uint64_t value = one_of(kWords, dice);
    std::memcpy(bytes.data() + at, &value, size);
    const auto word = bytes.begin() + static_cast<std::ptrdiff_t>(at);
    if (dice.chance(0.3)) std::reverse(word, word + static_cast<std::ptrdiff_t>(size));
}

/// Adds a little to a word of four bytes: counts off by one.
void add_to_word(std::string& bytes, Dice& dice) {
    const std::size_t at = place_in(bytes, dice);
    std::uint32_t value = 0;
    if (at + sizeof value > bytes.size()) return;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    value += static_cast<std::uint32_t>(dice.whole(-2, 2));
    std::memcpy(bytes.data() + at, &value, sizeof value);
}

bool belongs_to_number(char letter) {
    return std::isdigit(static_cast<unsigned char>(letter)) != 0 || letter == '.' || letter == '-';
}

void replace_number(std::string& bytes, Dice& dice) {
    std::size_t first = place_in(bytes, dice);
    while (first < bytes.size() && std::isdigit(static_cast<unsigned char>(bytes[first])) == 0)
        ++first;
    if (first == bytes.size()) return;
    while (first > 0 && belongs_to_number(bytes[first - 1])) --first;
    std::size_t last = first;
    while (last < bytes.size() && belongs_to_number(bytes[last])) ++last;
    bytes.replace(first, last - first, one_of(kNumbers, dice));
}

/// From the line that contains a place, with its end.
std::pair<std::size_t, std::size_t> line_at(const std::string& bytes, std::size_t at) {
    const std::size_t before = at == 0 ? std::string::npos : bytes.rfind('\n', at - 1);
    const std::size_t first = before == std::string::npos ? 0 : before + 1;
    const std::size_t end = bytes.find('\n', at);
    return {first, end == std::string::npos ? bytes.size() : end + 1};
}

void repeat_line(std::string& bytes, Dice& dice) {
    const auto [first, end] = line_at(bytes, place_in(bytes, dice));
    const std::string line = bytes.substr(first, end - first);
    if (line.size() > 4096) return;
    for (int times = dice.chance(0.8) ? 1 : dice.whole(2, 200); times > 0; --times)
        bytes.insert(first, line);
}

void remove_line(std::string& bytes, Dice& dice) {
    const auto [first, end] = line_at(bytes, place_in(bytes, dice));
    bytes.erase(first, end - first);
}

void remove_part(std::string& bytes, Dice& dice) {
    const std::size_t at = place_in(bytes, dice);
    bytes.erase(at, part_of(bytes, dice).size());
}

void repeat_part(std::string& bytes, Dice& dice) {
    bytes.insert(place_in(bytes, dice), part_of(bytes, dice));
}

void truncate(std::string& bytes, Dice& dice) {
    bytes.resize(place_in(bytes, dice));
}

void append(std::string& bytes, Dice& dice) {
    const int count = dice.whole(1, 300);
    const bool zeros = dice.chance(0.5);
    for (int i = 0; i < count; ++i) bytes += zeros ? '\0' : static_cast<char>(dice.whole(0, 255));
}

void nest(std::string& bytes, Dice& dice) {
    static constexpr std::array kOpen = {"[", "{\"a\":", "<a>", "(", "[{\"operation\":"};
    const std::string open = one_of(kOpen, dice);
    std::string deep;
    for (int level = dice.chance(0.5) ? dice.whole(2, 80) : 20000; level > 0; --level) deep += open;
    bytes.insert(place_in(bytes, dice), deep);
}

void set_bytes(std::string& bytes, Dice& dice) {
    const std::size_t at = place_in(bytes, dice);
    const std::size_t count = std::min(bytes.size() - at, std::size_t(dice.whole(1, 32)));
    const bool random = dice.chance(0.5);
    for (std::size_t i = at; i < at + count; ++i)
        bytes[i] = random ? static_cast<char>(dice.whole(0, 255)) : '\xff';
}

using Mutation = void (*)(std::string&, Dice&);

constexpr std::array<std::pair<double, Mutation>, 12> kMutations = {{{4, flip_bit},
                                                                     {4, set_word},
                                                                     {2, add_to_word},
                                                                     {8, replace_number},
                                                                     {2, repeat_line},
                                                                     {2, remove_line},
                                                                     {1, remove_part},
                                                                     {1, repeat_part},
                                                                     {2, truncate},
                                                                     {1, append},
                                                                     {0.5, nest},
                                                                     {1, set_bytes}}};

Mutation random_mutation(Dice& dice) {
    static const std::vector<double> weights = [] {
        std::vector<double> made;
        for (const auto& [weight, mutation] : kMutations) made.push_back(weight);
        return made;
    }();
    return kMutations[dice.pick(weights)].second;
}

/// The head of one file, and the rest of another.
void splice(std::string& bytes, const std::string& other, Dice& dice) {
    if (other.empty()) return;
    if (dice.chance(0.5))
        bytes.insert(place_in(bytes, dice), part_of(other, dice));
    else
        bytes = bytes.substr(0, place_in(bytes, dice)) + other.substr(place_in(other, dice));
}

}  // namespace

std::string mutated(std::string bytes, const std::string& other, Dice& dice) {
    const int count = dice.chance(0.5) ? 1 : dice.whole(2, 4);
    for (int left = count; left > 0 && !bytes.empty(); --left) {
        if (dice.chance(0.05))
            splice(bytes, other, dice);
        else
            random_mutation(dice)(bytes, dice);
        if (bytes.size() > kLargest) bytes.resize(kLargest);
    }
    return bytes;
}

std::string gzipped(const std::string& bytes) {
    z_stream stream{};
    if (deflateInit2(&stream, 6, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY) != Z_OK)
        throw std::runtime_error("zlib fails");
    std::string result(deflateBound(&stream, bytes.size()) + 64, '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(result.data());
    stream.avail_out = static_cast<uInt>(result.size());
    deflate(&stream, Z_FINISH);
    result.resize(stream.total_out);
    deflateEnd(&stream);
    return result;
}

std::string ungzipped(const std::string& bytes) {
    z_stream stream{};
    if (inflateInit2(&stream, 15 + 16) != Z_OK) throw std::runtime_error("zlib fails");
    std::string result(kLargest, '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(result.data());
    stream.avail_out = static_cast<uInt>(result.size());
    inflate(&stream, Z_FINISH);
    result.resize(stream.total_out);
    inflateEnd(&stream);
    return result;
}

}  // namespace vesselbench::fuzz
