#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "geometry/vessel/centerlines/centerline_graph.h"

namespace vesselbench {

/// Median diameter of the inscribed spheres of each branch outside its furcations [mm], #branches:
/// the vessel's along its course, not that of its end.
[[nodiscard]] std::vector<double> course_diameters(const CenterlineGraph& graph);

/// Direction of a branch away from one of its nodes, outside the furcation there; of length 1.
[[nodiscard]] Vec3 direction_from(const CenterlineGraph& graph, std::size_t branch,
                                  std::size_t node);

/// How a tree looks if its blood enters at a tip, and leaves it along the shortest ways.
struct RootFigures {
    /// Distance from Murray's law [-], 0: none. At each furcation, the sums of cubes of the vessels
    /// before and behind it are equal, and the squared logarithm of their ratio counts.
    /// Source: Murray, "The physiological principle of minimum work", PNAS 12, 1926.
    double murray = 0.0;
    /// How sharply the blood turns into the vessels behind the furcations [-], 0: straight on, 2:
    /// back; the mean of 1 - cos of the angles, each by the cube of its vessel's diameter.
    double turn = 0.0;
};

/// A vessel between two furcations, which all ends behind it share.
struct SharedVessel {
    std::size_t branch = 0;
    double diameter = 0.0;  ///< along its course [mm]
};

/// The vessels between furcations that lead from a tip to each node along the shortest ways,
/// #nodes, the one next to the node first. Those that end at a tip are none.
[[nodiscard]] std::vector<std::vector<SharedVessel>> vessels_from(const CenterlineGraph& graph,
                                                                  std::size_t tip);

/// How the flow of a tip divides among others: at each furcation, the vessels behind it that lead
/// to one of them share by a power of their diameters along their courses. Blood takes the shortest
/// way to each node only: where vessels form a ring, as in a circle of Willis, the other way round
/// carries nothing.
/// Sources: exponent 2: Chnafa, Brina, Pereira, Steinman, "Better than nothing: a rational approach
/// for minimizing the impact of outflow strategy on cerebrovascular simulations", AJNR 39, 2018;
/// exponent 3, with which the shear is the same in all: Murray, "The physiological principle of
/// minimum work", PNAS 12, 1926.
/// \param inlet, outlets nodes of the graph
/// \param exponent of the diameters [-], >= 0; 0: vessels behind a furcation share alike
/// \return shares of the outlets, in their order [-]; 0 where no line leads to one
[[nodiscard]] std::vector<double> shares_of_outlets(const CenterlineGraph& graph, std::size_t inlet,
                                                    std::span<const std::size_t> outlets,
                                                    double exponent);

/// A tree whose root is looked for.
class FlowTree {
public:
    /// Keeps a reference to the graph.
    /// \param diameters of the branches (course_diameters) [mm]; 0: no blood flows there
    FlowTree(const CenterlineGraph& graph, std::vector<double> diameters);

    /// \param tip node of the graph
    [[nodiscard]] RootFigures figures(std::size_t tip) const;

private:
    /// A branch where blood flows, as it flows from a tip.
    struct Way {
        std::size_t near = 0, far = 0;  ///< nodes
        double flow = 0.0;              ///< the cube of the diameter [mm^3]
        Vec3 from_near = Vec3::Zero();  ///< direction of the branch out of this furcation
        Vec3 into_far = Vec3::Zero();   ///< and into this one
    };

    [[nodiscard]] std::vector<Way> ways_from(std::size_t tip) const;

    const CenterlineGraph& graph_;
    std::vector<double> diameters_, lengths_;        ///< by branch [mm]
    std::vector<std::pair<Vec3, Vec3>> directions_;  ///< by branch: out of its start and end node
};

}  // namespace vesselbench
