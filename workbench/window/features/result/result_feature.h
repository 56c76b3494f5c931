#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "workbench/session/task.h"
#include "workbench/window/core/core.h"
#include "workbench/window/features/result/result_figures.h"

namespace vesselbench {

/// What a recipe or a run of pending edits has made, for its card.
struct ResultCard {
    std::string model;  ///< "Model for printing"
    std::string what;   ///< "Ran 5 pending edits"
    std::vector<ResultRow> rows;
    std::size_t warnings = 0;
    bool can_compare = false;  ///< with the model before
};

/// The card of the model that was made last. It goes when it is closed, when a form or a step is
/// chosen, and is not shown while another state or variant is.
class ResultFeature : public Feature {
public:
    explicit ResultFeature(Core& core) : core_(core), measuring_(core.wake()) {}

    /// None: there is none to be shown now.
    [[nodiscard]] const ResultCard* card() const;

    /// Shows the model beside the one before it; without one, all of it.
    void look();

    void close() { card_.reset(); }

    [[nodiscard]] bool update() override;

    [[nodiscard]] bool pending() const override { return waits_ || measuring_.pending(); }

    void form_dropped() override { close(); }

    void case_opened() override { forget(); }

    void case_closed() override { forget(); }

private:
    using Figures = std::pair<std::optional<ResultFigures>, std::optional<ResultFigures>>;

    void forget();
    void measure();
    void take(const Figures& figures);
    [[nodiscard]] bool is_shown(const MadeModel& made) const;

    Core& core_;
    int seen_made_ = 0;   ///< Document::made_models()
    bool waits_ = false;  ///< until the model is read
    Task<Figures> measuring_;
    std::optional<ResultCard> card_;
};

}  // namespace vesselbench
