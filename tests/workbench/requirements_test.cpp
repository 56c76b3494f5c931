#include "workbench/report/requirements.h"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "tests/support/shapes.h"
#include "workbench/prepare/model_figures.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;

namespace {

/// Of a tube of 48 equilateral triangles around, with distances as to be judged.
ModelFigures tube_figures() {
    ModelFigures figures = shape_figures(fine_tube(2.0, 30.0, 48));
    figures.mean_lost = 0.05;
    figures.largest_lost = 0.3;
    figures.voxel_diagonal = 0.8;
    return figures;
}

/// A tube of 132 rows, of which `count` are nine times as high as the others; each of them meets
/// two others by 48 of the tube's 19,000 edges.
Surface tube_with_jumps(int count) {
    const double row = 30.0 / 132;
    return mapped(fine_tube(2.0, 30.0, 48), [&](const Vec3& p) {
        const int below = static_cast<int>(std::lround(p.z() / row));
        return Vec3(p.x(), p.y(), p.z() + 8.0 * row * std::min(count, (below + 5) / 10));
    });
}

enum Row { kSmallFeatures, kRelations, kSmoothness, kResolution, kQuality, kHomogeneity };

Judgement judged(const std::string& purpose, const ModelFigures& figures, Row row) {
    return requirements_of(find_purpose(purpose), figures).at(row).judgement;
}

}  // namespace

SCENARIO("Requirements are as relevant as in Table 2.1 of the thesis",
         "[workbench][requirements]") {
    const auto column = [](const std::string& purpose) {
        std::string relevance;
        for (const Requirement& row : requirements_of(find_purpose(purpose), tube_figures()))
            relevance += row.relevance;
        return relevance;
    };
    //                    small features, spatial relations, smoothness, high resolution,
    //                    high triangle quality, triangle size homogeneity
    CHECK(column("planning") == "+++o--");
    CHECK(column("simulation") == "-o+o++");
    CHECK(column("cfd") == "+-++++");
    CHECK(column("rp") == "+-+o--");
    for (const Purpose& purpose : purposes())
        for (const char relevance : purpose.relevance)
            CHECK(std::string("+o-").find(relevance) != std::string::npos);
    THEN("a purpose without them is judged by none") {
        for (const Requirement& row : requirements_of(Purpose{.name = "teaching"}, tube_figures()))
            CHECK(
                (row.judgement == Judgement::NotJudged || row.judgement == Judgement::NotMeasured));
    }
}

SCENARIO("A fine tube meets what is required for flow simulation", "[workbench][requirements]") {
    const std::vector<Requirement> rows = requirements_of(find_purpose("cfd"), tube_figures());
    REQUIRE(rows.size() == 6);
    for (const Row row : {kSmallFeatures, kSmoothness, kResolution, kQuality, kHomogeneity}) {
        CAPTURE(rows[row].name);
        CHECK(rows[row].judgement == Judgement::Met);
        CHECK_FALSE(rows[row].limit.empty());
        CHECK_FALSE(rows[row].reason.empty());
    }
    CHECK(rows[kSmallFeatures].figures["largest_mm"] == 0.3);
    CHECK_THAT(rows[kSmallFeatures].limit, Contains("0.4 mm"));
    // Less than around the middle: beside a cap the lumen seems narrower.
    const double around = rows[kResolution].figures["edges_around"];
    CHECK(around == Approx(48.0).epsilon(0.2));
}

SCENARIO("What is wrong with a surface is not met", "[workbench][requirements]") {
    const auto cfd = [](const Surface& surface, Row row) {
        return judged("cfd", shape_figures(surface), row);
    };
    CHECK(cfd(cube(10.0), kSmoothness) == Judgement::NotMet);
    CHECK(cfd(fine_tube(2.0, 30.0, 6), kResolution) == Judgement::NotMet);
    const Surface stretched = mapped(
        fine_tube(2.0, 30.0, 48), [](const Vec3& p) { return Vec3(p.x(), p.y(), 10.0 * p.z()); });
    CHECK(cfd(stretched, kQuality) == Judgement::NotMet);
    CHECK(cfd(stretched, kHomogeneity) == Judgement::Met);
    THEN("sizes that jump at over 1 % of the wall's edges") {
        const ModelFigures figures = shape_figures(tube_with_jumps(13));
        CHECK(figures.largest_size_ratio == Approx(3.0).epsilon(0.01));
        CHECK(figures.percentile_99_size_ratio > 2.0);
        CHECK(figures.median_size_ratio < 1.3);
        CHECK(judged("cfd", figures, kHomogeneity) == Judgement::NotMet);
        CHECK(cfd(tube_with_jumps(1), kHomogeneity) == Judgement::Met);
    }
    THEN("a feature that is farther away than half the voxel's diagonal") {
        ModelFigures figures = tube_figures();
        figures.largest_lost = 0.41;
        CHECK(judged("cfd", figures, kSmallFeatures) == Judgement::NotMet);
        CHECK(judged("simulation", figures, kSmallFeatures) == Judgement::NotJudged);
    }
}

SCENARIO("What is of low relevance is measured and not judged", "[workbench][requirements]") {
    const std::vector<Requirement> rows = requirements_of(find_purpose("rp"), tube_figures());
    for (const Row row : {kQuality, kHomogeneity}) {
        CHECK(rows[row].judgement == Judgement::NotJudged);
        CHECK_FALSE(rows[row].figures.is_null());
    }
    CHECK(rows[kSmoothness].judgement == Judgement::Met);
}

SCENARIO("No limit is stated where none has a reason", "[workbench][requirements]") {
    ModelFigures figures = tube_figures();
    CHECK(judged("planning", figures, kResolution) == Judgement::NoLimit);
    CHECK(judged("rp", figures, kResolution) == Judgement::NoLimit);
    figures.print_resolution = 0.1;
    CHECK(judged("rp", figures, kResolution) == Judgement::Met);
    figures.sag = 0.11;
    CHECK(judged("rp", figures, kResolution) == Judgement::NotMet);
    figures.offset = 0.02;
    CHECK(judged("planning", figures, kRelations) == Judgement::NoLimit);
    figures.voxel_diagonal.reset();
    CHECK(judged("cfd", figures, kSmallFeatures) == Judgement::NoLimit);
    CHECK(requirements_of(find_purpose("cfd"), figures)[kSmallFeatures].limit.empty());
}

SCENARIO("What cannot be measured is said to be so", "[workbench][requirements]") {
    const ModelFigures figures = shape_figures(fine_tube(2.0, 30.0, 48));
    for (const Purpose& purpose : purposes())
        for (const Row row : {kSmallFeatures, kRelations})
            CHECK(judged(purpose.name, figures, row) == Judgement::NotMeasured);
    const auto json = requirements_json(requirements_of(find_purpose("cfd"), figures));
    CHECK(json[0]["requirement"] == "small features");
    CHECK(json[0]["judgement"] == "not measured");
    CHECK(json[0]["figures"].is_null());
    CHECK(json[4]["judgement"] == "met");
}

SCENARIO("A wall that has moved is measured against its source", "[workbench][requirements]") {
    Scene source, model;
    source.surface = fine_tube(2.0, 40.0, 96);
    source.sampling = Sampling{.spacing = Vec3(0.4, 0.4, 0.8), .confidence = 1.0};
    model.surface = fine_tube(2.1, 40.0, 96);
    model.neighbours["tumour"] = icosphere(1.0, 4, Vec3(5.0, 0.0, 20.0));
    const ModelFigures figures = model_figures(source, model, {}, {});
    CHECK(figures.largest_lost.value() == Approx(0.1).epsilon(0.02));
    CHECK(figures.offset.value() == Approx(0.1).epsilon(0.05));
    CHECK(figures.neighbours.at("tumour") == Approx(-0.1).epsilon(0.1));
    CHECK(figures.voxel_diagonal.value() == Approx(0.98).epsilon(0.01));
    CHECK(judged("planning", figures, kRelations) == Judgement::Met);
    THEN("ends that were cut off are not lost features") {
        model.surface = mapped(fine_tube(2.0, 20.0, 96), [](const Vec3& p) { return p; });
        const MadeEnd end{.centre = Vec3(0, 0, 20), .outward = Vec3::UnitZ(), .diameter = 4.0};
        CHECK(model_figures(source, model, {}, {}).largest_lost.value() > 15.0);
        CHECK(model_figures(source, model, {end}, {}).largest_lost.value() < 0.01);
    }
    THEN("a stump that was cut off changes no distance to a neighbour") {
        model.surface = fine_tube(2.0, 20.0, 96);
        const MadeEnd end{.centre = Vec3(0, 0, 20), .outward = Vec3::UnitZ(), .diameter = 4.0};
        // The nerve is beside the stump; the rows that end the compared walls are 0.11 mm high.
        model.neighbours = {{"nerve", icosphere(1.0, 4, Vec3(5.0, 0.0, 35.0))},
                            {"tumour", icosphere(1.0, 4, Vec3(5.0, 0.0, 10.0))}};
        const ModelFigures cut = model_figures(source, model, {end}, {});
        CHECK(cut.neighbours.at("nerve") == Approx(0.0).margin(0.12));
        CHECK(cut.neighbours.at("tumour") == Approx(0.0).margin(0.02));
        CHECK(judged("planning", cut, kRelations) == Judgement::Met);
        CHECK(model_figures(source, model, {}, {}).neighbours.at("nerve") > 10.0);
    }
    THEN("a wall that moves within a closed neighbour changes its distance") {
        model.neighbours = {{"tumour", icosphere(1.0, 4, Vec3(2.3, 0.0, 20.0))}};
        CHECK(model_figures(source, model, {}, {}).neighbours.at("tumour") ==
              Approx(-0.1).epsilon(0.2));
    }
    THEN("a neighbour that is open has no inside") {
        model.neighbours = {{"skin", open_tube(5.0, 40.0, 96, 40)}};
        CHECK(model_figures(source, model, {}, {}).neighbours.at("skin") ==
              Approx(-0.1).epsilon(0.05));
    }
    THEN("an estimated sampling gives no limit") {
        source.sampling->confidence = 0.9;
        CHECK_FALSE(model_figures(source, model, {}, {}).voxel_diagonal.has_value());
    }
}
