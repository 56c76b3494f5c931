#pragma once

#include <memory>
#include <utility>

#include "workbench/window/core/core.h"
#include "workbench/window/features/slices/image_slices.h"

namespace vesselbench {

/// Slices of the shown scene's image.
class SlicesFeature : public Feature {
public:
    explicit SlicesFeature(Core& core) : core_(core), slices_(core.wake()) {}

    [[nodiscard]] ImageSlices& slices() { return slices_; }

    /// The surface whose outline the slices show in place of the scene's; null: the scene's.
    void outline(std::shared_ptr<const Surface> surface) { outline_ = std::move(surface); }

    [[nodiscard]] bool update() override;

    [[nodiscard]] bool pending() const override { return slices_.pending(); }

    void keys(PanelContext& context) override;

    void case_opened() override { slices_.clear(); }

    void case_closed() override { slices_.clear(); }

    void form_shown() override;

    void form_dropped() override { slices_.lend_row(false); }

    void parameter_armed(PickTarget target) override;

    void looked_at(const Vec3& place) override { slices_.set_cross(place); }

private:
    Core& core_;
    ImageSlices slices_;
    std::shared_ptr<const Surface> outline_;
};

}  // namespace vesselbench
