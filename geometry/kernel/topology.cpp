#include "geometry/kernel/topology.h"

#include <algorithm>
#include <string>
#include <unordered_map>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include "geometry/kernel/derived_cache.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/one_rings.h"
#include "geometry/kernel/vertex_corners.h"

namespace vesselbench {

namespace {

CompressedRows triangles_by_vertex(std::span<const Triangle> triangles, std::size_t vertex_count) {
    const VertexCorners corners(triangles);
    const auto shares = vertex_shares(vertex_count);
    CompressedRows rows;
    rows.offsets.assign(vertex_count + 1, 0);
    tbb::parallel_for(std::size_t{0}, shares.size(), [&](std::size_t i) {
        corners.visit_at(shares[i],
                         [&, offsets = rows.offsets.data()](VertexId v, VertexId, VertexId,
                                                            TriangleId) { ++offsets[v + 1]; });
    });
    for (std::size_t v = 0; v < vertex_count; ++v) rows.offsets[v + 1] += rows.offsets[v];
    rows.values.resize(rows.offsets.back());
    tbb::parallel_for(std::size_t{0}, shares.size(), [&](std::size_t i) {
        const auto [first, last] = shares[i];
        std::vector<std::uint32_t> next(rows.offsets.begin() + first, rows.offsets.begin() + last);
        corners.visit_at(
            shares[i],
            [&, first = first, place = next.data(), values = rows.values.data()](
                VertexId v, VertexId, VertexId, TriangleId t) { values[place[v - first]++] = t; });
    });
    return rows;
}

VertexId largest_id(std::span<const Triangle> triangles) {
    return tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, triangles.size(), 8192), VertexId{0},
        [&](const auto& range, VertexId largest) {
            Triangle by_corner{largest, largest,
                               largest};  // separate ones avoid a dependency chain
            for (std::size_t t = range.begin(); t != range.end(); ++t)
                for (std::size_t k = 0; k < 3; ++k)
                    by_corner[k] = std::max(by_corner[k], triangles[t][k]);
            return *std::ranges::max_element(by_corner);
        },
        [](VertexId a, VertexId b) { return std::max(a, b); });
}

}  // namespace

Topology::~Topology() = default;

Topology::Topology(std::vector<Triangle> triangles, std::size_t vertex_count)
    : triangles_(std::move(triangles)), vertex_count_(vertex_count) {
    if (triangles_.empty() || largest_id(triangles_) < vertex_count_) return;
    for (std::size_t t = 0; t < triangles_.size(); ++t)
        for (const VertexId v : triangles_[t])
            if (v >= vertex_count_)
                throw InvalidInput("triangle " + std::to_string(t) + " names vertex " +
                                   std::to_string(v) + ", but there are only " +
                                   std::to_string(vertex_count_));
}

const ContentKey& Topology::key() const {
    std::call_once(key_once_, [this] { key_ = topology_key(triangles_, vertex_count_); });
    return key_;
}

const OneRings& Topology::one_rings() const {
    std::call_once(rings_once_, [this] {
        one_rings_ = derived_cache().find_or_make<OneRings>(
            "one-rings", key(),
            [this] { return vesselbench::one_rings(triangles_, vertex_count_); },
            [](const OneRings& rings) { return rings.rows.bytes() + rings.boundary.size(); });
    });
    return *one_rings_;
}

const CompressedRows& Topology::rings() const {
    return one_rings().rows;
}

const std::vector<std::uint8_t>& Topology::boundary_vertices() const {
    return one_rings().boundary;
}

const CompressedRows& Topology::triangles_at() const {
    std::call_once(triangles_once_, [this] {
        triangles_at_ = derived_cache().find_or_make<CompressedRows>(
            "triangles at vertices", key(),
            [this] { return triangles_by_vertex(triangles_, vertex_count_); },
            [](const CompressedRows& rows) { return rows.bytes(); });
    });
    return *triangles_at_;
}

ContentKey topology_key(std::span<const Triangle> triangles, std::size_t vertex_count) {
    return content_key({content_key(triangles), ContentKey{0, vertex_count}});
}

std::vector<std::vector<VertexId>> Topology::boundary_loops() const {
    // next[a] holds the b of every half-edge a -> b whose edge has one triangle only.
    std::unordered_map<VertexId, std::vector<VertexId>> next;
    std::vector<VertexId> starts;
    const auto& at = triangles_at();
    const auto& boundary = boundary_vertices();
    const auto triangles_on_edge = [&](VertexId a, VertexId b) {
        int count = 0;
        for (const TriangleId t : at.row(a))
            for (const VertexId v : triangles_[t]) count += v == b ? 1 : 0;
        return count;
    };
    for (const Triangle& t : triangles_)
        for (int k = 0; k < 3; ++k) {
            const VertexId a = t[k], b = t[(k + 1) % 3];
            if (!boundary[a] || !boundary[b] || a == b || triangles_on_edge(a, b) != 1) continue;
            next[a].push_back(b);
            starts.push_back(a);
        }
    std::vector<std::vector<VertexId>> loops;
    for (const VertexId start : starts) {
        std::vector<VertexId> path{start};
        std::unordered_map<VertexId, std::size_t> place{{start, 0}};
        while (!next[path.back()].empty()) {
            auto& out = next[path.back()];
            const VertexId to = out.back();
            out.pop_back();
            if (const auto seen = place.find(to); seen != place.end()) {
                // A vertex visited again closes a loop; the vertices before it continue as a path.
                loops.emplace_back(path.begin() + static_cast<std::ptrdiff_t>(seen->second),
                                   path.end());
                while (path.size() > seen->second + 1) {
                    place.erase(path.back());
                    path.pop_back();
                }
            } else {
                place[to] = path.size();
                path.push_back(to);
            }
        }
    }
    return loops;
}

}  // namespace vesselbench
