#include "workbench/window/features/quality/quality_words.h"

#include <algorithm>

#include <catch2/catch.hpp>

#include "workbench/operations/table.h"

using namespace vesselbench;

namespace {

CurvePoint point_at(double value, double curvature, double error, double volume) {
    return {.value = value,
            .measures = QualityMeasures(),
            .scaled = {.curvature = curvature, .error = error, .volume = volume}};
}

}  // namespace

SCENARIO("The values of a graph are told where the cursor is", "[window][quality]") {
    QualityCurve curve{.name = "tau_max", .unit = "mm", .points = {}};
    CHECK(values_at(curve, 1.0).empty());
    curve.points = {point_at(0.0, 1.0, 0.0, 0.0), point_at(0.5, 0.352, 0.0312, 0.004),
                    CurvePoint{.value = 1.0}};
    CHECK(values_at(curve, -3.0) == "Tau max 0: curvature 100 %, error 0 %, volume 0 %");
    CHECK(values_at(curve, 0.6) == "Tau max 0.5: curvature 35.2 %, error 3.12 %, volume 0.4 %");
    CHECK(values_at(curve, 0.8) == "Tau max 1 cannot be combined with the other values");
}

SCENARIO("A suggestion says what it fills in, and what it leaves", "[window][quality]") {
    SensitivityAnalysis analysis;
    for (const char* name : {"lambda", "alpha", "iterations"})
        analysis.curves.push_back({.name = name, .unit = "-", .points = {}});
    const Arguments best{{"alpha", 0.05}, {"iterations", std::int64_t{50}}};
    CHECK(suggestion_words(best, analysis) == "Alpha 0.05, Iterations 50; as it is: Lambda");
    analysis.curves.erase(analysis.curves.begin());
    CHECK(suggestion_words(best, analysis) == "Alpha 0.05, Iterations 50");
}

SCENARIO("Where triangles change, the values of a graph have units", "[window][quality]") {
    const QualityScale scale{.error = 0.2,
                             .volume = -12.0,
                             .original_volume = 1000.0,
                             .triangles = 2000.0,
                             .strong = "decimate share=0.02"};
    SensitivityAnalysis analysis{.scale = scale,
                                 .curves = {{.name = "share", .unit = "-", .points = {}}}};
    QualityCurve& curve = analysis.curves.front();
    curve.points = {
        {.value = 0.5,
         .measures =
             QualityMeasures{
                 .error = 0.0123, .volume = 998.0, .triangles = 1000.0, .skewness = 0.18},
         .scaled = {.triangles = 0.5, .skewness = 0.18}},
        {.value = 1.0,
         .measures = QualityMeasures{.volume = 1000.0, .triangles = 2000.0},
         .scaled = {.triangles = 1.0}}};
    CHECK(values_at(curve, 0.6, scale) ==
          "Share 0.5: error 0.0123 mm, volume -0.20 %, triangles 1000, skewness 0.18");
    CHECK(whole_words(analysis, QualityMeasure::Error) == "0.2 mm, decimate share=0.02");
    CHECK(whole_words(analysis, QualityMeasure::Volume) ==
          "-1.20 % of the volume, decimate share=0.02");
    CHECK(whole_words(analysis, QualityMeasure::Triangles) == "2000");
    CHECK(shown_share(analysis, curve.points[0], QualityMeasure::Triangles) == 0.5);
    THEN("more triangles than before stay within the graph") {
        curve.points[1].scaled.triangles = 4.0;
        CHECK(shown_share(analysis, curve.points[1], QualityMeasure::Triangles) == 1.0);
        CHECK(shown_share(analysis, curve.points[0], QualityMeasure::Triangles) == 0.125);
        CHECK(whole_words(analysis, QualityMeasure::Triangles) == "8000");
    }
    THEN("curvature is seen only where suggestions aim at it") {
        const auto has = [&](const char* operation) {
            const auto seen = seen_measures(scale, find_operation(operation));
            return std::ranges::count(seen, QualityMeasure::Curvature) == 1;
        };
        CHECK_FALSE(has("decimate"));
        CHECK_FALSE(has("remesh"));
        CHECK(has("subdivide"));
        CHECK(has("smooth"));
    }
}
