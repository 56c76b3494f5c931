#include "gpu/staircase_search.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include <epoxy/gl.h>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "gpu/scan.h"
#include "smoothing/context/connected_distances.h"
#include "smoothing/context/point_grid.h"

namespace vesselbench {

namespace {

constexpr VertexId kNone = 0xFFFFFFFF;  // gpu/shaders/staircase_search.glsl
constexpr int kSweeps = 16;             // between two checks of their result

/// gpu/shaders/staircase_search.glsl
struct Found {
    std::uint32_t sources = 0, open = 0, moved = 0, farthest = 0, listed = 0;
};

/// The search for the staircases that reach each vertex.
class Search {
public:
    Search(const DeviceSurface& surface, double reach)
        : surface_(surface),
          device_(surface.device()),
          count_(surface.vertex_count()),
          reach_(reach),
          nearest_(make_storage(device_, count_ * sizeof(VertexId), "nearest staircases")),
          doubts_(make_storage(device_, count_ * sizeof(VertexId), "staircases in doubt")),
          found_(make_storage(device_, sizeof(Found), "results of a search")) {
        fill_storage(device_, found_, 0);
    }

    void find_sources(const Buffer& changes, const Buffer& free_of_caps, double tau_theta) {
        const Program& program = surface_.program("staircase_sources");
        bind_storage(
            {&changes, &free_of_caps, &nearest_, nullptr, nullptr, nullptr, nullptr, &found_});
        glUseProgram(program.id());
        glUniform1d(1, tau_theta);
        dispatch(device_, program, count_);
        sources_ = found().sources;
    }

    /// \return vertices still open, not by their places
    std::vector<OpenVertex> find_nearest() {
        fill_storage(device_, doubts_, kNone);
        if (sources_ == 0) return {};
        make_cells();
        const DeviceRows& rings = surface_.rings(1);
        bind_storage({&surface_.exact(), &doubts_, &nearest_, &rings.offsets, &rings.values,
                      &cell_offsets_, &sources_by_cell_, &found_});
        const Program& program = surface_.program("nearest_source");
        set_cells(program);
        glUniform1d(1, reach_);
        dispatch(device_, program, count_);
        const std::uint32_t open = found().open;
        return open == 0 ? std::vector<OpenVertex>{} : still_open(open);
    }

    /// Distances found so far, and the largest settled one [mm].
    DeviceDistances distances() {
        DeviceDistances result;
        result.sources = sources_;
        result.distances = make_storage(device_, count_ * sizeof(float), "staircase distances");
        bind_storage({&surface_.exact(), &result.distances, &nearest_, nullptr, nullptr, &doubts_,
                      nullptr, &found_});
        dispatch(device_, surface_.program("source_distance"), count_);
        result.farthest = std::bit_cast<float>(found().farthest);
        return result;
    }

    /// The staircase vertices, ascending.
    [[nodiscard]] std::vector<VertexId> sources() const {
        auto sources = read_storage<VertexId>(device_, sources_by_cell_, sources_);
        for (VertexId& source : sources) source = surface_.order().vertex_at(source);
        std::ranges::sort(sources);
        return sources;
    }

private:
    [[nodiscard]] Found found() const { return read_storage<Found>(device_, found_, 1).front(); }

    void set_cells(const Program& program) const {
        glUseProgram(program.id());
        glUniform3d(2, origin_.x(), origin_.y(), origin_.z());
        glUniform1d(3, cells_.per_length);
        glUniform3i(4, cells_.size[0], cells_.size[1], cells_.size[2]);
    }

    /// Sorts the sources into the cells of a grid over the surface.
    void make_cells() {
        const Bounds box = bounds(surface_.surface());
        const auto layout = cell_layout(box.max - box.min, sources_);
        if (!layout) throw GpuUnavailable("the surface is too large for a grid of cells");
        origin_ = box.min;
        cells_ = *layout;
        cell_offsets_ =
            make_storage(device_, (cells_.count() + 1) * sizeof(std::uint32_t), "cells");
        sources_by_cell_ = make_storage(device_, sources_ * sizeof(VertexId), "sources by cell");
        fill_storage(device_, cell_offsets_, 0);
        put_in_cells(false);
        add_up(surface_, cell_offsets_, cells_.count() + 1);
        put_in_cells(true);
    }

    void put_in_cells(bool places) const {
        bind_storage({&surface_.exact(), nullptr, &nearest_, nullptr, nullptr, &cell_offsets_,
                      &sources_by_cell_});
        const Program& program = surface_.program("source_cells");
        set_cells(program);
        glUniform1i(1, places ? 1 : 0);
        dispatch(device_, program, count_);
    }

    /// Lets open vertices query their neighbours until nothing changes.
    std::vector<OpenVertex> still_open(std::uint32_t open) {
        const DeviceRows& rings = surface_.rings(1);
        const Program& program = surface_.program("hand_on");
        bind_storage({&surface_.exact(), &doubts_, &nearest_, &rings.offsets, &rings.values,
                      nullptr, nullptr, &found_});
        glUseProgram(program.id());
        glUniform1d(1, reach_);
        std::uint32_t moved = 0;
        for (std::size_t round = 0;; ++round) {
            if (round > count_)  // a vertex hands on at least once in two rounds
                throw GpuUnavailable("the search for staircases does not end");
            for (int sweep = 0; sweep < kSweeps; ++sweep) dispatch(device_, program, count_);
            const Found now = found();
            open = now.open;
            if (now.moved == moved) break;
            moved = now.moved;
        }
        return open == 0 ? std::vector<OpenVertex>{} : listed(open);
    }

    [[nodiscard]] std::vector<OpenVertex> listed(std::uint32_t open) const {
        const Buffer list = make_storage(device_, open * sizeof(OpenVertex), "open vertices");
        bind_storage({nullptr, &doubts_, &nearest_, nullptr, nullptr, &list, nullptr, &found_});
        dispatch(device_, surface_.program("open_vertices"), count_);
        auto vertices = read_storage<OpenVertex>(device_, list, open);
        const DeviceOrder& order = surface_.order();
        for (auto& [vertex, known] : vertices) {
            vertex = order.vertex_at(vertex);
            if (known != kNone) known = order.vertex_at(known);
        }
        std::ranges::sort(vertices, {}, &OpenVertex::vertex);
        return vertices;
    }

    const DeviceSurface& surface_;
    const Device& device_;
    std::size_t count_;
    double reach_;
    Buffer nearest_, doubts_, found_, cell_offsets_, sources_by_cell_;
    std::uint32_t sources_ = 0;
    Vec3 origin_ = Vec3::Zero();
    CellLayout cells_;
};

/// Writes the distances found by the CPU to open vertices.
void settle(const DeviceSurface& surface, const std::vector<VertexId>& sources, double reach,
            const std::vector<OpenVertex>& open, DeviceDistances& result) {
    const auto distances = open_distances(*surface.surface().topology, surface.surface().points(),
                                          sources, reach, open);
    std::vector<VertexId> places;
    std::vector<float> values;
    for (std::size_t i = 0; i < open.size(); ++i) {
        if (!std::isfinite(distances[i])) continue;
        places.push_back(surface.order().place_of(open[i].vertex));
        values.push_back(static_cast<float>(distances[i]));
        result.farthest = std::max(result.farthest, distances[i]);
    }
    const Device& device = surface.device();
    const Buffer to = make_storage(device, std::span<const VertexId>(places), "settled vertices");
    const Buffer what = make_storage(device, std::span<const float>(values), "their distances");
    bind_storage({&to, &what, &result.distances});
    dispatch(device, surface.program("scatter"), places.size());
    result.open = open.size();
}

}  // namespace

DeviceDistances search_staircases(const DeviceSurface& surface, const Buffer& changes,
                                  const Buffer& free_of_caps, double tau_theta, double tau_max) {
    Search search(surface, tau_max);
    search.find_sources(changes, free_of_caps, tau_theta);
    const std::vector<OpenVertex> open = search.find_nearest();
    DeviceDistances result = search.distances();
    if (!open.empty()) settle(surface, search.sources(), tau_max, open, result);
    return result;
}

}  // namespace vesselbench
