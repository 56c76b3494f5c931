#include "workbench/colours/shown_measure.h"

#include <memory>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/support/shapes.h"
#include "workbench/colours/colourings.h"

using namespace vesselbench;
using namespace vesselbench::test;

SCENARIO("A measure has the colours and the range of its colouring", "[workbench][colours]") {
    Scene scene{.surface = fine_tube(2.0, 20.0, 24)};
    for (const auto kind : {ColouringKind::MeanCurvature, ColouringKind::TriangleQuality}) {
        const ColourValues shown = colour_values(kind, scene, {});
        const ShownMeasure measure = shown_measure(scene, colouring_info(kind).name, {});
        CHECK(measure.values == shown.values);
        CHECK(measure.scale.map == ColourMap::Ordered);
        CHECK(measure.scale.least == shown.range.least);
        CHECK(measure.scale.most == shown.range.most);
    }
    THEN("an attribute has a scale by its values") {
        std::vector<double> values(scene.surface->vertex_count(), -1.0);
        values.back() = values.front() = 1.0;
        scene.surface->attributes["change"] = std::make_shared<const std::vector<double>>(values);
        const ColourScale expected = scale_for(values);
        CHECK(shown_measure(scene, "change", {}).scale.map == expected.map);
        CHECK(shown_measure(scene, "change", {}).scale.least == expected.least);
    }
}
