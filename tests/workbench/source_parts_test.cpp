#include "workbench/report/source_parts.h"

#include <algorithm>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "gpu/context.h"
#include "tests/support/shapes.h"
#include "tests/support/skip.h"
#include "workbench/report/report_pictures.h"

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

SCENARIO("The report draws the source with its closed ends and lost parts", "[workbench][report]") {
    const Surface source = closed_tube(2.0, 30.0, 24, 60), model = closed_tube(2.0, 20.0, 24, 40);
    const std::vector<std::uint8_t> all(model.vertex_count(), 1);
    const auto titles = [&](const Surface& from, std::vector<ClosedEnd> closed) {
        std::vector<std::string> list;
        for (const ReportPicture& picture :
             report_pictures(model, PictureSource{from, all, std::move(closed)})) {
            CHECK(picture.png.size() > 1000);
            list.push_back(picture.title);
        }
        return list;
    };
    try {
        const OffscreenContext possible;
    } catch (const GpuUnavailable& missing) {
        return skip(missing.what());
    }
    const auto drawn = titles(source, {{Vec3(0, 0, 0), 4.0}});
    REQUIRE(drawn.size() == 9);
    CHECK(drawn.back() ==
          "The source, from above: blue is not in the model, violet ends are closed");
    CHECK(titles(model, {}).size() == 6);
}
