#pragma once

#include <optional>

#include "workbench/window/core/core.h"
#include "workbench/window/features/compare/comparison.h"

namespace vesselbench {

/// Comparing a state of the history with what is shown.
class CompareFeature : public Feature {
public:
    explicit CompareFeature(Core& core) : core_(core) {}

    /// None while nothing is compared.
    [[nodiscard]] std::optional<Comparison>& comparison() { return comparison_; }

    /// Compares a reference with the shown scene, in the mode of the last time; the same again ends
    /// it.
    void compare(const Reference& reference);

    /// The same in a mode.
    void compare(const Reference& reference, CompareMode mode);

    void stop();

    [[nodiscard]] bool update() override;
    [[nodiscard]] bool pending() const override;
    [[nodiscard]] float banner(PanelContext& context, const ScreenRect& place) override;

    void case_opened() override { stop(); }

    void case_closed() override { stop(); }

    void give_way() override { stop(); }

private:
    Core& core_;
    std::optional<Comparison> comparison_;
    CompareMode mode_ = CompareMode::SideBySide;
};

}  // namespace vesselbench
