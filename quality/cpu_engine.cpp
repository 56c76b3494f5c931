#include <algorithm>
#include <utility>

#include "quality/smoothing_engine.h"

namespace vesselbench {

namespace {

class CpuRun final : public MeasuredRun {
public:
    CpuRun(const SurfaceMeter& meter, const std::shared_ptr<const FilterRun::Ground>& ground,
           const SmoothingChoice& choice)
        : meter_(meter),
          run_(ground, choice.filter, choice.weights),
          references_(meter.own_references()) {}

    void advance_to(int iterations, const Progress& progress) override {
        while (run_.iterations() < iterations) {
            follow();
            const int next = (run_.iterations() / kFollowEvery + 1) * kFollowEvery;
            run_.advance(std::min(next, iterations) - run_.iterations(), progress);
            followed_ = false;
            progress.check_cancelled();
        }
    }

    [[nodiscard]] int iterations() const override { return run_.iterations(); }

    [[nodiscard]] QualityMeasures measure() override {
        if (followed_ || !at_stop()) return meter_.measure(run_.packs(), references_);
        followed_ = true;
        return meter_.follow_and_measure(run_.packs(), references_);
    }

    [[nodiscard]] std::unique_ptr<MeasuredRun> copy() const override {
        return std::make_unique<CpuRun>(*this);
    }

private:
    [[nodiscard]] bool at_stop() const { return run_.iterations() % kFollowEvery == 0; }

    void follow() {
        if (!followed_ && at_stop()) meter_.follow(run_.packs(), references_);
        followed_ = true;
    }

    const SurfaceMeter& meter_;
    FilterRun run_;
    std::vector<VertexId> references_;
    bool followed_ = true;  ///< the references passed the last stop
};

class CpuEngine final : public SmoothingEngine {
public:
    CpuEngine(FilterGround ground, bool planes)
        : ground_(FilterRun::prepare(std::move(ground))),
          meter_(*FilterRun::ground_of(*ground_).topology, *FilterRun::ground_of(*ground_).start,
                 planes, FilterRun::order_of(*ground_)) {}

    [[nodiscard]] std::unique_ptr<MeasuredRun> start(const SmoothingChoice& choice) const override {
        return std::make_unique<CpuRun>(meter_, ground_, choice);
    }

    [[nodiscard]] const QualityMeasures& original() const override { return meter_.original(); }

    [[nodiscard]] double mean_edge() const override { return meter_.mean_edge(); }

    [[nodiscard]] bool concurrent() const override { return true; }

    [[nodiscard]] std::size_t run_bytes() const override {
        return FilterRun::ground_of(*ground_).start->size() * 96;
    }

private:
    std::shared_ptr<const FilterRun::Ground> ground_;
    SurfaceMeter meter_;
};

}  // namespace

std::shared_ptr<const SmoothingEngine> make_cpu_engine(FilterGround ground, bool planes) {
    return std::make_shared<CpuEngine>(std::move(ground), planes);
}

}  // namespace vesselbench
