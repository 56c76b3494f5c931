#include "workbench/window/model/quality_words.h"

#include <catch2/catch.hpp>

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
