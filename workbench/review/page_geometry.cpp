#include "workbench/review/page_geometry.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "workbench/review/page_bytes.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

constexpr double kMostSteps = 65535.0;  ///< of a box's side, as 16 bits hold them
/// Of a box's side, so that flat ones have one [mm].
constexpr double kLeastExtent = 1e-6;

std::uint16_t rounded_share(double share) {
    return static_cast<std::uint16_t>(std::lround(std::clamp(share, 0.0, 1.0) * kMostSteps));
}

/// The same triangle with its smallest corner first.
Triangle turned(const Triangle& corners) {
    const auto least = std::ranges::min_element(corners) - corners.begin();
    return {corners[static_cast<std::size_t>(least)],
            corners[static_cast<std::size_t>((least + 1) % 3)],
            corners[static_cast<std::size_t>((least + 2) % 3)]};
}

struct PatchTriangle {
    std::uint32_t triangle;  ///< of the pool
    std::uint8_t patch;

    auto operator<=>(const PatchTriangle&) const = default;
};

/// Consecutive triangles of one patch are one run: first, count.
std::pair<std::string, std::size_t> runs_of(const std::vector<PatchTriangle>& triangles) {
    std::string runs, patches;
    for (std::size_t begin = 0; begin < triangles.size();) {
        std::size_t end = begin + 1;
        while (end < triangles.size() && triangles[end].patch == triangles[begin].patch &&
               triangles[end].triangle == triangles[end - 1].triangle + 1)
            ++end;
        append_number(runs, triangles[begin].triangle);
        append_number(runs, static_cast<std::uint32_t>(end - begin));
        patches.push_back(static_cast<char>(triangles[begin].patch));
        begin = end;
    }
    const std::size_t count = patches.size();
    return {runs + patches, count};
}

void sort_and_unite(std::vector<std::uint32_t>& numbers) {
    std::ranges::sort(numbers);
    const auto [first, last] = std::ranges::unique(numbers);
    numbers.erase(first, last);
}

Json patches_json(const Surface& surface) {
    Json patches = Json::array();
    for (const Patch& patch : surface.patches)
        patches.push_back({{"name", patch.name},
                           {"kind", patch.kind == PatchKind::Cut ? "cap" : to_string(patch.kind)}});
    return patches;
}

}  // namespace

std::size_t PageGeometry::TriangleHash::operator()(const Triangle& triangle) const {
    std::uint64_t hash = 0;
    for (const std::uint32_t corner : triangle) hash = (hash ^ corner) * 0x9E3779B97F4A7C15ULL;
    return static_cast<std::size_t>(hash ^ (hash >> 29));
}

PageGeometry::PageGeometry(const Bounds& box)
    : low_(box.min), extent_((box.max - box.min).cwiseMax(kLeastExtent)) {}

PageGeometry::Cell PageGeometry::cell_of(const Vec3& point) const {
    const Vec3 share = (point - low_).cwiseQuotient(extent_);
    return {rounded_share(share.x()), rounded_share(share.y()), rounded_share(share.z())};
}

std::uint32_t PageGeometry::vertex_at(const Vec3& point, Chunk& chunk) {
    const Cell cell = cell_of(point);
    const std::uint64_t key = cell[0] | std::uint64_t{cell[1]} << 16 | std::uint64_t{cell[2]} << 32;
    const auto [found, is_new] =
        vertices_.try_emplace(key, static_cast<std::uint32_t>(vertices_.size()));
    if (is_new)
        for (std::size_t axis = 0; axis < 3; ++axis) chunk.points[axis].push_back(cell[axis]);
    return found->second;
}

std::uint32_t PageGeometry::triangle_at(const Triangle& corners, Chunk& chunk) {
    const Triangle key = turned(corners);
    const auto [found, is_new] =
        triangles_.try_emplace(key, static_cast<std::uint32_t>(triangles_.size()));
    if (is_new)
        for (std::size_t i = 0; i < 3; ++i) chunk.corners[i].push_back(key[i]);
    return found->second;
}

void PageGeometry::store(const Chunk& chunk) {
    std::string bytes;
    for (const auto& plane : chunk.points) append_plane(bytes, plane);
    for (const auto& plane : chunk.corners) append_plane(bytes, plane);
    const std::string name = "chunk-" + std::to_string(chunks_.size());
    chunks_.push_back({{"blob", name},
                       {"vertices", chunk.points[0].size()},
                       {"triangles", chunk.corners[0].size()}});
    bytes_[name] = std::move(bytes);
    vertex_ends_.push_back(static_cast<std::uint32_t>(vertices_.size()));
    triangle_ends_.push_back(static_cast<std::uint32_t>(triangles_.size()));
}

std::vector<std::size_t> PageGeometry::chunks_of(std::span<const std::uint32_t> triangles,
                                                 std::span<const std::uint32_t> vertices) const {
    std::vector<bool> needed(chunks_.size());
    const auto mark = [&](const std::vector<std::uint32_t>& ends,
                          std::span<const std::uint32_t> numbers) {
        for (const std::uint32_t number : numbers)
            needed[static_cast<std::size_t>(std::ranges::upper_bound(ends, number) -
                                            ends.begin())] = true;
    };
    mark(triangle_ends_, triangles);
    mark(vertex_ends_, vertices);
    std::vector<std::size_t> chunks;
    for (std::size_t i = 0; i < needed.size(); ++i)
        if (needed[i]) chunks.push_back(i);
    return chunks;
}

PageGeometry::State PageGeometry::add(const Surface& surface) {
    Chunk chunk;
    State state{.number = states_.size(), .vertices = {}, .used = {}};
    for (const Vec3& point : surface.points()) state.vertices.push_back(vertex_at(point, chunk));
    std::vector<PatchTriangle> shown;
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
        const Triangle& own = surface.triangles()[t];
        const Triangle corners = {state.vertices[own[0]], state.vertices[own[1]],
                                  state.vertices[own[2]]};
        if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0])
            continue;  // smaller than a step
        state.used.insert(state.used.end(), corners.begin(), corners.end());
        const std::size_t patch = std::min<std::size_t>((*surface.patch_labels)[t], 255);
        shown.push_back({triangle_at(corners, chunk), static_cast<std::uint8_t>(patch)});
    }
    if (!chunk.points[0].empty() || !chunk.corners[0].empty()) store(chunk);
    sort_and_unite(state.used);
    std::ranges::sort(shown);
    const auto [first, last] = std::ranges::unique(shown, {}, &PatchTriangle::triangle);
    shown.erase(first, last);
    std::vector<std::uint32_t> numbers;
    for (const PatchTriangle& one : shown) numbers.push_back(one.triangle);
    auto [bytes, runs] = runs_of(shown);
    const std::string name = "state-" + std::to_string(state.number);
    bytes_[name] = std::move(bytes);
    states_.push_back({{"blob", name},
                       {"runs", runs},
                       {"chunks", chunks_of(numbers, state.used)},
                       {"patches", patches_json(surface)}});
    return state;
}

nlohmann::ordered_json PageGeometry::add_values(const State& state,
                                                std::span<const double> values) {
    std::vector<double> largest(state.used.size());  // several vertices may be one of the pool
    for (std::size_t v = 0; v < state.vertices.size(); ++v) {
        const auto place = std::ranges::lower_bound(state.used, state.vertices[v]);
        if (place == state.used.end() || *place != state.vertices[v]) continue;
        double& value = largest[static_cast<std::size_t>(place - state.used.begin())];
        if (std::abs(values[v]) > std::abs(value)) value = values[v];
    }
    double most = 0.0;
    bool negative = false;
    for (const double value : largest) {
        most = std::max(most, std::abs(value));
        negative = negative || value < 0.0;
    }
    const double least = negative ? -most : 0.0;
    std::string bytes;
    for (const double value : largest)
        append_number(bytes, rounded_share(most > 0.0 ? (value - least) / (most - least) : 0.0));
    const std::string name = "deviation-" + std::to_string(state.number);
    bytes_[name] = std::move(bytes);
    return {{"blob", name}, {"min_mm", least}, {"max_mm", most}};
}

std::map<std::string, std::string> PageGeometry::blobs() const {
    std::map<std::string, std::string> blobs;
    for (const auto& [name, bytes] : bytes_) blobs[name] = packed_text(bytes);
    return blobs;
}

nlohmann::ordered_json PageGeometry::json() const {
    const Vec3 high = low_ + extent_;
    return {{"pool",
             {{"box", {low_.x(), low_.y(), low_.z(), high.x(), high.y(), high.z()}}, {"bits", 16}}},
            {"chunks", chunks_},
            {"states", states_}};
}

}  // namespace vesselbench
