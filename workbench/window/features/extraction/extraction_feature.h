#pragma once

#include "workbench/window/core/core.h"
#include "workbench/window/features/extraction/live_extraction.h"

namespace vesselbench {

/// The surface of the image follows the form that extracts it, while its iso-value slides.
class ExtractionFeature : public Feature {
public:
    explicit ExtractionFeature(Core& core) : core_(core), extraction_(core.wake()) {}

    [[nodiscard]] LiveExtraction& extraction() { return extraction_; }

    /// Begins or ends to show what the form says, also in the slices.
    void follow(bool on);

    /// As Core::begin_drag(), and the surface follows the form from now on.
    void begin_sliding();

    [[nodiscard]] bool is_sliding() const { return core_.is_dragging(slid_); }

    void slide(double iso);

    [[nodiscard]] bool update() override;

    [[nodiscard]] bool pending() const override { return extraction_.pending(); }

    [[nodiscard]] float banner(PanelContext& context, const ScreenRect& place) override;

    void form_dropped() override { extraction_.follow(false); }

    void drag_undone() override;

private:
    Core& core_;
    LiveExtraction extraction_;
    int slid_ = 0;  ///< number of the drag that slides the iso-value
};

}  // namespace vesselbench
