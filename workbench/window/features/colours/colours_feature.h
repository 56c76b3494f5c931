#pragma once

#include "workbench/window/core/core.h"
#include "workbench/window/features/colours/view_data.h"
#include "workbench/window/features/colours/worst_places.h"

namespace vesselbench {

/// What the view shows besides the surface: colours, centerlines, the worst places of colours.
class ColoursFeature : public Feature {
public:
    explicit ColoursFeature(Core& core) : core_(core), view_data_(core.wake()) {}

    /// As far as it is chosen and known.
    [[nodiscard]] const ViewData& view_data() const { return view_data_; }

    /// Looks at the next worst place of what the colours show; back with -1. Says why if it cannot.
    void look_at_worst(int steps);

    [[nodiscard]] bool update() override;

    [[nodiscard]] bool pending() const override { return view_data_.pending(); }

    void keys(PanelContext& context) override;

private:
    [[nodiscard]] std::string why_no_worst() const;

    Core& core_;
    ViewData view_data_;
    WorstTour worst_;
};

}  // namespace vesselbench
