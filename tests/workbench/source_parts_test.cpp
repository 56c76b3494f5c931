#include "workbench/report/source_parts.h"

#include <algorithm>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

SCENARIO("A source's vertices are kept, lost or at a closed end", "[workbench][report]") {
    // The source goes on for 10 mm beyond the model's upper end.
    const Surface source = closed_tube(2.0, 30.0, 24, 60), model = closed_tube(2.0, 20.0, 24, 40);
    const auto fates = source_fates(source, model, {{Vec3(0, 0, 0), 4.0}});
    REQUIRE(fates.size() == source.vertex_count());
    for (std::size_t v = 0; v < fates.size(); ++v) {
        const double z = source.points()[v].z();
        CAPTURE(z);
        if (z < 3.0) CHECK(fates[v] == SourceFate::Closed);
        if (z > 5.0 && z < 20.0) CHECK(fates[v] == SourceFate::Kept);
        if (z > 22.0) CHECK(fates[v] == SourceFate::Lost);
    }
    const auto kept = source_fates(model, model, {});
    CHECK(std::ranges::count(kept, SourceFate::Kept) ==
          static_cast<std::ptrdiff_t>(model.vertex_count()));
    CHECK_THROWS_AS(source_fates(source, Surface{}, {}), InvalidInput);
}
