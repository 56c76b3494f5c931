#include "smoothing/quality/cpu_engine.h"

#include <algorithm>
#include <utility>

namespace vesselbench {

namespace {

constexpr std::size_t kEnoughToEstimate =
    20000;  // vertices: a sample of these errs by about 3 per cent

enum class Sample { All, Some };

class CpuRun final : public FollowingRun {
public:
    CpuRun(const SurfaceMeter& meter, double radius,
           const std::shared_ptr<const FilterRun::Ground>& ground, const SmoothingChoice& choice,
           Sample sample)
        : meter_(meter),
          radius_(radius),
          sample_(sample),
          run_(ground, choice.filter, weights_of(choice)),
          references_(meter.own_references()) {}

    [[nodiscard]] int iterations() const override { return run_.iterations(); }

    [[nodiscard]] QualityMeasures measure() override {
        const QualityMeasures measures = measured();
        require_bounded(measures, radius_);
        return measures;
    }

    [[nodiscard]] std::unique_ptr<MeasuredRun> copy() const override {
        return std::make_unique<CpuRun>(*this);
    }

private:
    [[nodiscard]] QualityMeasures measured() {
        if (sample_ == Sample::Some) {
            if (at_stop()) return meter_.follow_and_estimate(run_.packs(), references_);
            std::vector<VertexId> references =
                references_;  // those of the run itself change only at the stop
            return meter_.follow_and_estimate(run_.packs(), references);
        }
        if (!due()) return meter_.measure(run_.packs(), references_);
        set_followed();
        return meter_.follow_and_measure(run_.packs(), references_);
    }

    void smooth(int iterations, const Progress& progress) override {
        run_.advance(iterations, progress);
    }

    void follow() override {
        if (sample_ == Sample::All) meter_.follow(run_.packs(), references_);
    }

    const SurfaceMeter& meter_;
    double radius_;  ///< of the original [mm]
    Sample sample_;
    FilterRun run_;
    std::vector<VertexId> references_;
};

class CpuEngine final : public SmoothingEngine {
public:
    CpuEngine(FilterGround ground, bool planes)
        : ground_(FilterRun::prepare(std::move(ground))),
          meter_(FilterRun::ground_of(*ground_).topology, FilterRun::ground_of(*ground_).start,
                 planes, FilterRun::order_of(*ground_)),
          radius_(radius_of(*FilterRun::ground_of(*ground_).start)) {}

    [[nodiscard]] std::unique_ptr<MeasuredRun> start(const SmoothingChoice& choice) const override {
        return std::make_unique<CpuRun>(meter_, radius_, ground_, choice, Sample::All);
    }

    [[nodiscard]] bool estimates() const override { return vertices() >= kEnoughToEstimate; }

    [[nodiscard]] std::unique_ptr<MeasuredRun> start_estimate(
        const SmoothingChoice& choice) const override {
        return std::make_unique<CpuRun>(meter_, radius_, ground_, choice, Sample::Some);
    }

    [[nodiscard]] const QualityMeasures& original() const override { return meter_.original(); }

    [[nodiscard]] double mean_edge() const override { return meter_.mean_edge(); }

    [[nodiscard]] bool concurrent() const override { return true; }

    [[nodiscard]] std::size_t run_bytes() const override { return vertices() * 96; }

private:
    [[nodiscard]] std::size_t vertices() const {
        return FilterRun::ground_of(*ground_).start->size();
    }

    std::shared_ptr<const FilterRun::Ground> ground_;
    SurfaceMeter meter_;
    double radius_;  ///< of the original [mm]
};

}  // namespace

std::shared_ptr<const SmoothingEngine> make_cpu_engine(FilterGround ground, bool planes) {
    return std::make_shared<CpuEngine>(std::move(ground), planes);
}

}  // namespace vesselbench
