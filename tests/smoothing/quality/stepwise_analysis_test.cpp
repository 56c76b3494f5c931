#include "smoothing/quality/stepwise_analysis.h"

#include <stop_token>
#include <vector>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "smoothing/quality/cpu_engine.h"
#include "smoothing/quality/smoothing_space.h"
#include "tests/support/iso_surface.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

std::shared_ptr<const SmoothingEngine> engine_of(const Surface& surface) {
    return make_cpu_engine({.topology = surface.topology, .start = surface.positions});
}

SearchSpace laplace_space() {
    return smoothing_space({.filter = LaplaceParameters{}});
}

/// An engine whose runs never end by themselves.
class EndlessEngine final : public SmoothingEngine {
public:
    explicit EndlessEngine(std::stop_source stop) : stop_(std::move(stop)) {}

    class Run final : public MeasuredRun {
    public:
        explicit Run(std::stop_source stop) : stop_(std::move(stop)) {}

        void advance_to(int, const Progress& progress) override {
            stop_.request_stop();  // as a newer value does
            while (true) progress.check_cancelled();
        }

        [[nodiscard]] int iterations() const override { return 0; }

        [[nodiscard]] QualityMeasures measure() override { return {}; }

        [[nodiscard]] std::unique_ptr<MeasuredRun> copy() const override {
            return std::make_unique<Run>(stop_);
        }

    private:
        std::stop_source stop_;
    };

    [[nodiscard]] std::unique_ptr<MeasuredRun> start(const SmoothingChoice&) const override {
        return std::make_unique<Run>(stop_);
    }

    [[nodiscard]] const QualityMeasures& original() const override { return original_; }

    [[nodiscard]] double mean_edge() const override { return 1.0; }

    [[nodiscard]] bool concurrent() const override { return true; }

    [[nodiscard]] std::size_t run_bytes() const override { return 1; }

private:
    QualityMeasures original_;
    mutable std::stop_source stop_;
};

/// Counts the runs that are started.
class CountingEngine final : public SmoothingEngine {
public:
    explicit CountingEngine(std::shared_ptr<const SmoothingEngine> engine)
        : engine_(std::move(engine)) {}

    [[nodiscard]] std::unique_ptr<MeasuredRun> start(const SmoothingChoice& choice) const override {
        ++full;
        return engine_->start(choice);
    }

    [[nodiscard]] bool estimates() const override { return true; }

    [[nodiscard]] std::unique_ptr<MeasuredRun> start_estimate(
        const SmoothingChoice& choice) const override {
        ++rough;
        return engine_->start(choice);
    }

    [[nodiscard]] const QualityMeasures& original() const override { return engine_->original(); }

    [[nodiscard]] double mean_edge() const override { return engine_->mean_edge(); }

    [[nodiscard]] bool concurrent() const override { return false; }

    [[nodiscard]] std::size_t run_bytes() const override { return engine_->run_bytes(); }

    mutable int full = 0, rough = 0;

private:
    std::shared_ptr<const SmoothingEngine> engine_;
};

std::vector<StepwiseAnswer> answers_of(ParameterSearch& search, const ParameterSet& current) {
    std::vector<StepwiseAnswer> answers;
    analyse_step_by_step(search, search, current,
                         [&](const StepwiseAnswer& answer) { answers.push_back(answer); }, {});
    return answers;
}

}  // namespace

SCENARIO("Answers come coarsely first, then finer", "[quality][live]") {
    const Surface ball = with_noise(icosphere(10.0, 3), 0.2);
    ParameterSearch search(engine_of(ball), laplace_space(), {.tau = 0.5});
    const auto answers = answers_of(search, {0.5, 20.0});
    REQUIRE(answers.size() == 4);
    CHECK(answers[0].analysis.curves[1].points.size() == 11);
    CHECK(answers[1].analysis.curves[1].points.size() == 51);
    CHECK_FALSE(answers[1].best);
    CHECK(answers[3].best->score <= answers[2].best->score);
    CHECK(answers[3].complete);
}

SCENARIO("While a value is dragged, suggestions come from estimates", "[quality][live]") {
    const Surface ball = with_noise(icosphere(10.0, 3), 0.2);
    const auto engine = std::make_shared<CountingEngine>(engine_of(ball));
    ParameterSearch graphs(engine, laplace_space(), {.tau = 0.5});
    ParameterSearch best(engine, laplace_space(), {.tau = 0.5});
    std::vector<StepwiseAnswer> answers;
    const auto drag = [&](const ParameterSet& current) {
        answers.clear();
        analyse_dragged(graphs, best, current,
                        [&](const StepwiseAnswer& answer) { answers.push_back(answer); }, {});
        REQUIRE(answers.size() == 2);
    };
    drag({0.5, 20.0});
    CHECK(answers[0].analysis.curves[1].points.size() == 11);
    CHECK_FALSE(answers[0].best);
    CHECK(answers[1].best);
    CHECK_FALSE(answers[1].complete);
    CHECK(engine->rough > 10);
    CHECK(engine->full == 2);  // the graphs' scale, and the best of all
    const double suggested = answers[0].analysis.curves[1].suggested;
    THEN("the suggestion is the coarse value of the lowest score") {
        ParameterSearch alone(engine_of(ball), laplace_space(), {.tau = 0.5});
        CHECK(suggested == quality_curve(alone, 1, {0.5, 20.0}, CurveValues::Coarse).suggested);
    }
    THEN("it follows the other parameter, and what was found is not found again") {
        drag({0.1, 20.0});
        CHECK(answers[0].analysis.curves[1].suggested > suggested);
        const int runs = engine->rough + engine->full;
        drag({0.5, 20.0});
        CHECK(answers[0].analysis.curves[1].suggested == suggested);
        CHECK(engine->rough + engine->full == runs);
    }
}

SCENARIO("The complete answer does not depend on earlier values", "[quality][live]") {
    const Surface ball = with_noise(icosphere(10.0, 3), 0.2);
    const ParameterSet last = {0.78, 20.0};
    const ScoreSettings score = {.tau = 0.78};
    ParameterSearch search(engine_of(ball), laplace_space(), {});
    for (int i = 0; i < 4; ++i) {
        search.set_score({.tau = 0.2 * i});
        static_cast<void>(answers_of(search, {0.2 * i, 20.0}));
    }
    search.set_score(score);
    const StepwiseAnswer complete = answers_of(search, last).back();
    ParameterSearch alone(engine_of(ball), laplace_space(), score);
    CHECK(complete.best->values == alone.refined(alone.exhaustive(true), 2).values);
    const auto curves = sensitivity(alone, last).curves;
    REQUIRE(complete.analysis.curves.size() == curves.size());
    for (std::size_t i = 0; i < curves.size(); ++i)
        for (std::size_t k = 0; k < curves[i].points.size(); ++k)
            CHECK(complete.analysis.curves[i].points[k].measures == curves[i].points[k].measures);
}

SCENARIO("An endless analysis is stopped, and sends nothing then", "[quality][live]") {
    std::stop_source stop;
    ParameterSearch search(std::make_shared<EndlessEngine>(stop), laplace_space(), {});
    int answers = 0;
    CHECK_THROWS_AS(analyse_step_by_step(
                        search, search, {0.5, 20.0}, [&](const StepwiseAnswer&) { ++answers; },
                        Progress(nullptr, stop.get_token())),
                    Cancelled);
    CHECK(answers == 0);
}
