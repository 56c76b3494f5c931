#include <cmath>
#include <initializer_list>
#include <vector>

#include <catch2/catch.hpp>

#include "geometry/vessel/ends/flow_tree.h"

using namespace vesselbench;

namespace {

/// A graph of straight vessels between places that grow with the node's number.
class Vessels {
public:
    explicit Vessels(std::size_t nodes) {
        graph_.nodes.resize(nodes);
        for (std::size_t n = 0; n < nodes; ++n) {
            const auto x = static_cast<double>(n);
            graph_.nodes[n].position = {20.0 * x, 3.0 * x * x, 0.0};
            graph_.nodes[n].radius = 0.5;
        }
    }

    void add(std::size_t from, std::size_t to, double diameter) {
        constexpr int kSteps = 40;
        CenterlineBranch branch{.start_node = from, .end_node = to, .points = {}, .radii = {}};
        const Vec3 a = graph_.nodes[from].position, b = graph_.nodes[to].position;
        for (int k = 0; k <= kSteps; ++k) {
            branch.points.emplace_back(a + (b - a) * (static_cast<double>(k) / kSteps));
            branch.radii.push_back(0.5 * diameter);
        }
        for (const std::size_t n : {from, to})
            graph_.nodes[n].branches.push_back(graph_.branches.size());
        graph_.branches.push_back(std::move(branch));
    }

    [[nodiscard]] std::vector<double> shares(double exponent,
                                             std::initializer_list<std::size_t> outlets) const {
        const std::vector<std::size_t> list(outlets);
        return shares_of_outlets(graph_, 0, list, exponent);
    }

private:
    CenterlineGraph graph_;
};

}  // namespace

SCENARIO("Outlets share the flow bifurcation by bifurcation", "[geometry][ends]") {
    // 0 -> 1, which parts to 2 and 3; 3 parts to 4 and 5, and has a blind sac 6
    Vessels tree(8);
    tree.add(0, 1, 4.0);
    tree.add(1, 2, 2.0);
    tree.add(1, 3, 3.0);
    tree.add(3, 4, 1.0);
    tree.add(3, 5, 2.0);
    tree.add(3, 6, 5.0);
    GIVEN("the square of the diameters") {
        const std::vector<double> shares = tree.shares(2.0, {2, 4, 5});
        THEN("each bifurcation divides what comes to it; a sac takes nothing") {
            CHECK(shares[0] == Approx(4.0 / 13.0));
            CHECK(shares[1] == Approx(9.0 / 13.0 * 1.0 / 5.0));
            CHECK(shares[2] == Approx(9.0 / 13.0 * 4.0 / 5.0));
        }
    }
    GIVEN("Murray's cubes") {
        const std::vector<double> shares = tree.shares(3.0, {4, 5, 2});
        CHECK(shares[0] == Approx(27.0 / 35.0 * 1.0 / 9.0));
        CHECK(shares[2] == Approx(8.0 / 35.0));
    }
    GIVEN("the power 0") {
        THEN("vessels behind a bifurcation share alike") {
            CHECK(tree.shares(0.0, {2, 4})[0] == Approx(0.5));
        }
    }
    GIVEN("a vessel that no outlet is behind") {
        THEN("the other one takes all") {
            CHECK(tree.shares(2.0, {4})[0] == Approx(1.0));
        }
    }
    GIVEN("an outlet that no line leads to") {
        CHECK(tree.shares(2.0, {2, 7})[1] == 0.0);
    }
}
