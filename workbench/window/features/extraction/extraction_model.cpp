#include "workbench/window/features/extraction/extraction_model.h"

#include <chrono>
#include <utility>

namespace vesselbench {

namespace {

using namespace std::chrono_literals;

/// The value rests: what takes longer may begin.
constexpr auto kRest = 150ms;

/// What the thread keeps between questions: the extractor of the last image.
class Extracting final : public Answerer<ExtractionQuestion, ExtractionModel> {
public:
    void answer(const ExtractionQuestion& question,
                const TaskTurn<ExtractionModel>& turn) override {
        LiveExtractor& extractor = extractor_of(question);
        const auto send = [&](LiveExtractor::State state) {
            turn.send({turn.number, std::move(state), extractor.histogram()});
        };
        if (auto state = extractor.coarse(question.arguments, turn.progress))
            send(std::move(*state));
        if (extractor.has_coarse() && !turn.rests(kRest)) return;
        send(extractor.whole(question.arguments, turn.progress));
    }

    void forget() override { extractor_.reset(); }

private:
    LiveExtractor& extractor_of(const ExtractionQuestion& question) {
        if (extractor_ && base_ == question.base) return *extractor_;
        extractor_.reset();  // not both at once
        extractor_.emplace(question.image, question.mask, kCoarseVoxels, question.vessel);
        base_ = question.base;
        return *extractor_;
    }

    int base_ = 0;
    std::optional<LiveExtractor> extractor_;
};

}  // namespace

ExtractionModels::Maker live_extracting() {
    return [] { return std::make_unique<Extracting>(); };
}

}  // namespace vesselbench
