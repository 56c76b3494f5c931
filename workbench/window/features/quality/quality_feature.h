#pragma once

#include "workbench/window/core/core.h"
#include "workbench/window/features/quality/quality_analysis.h"

namespace vesselbench {

/// What is known of the quality that the form's parameters give.
class QualityFeature : public Feature {
public:
    explicit QualityFeature(Core& core) : core_(core), quality_(core.wake()) {}

    [[nodiscard]] QualityAnalysis& quality() { return quality_; }

    /// As Core::begin_drag(), for a value that is dragged in a quality graph; the model follows if
    /// it can.
    void begin_setting();

    /// True while a value is dragged that graphs are of.
    [[nodiscard]] bool is_setting() const;

    [[nodiscard]] bool update() override;

    [[nodiscard]] bool pending() const override { return quality_.pending(); }

private:
    Core& core_;
    QualityAnalysis quality_;
    int set_ = 0;  ///< number of the drag of a value whose model does not follow
};

}  // namespace vesselbench
