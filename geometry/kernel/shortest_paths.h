#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <queue>
#include <type_traits>
#include <utility>
#include <vector>

namespace vesselbench {

/// Dijkstra's search, driven by its caller, who knows the graph:
///
///     ShortestPaths paths(distances);  // infinite where nothing is known
///     paths.lower(start, 0.0);
///     while (const auto at = paths.next())
///         for (each neighbour u of at->vertex) paths.lower(u, at->distance + length of the edge);
///
/// \tparam Distances has operator[] for every vertex: a vector, or a map where few are reached
template <class Distances>
class ShortestPaths {
public:
    using Distance = std::remove_cvref_t<decltype(std::declval<Distances&>()[0])>;

    struct Reached {
        Distance distance;
        std::uint32_t vertex;
        auto operator<=>(const Reached&) const = default;
    };

    /// Keeps a reference to the distances and writes to them.
    explicit ShortestPaths(Distances& distances) : distances_(distances) {}

    /// Starts at a vertex whose distance is already set.
    void start(std::uint32_t vertex) { queue_.push({distances_[vertex], vertex}); }

    /// Sets the distance of a vertex if the new one is smaller.
    void lower(std::uint32_t vertex, Distance distance) {
        Distance& known = distances_[vertex];
        if (!(distance < known)) return;
        known = distance;
        queue_.push({distance, vertex});
    }

    /// The next vertex, nearest first, ties by lowest number; none: all are reached.
    [[nodiscard]] std::optional<Reached> next() {
        while (!queue_.empty()) {
            const Reached nearest = queue_.top();
            queue_.pop();
            if (!(nearest.distance > distances_[nearest.vertex])) return nearest;
        }
        return std::nullopt;
    }

private:
    Distances& distances_;
    std::priority_queue<Reached, std::vector<Reached>, std::greater<>> queue_;
};

}  // namespace vesselbench
