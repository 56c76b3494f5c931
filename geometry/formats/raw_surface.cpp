#include "geometry/formats/raw_surface.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>

#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

constexpr std::string_view kBlank = " \t\r\v\f";

Vec3 polygon_normal(const Positions& points, const std::vector<VertexId>& polygon) {
    Vec3 normal = Vec3::Zero();  // Newell's method
    for (std::size_t i = 0; i < polygon.size(); ++i)
        normal += (points[polygon[i]] - points[polygon[0]])
                      .cross(points[polygon[(i + 1) % polygon.size()]] - points[polygon[0]]);
    return normal;
}

struct EarCutter {
    const Positions& points;
    Vec3 normal;

    [[nodiscard]] double turn(VertexId a, VertexId b, VertexId c) const {
        return (points[b] - points[a]).cross(points[c] - points[a]).dot(normal);
    }

    [[nodiscard]] bool is_ear(const std::vector<VertexId>& ring, std::size_t i) const {
        const std::size_t n = ring.size();
        const VertexId a = ring[(i + n - 1) % n], b = ring[i], c = ring[(i + 1) % n];
        if (!(turn(a, b, c) > 0.0)) return false;
        for (const VertexId v : ring) {
            if (v == a || v == b || v == c) continue;
            if (turn(a, b, v) >= 0.0 && turn(b, c, v) >= 0.0 && turn(c, a, v) >= 0.0) return false;
        }
        return true;
    }
};

}  // namespace

std::optional<LengthUnit> stated_unit(std::string_view text) {
    const auto at = text.find("UNITS=");
    if (at == std::string_view::npos) return std::nullopt;
    text.remove_prefix(at + 6);
    text.remove_prefix(std::min(text.find_first_not_of(kBlank), text.size()));
    const auto is_of_word = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
               (static_cast<unsigned char>(c) & 0x80U) != 0;
    };
    const auto end = std::ranges::find_if_not(text, is_of_word);
    return unit_named(text.substr(0, static_cast<std::size_t>(end - text.begin())));
}

void append_polygon(const Positions& positions, const std::vector<VertexId>& polygon,
                    std::vector<Triangle>& triangles) {
    std::vector<VertexId> ring = polygon;
    const EarCutter cutter{positions, polygon_normal(positions, polygon)};
    constexpr std::size_t kMostCorners = 5000;  // quadratic cost; above it a plain fan
    while (ring.size() > 3 && ring.size() <= kMostCorners) {
        // The ear with the shortest cut, to avoid fans of needles.
        std::size_t best = ring.size();
        double shortest = 0.0;
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const std::size_t n = ring.size();
            const double cut =
                (positions[ring[(i + n - 1) % n]] - positions[ring[(i + 1) % n]]).squaredNorm();
            if ((best < n && cut >= shortest) || !cutter.is_ear(ring, i)) continue;
            best = i;
            shortest = cut;
        }
        if (best == ring.size()) break;
        const std::size_t n = ring.size();
        triangles.push_back({ring[(best + n - 1) % n], ring[best], ring[(best + 1) % n]});
        ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(best));
    }
    for (std::size_t i = 1; i + 1 < ring.size(); ++i)
        triangles.push_back({ring[0], ring[i], ring[i + 1]});
}

bool TextScanner::next_line(char comment) {
    while (!rest_.empty()) {
        ++line_;
        const auto end = rest_.find('\n');
        current_ = rest_.substr(0, end);
        rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
        if (!current_.empty() && current_.back() == '\r') current_.remove_suffix(1);
        words_ = current_.substr(0, current_.find(comment));
        if (words_.find_first_not_of(kBlank) != std::string_view::npos) return true;
    }
    current_ = words_ = {};
    return false;
}

std::string_view TextScanner::word() {
    words_.remove_prefix(std::min(words_.find_first_not_of(kBlank), words_.size()));
    const auto found = words_.substr(0, words_.find_first_of(kBlank));
    words_.remove_prefix(found.size());
    return found;
}

double TextScanner::parse_number(std::string_view text, const char* what) const {
    if (text.empty()) fail(std::string("a number is missing (") + what + ")");
    const std::string_view bare = text.front() == '+' ? text.substr(1) : text;
    double value = 0.0;
    const auto [end, error] = std::from_chars(bare.data(), bare.data() + bare.size(), value);
    if (end != bare.data() + bare.size() ||
        (error != std::errc{} && error != std::errc::result_out_of_range))
        fail("'" + std::string(text.substr(0, 40)) + "' is not a number (" + what + ")");
    if (error == std::errc::result_out_of_range)
        return 0.0;  // a denormal written in single precision
    if (!std::isfinite(value))
        fail("the value '" + std::string(text) + "' is not finite (" + what +
             "): the program that wrote the file failed; export it again");
    return value;
}

long long TextScanner::parse_integer(std::string_view text, const char* what) const {
    long long value = 0;
    const std::string_view bare = !text.empty() && text.front() == '+' ? text.substr(1) : text;
    const auto [end, error] = std::from_chars(bare.data(), bare.data() + bare.size(), value);
    if (bare.empty() || error != std::errc{} || end != bare.data() + bare.size())
        fail("'" + std::string(text.substr(0, 40)) + "' is not an integer (" + what + ")");
    return value;
}

double TextScanner::number(const char* what) {
    return parse_number(word(), what);
}

long long TextScanner::integer(const char* what) {
    return parse_integer(word(), what);
}

void TextScanner::fail(const std::string& what) const {
    throw InvalidInput(file_ + ", line " + std::to_string(line_) + ": " + what);
}

}  // namespace vesselbench
