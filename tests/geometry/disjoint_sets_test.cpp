#include "geometry/kernel/disjoint_sets.h"

#include <catch2/catch.hpp>

using namespace vesselbench;

SCENARIO("Joined numbers are named by the smallest of them", "[geometry][kernel]") {
    DisjointSets sets(6);
    CHECK(sets.root(4) == 4);
    CHECK(sets.join(5, 4));
    CHECK(sets.join(2, 5));
    THEN("whatever the order of the joins") {
        for (const std::uint32_t member : {2U, 4U, 5U}) CHECK(sets.root(member) == 2);
        CHECK(sets.root(3) == 3);
    }
    THEN("a join within a set changes nothing and is reported") {
        CHECK_FALSE(sets.join(4, 2));
        CHECK(sets.root(5) == 2);
    }
}
