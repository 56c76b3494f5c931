#include "smoothing/quality/live_analysis.h"

#include <random>

#include <catch2/catch.hpp>

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
    class Run final : public MeasuredRun {
    public:
        void advance_to(int iterations, const Progress& progress) override {
            while (true) {
                progress.check_cancelled();
                std::this_thread::yield();
                static_cast<void>(iterations);
            }
        }

        [[nodiscard]] int iterations() const override { return 0; }

        [[nodiscard]] QualityMeasures measure() override { return {}; }

        [[nodiscard]] std::unique_ptr<MeasuredRun> copy() const override {
            return std::make_unique<Run>();
        }
    };

    [[nodiscard]] std::unique_ptr<MeasuredRun> start(const SmoothingChoice&) const override {
        return std::make_unique<Run>();
    }

    [[nodiscard]] const QualityMeasures& original() const override { return original_; }

    [[nodiscard]] double mean_edge() const override { return 1.0; }

    [[nodiscard]] bool concurrent() const override { return true; }

    [[nodiscard]] std::size_t run_bytes() const override { return 1; }

private:
    QualityMeasures original_;
};

}  // namespace

SCENARIO("Answers come coarsely first, then finer", "[quality][live]") {
    const Surface ball = with_noise(icosphere(10.0, 3), 0.2);
    std::vector<LiveAnswer> answers;
    LiveAnalysis live({engine_of(ball), laplace_space(), {}},
                      [&](const LiveAnswer& answer) { answers.push_back(answer); });
    live.ask({0.5, 20.0}, {.tau = 0.5});
    live.wait();
    REQUIRE(answers.size() == 4);
    CHECK(answers[0].analysis.curves[1].points.size() == 11);
    CHECK(answers[1].analysis.curves[1].points.size() == 51);
    CHECK_FALSE(answers[1].best);
    CHECK(answers[3].best->score <= answers[2].best->score);
    CHECK(answers[3].complete);
}

SCENARIO("A new value stops the running analysis, and no old answer follows", "[quality][live]") {
    const Surface ball = with_noise(icosphere(10.0, 3), 0.2);
    std::vector<LiveAnswer> answers;
    LiveAnalysis live({engine_of(ball), laplace_space(), {}},
                      [&](const LiveAnswer& answer) { answers.push_back(answer); });
    std::uint64_t last = 0;
    for (int i = 0; i < 40; ++i) last = live.ask({0.02 * i, 20.0}, {.tau = 0.02 * i});
    live.wait();
    REQUIRE_FALSE(answers.empty());
    CHECK(answers.back().request == last);
    CHECK(answers.back().complete);
    for (std::size_t i = 1; i < answers.size(); ++i)
        CHECK(answers[i - 1].request <= answers[i].request);
    THEN("the complete answer is that of a search of its own") {
        ParameterSearch alone(engine_of(ball), laplace_space(), {.tau = 0.02 * 39});
        CHECK(answers.back().best->values == alone.refined(alone.exhaustive(true), 2).values);
        const auto curves = sensitivity(alone, {0.02 * 39, 20.0}).curves;
        for (std::size_t i = 0; i < curves.size(); ++i)
            for (std::size_t k = 0; k < curves[i].points.size(); ++k)
                CHECK(answers.back().analysis.curves[i].points[k].measures ==
                      curves[i].points[k].measures);
    }
}

SCENARIO("An endless analysis is stopped by the next value and on destruction", "[quality][live]") {
    int answers = 0;
    {
        LiveAnalysis live({std::make_shared<EndlessEngine>(), laplace_space(), {}},
                          [&](const LiveAnswer&) { ++answers; });
        for (int i = 0; i < 5; ++i) {
            live.ask({0.5, 20.0}, {});
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
    }
    CHECK(answers == 0);
}
