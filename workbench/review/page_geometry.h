#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include <nlohmann/json.hpp>

#include "geometry/kernel/measure.h"
#include "geometry/kernel/surface.h"

namespace vesselbench {

/// Surfaces for the review page: all states of a model share one pool of vertices and one of
/// triangles, so that an edit brings only what is new. Positions are rounded to 1/65535 of the
/// pool's box.
class PageGeometry {
public:
    /// \param box of all surfaces that will be added [mm]
    explicit PageGeometry(const Bounds& box);

    struct State {
        std::size_t number = 0;               ///< in the page's list of states
        std::vector<std::uint32_t> vertices;  ///< of the pool, for each vertex of the surface
        std::vector<std::uint32_t> used;      ///< by its triangles, ascending
    };

    /// Adds a surface. What earlier ones have takes no room again.
    State add(const Surface& surface);

    /// Adds values of a state's vertices, 0 or more.
    /// \return their blob and the values of its first and last step: {"blob", "min_mm", "max_mm"};
    /// the least is 0, or the negative of the largest if some values are negative
    nlohmann::ordered_json add_values(const State& state, std::span<const double> values);

    /// {"pool", "chunks", "states"} of the page's data.
    [[nodiscard]] nlohmann::ordered_json json() const;

    /// The page's blobs by name, as packed_text(): packed here, for those who need them.
    [[nodiscard]] std::map<std::string, std::string> blobs() const;

private:
    using Cell = std::array<std::uint16_t, 3>;

    struct TriangleHash {
        std::size_t operator()(const Triangle& triangle) const;
    };

    struct Chunk {
        std::array<std::vector<std::uint16_t>, 3> points;
        std::array<std::vector<std::uint32_t>, 3> corners;
    };

    [[nodiscard]] Cell cell_of(const Vec3& point) const;
    std::uint32_t vertex_at(const Vec3& point, Chunk& chunk);
    std::uint32_t triangle_at(const Triangle& corners, Chunk& chunk);
    void store(const Chunk& chunk);
    [[nodiscard]] std::vector<std::size_t> chunks_of(std::span<const std::uint32_t> triangles,
                                                     std::span<const std::uint32_t> vertices) const;

    Vec3 low_, extent_;
    std::unordered_map<std::uint64_t, std::uint32_t> vertices_;
    std::unordered_map<Triangle, std::uint32_t, TriangleHash> triangles_;
    /// Numbers of vertices and of triangles in the pool at the end of each chunk.
    std::vector<std::uint32_t> vertex_ends_, triangle_ends_;
    nlohmann::ordered_json chunks_ = nlohmann::ordered_json::array();
    nlohmann::ordered_json states_ = nlohmann::ordered_json::array();
    std::map<std::string, std::string> bytes_;  ///< of the blobs, by name
};

}  // namespace vesselbench
