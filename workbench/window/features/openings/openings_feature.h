#pragma once

#include <optional>

#include "workbench/window/core/core.h"
#include "workbench/window/features/openings/openings_model.h"

namespace vesselbench {

/// The vessel ends of a form that opens them, and the roles of openings.
class OpeningsFeature : public Feature {
public:
    explicit OpeningsFeature(Core& core) : core_(core), openings_(core.wake()) {}

    /// All vessel ends of a form that opens them.
    [[nodiscard]] OpeningsModel& openings() { return openings_; }

    /// Chooses its end in the form's table; or adds an opening to the form's openings, or takes it
    /// away; or asks for its role, if the form is one that sets roles, or there is none.
    void click(const PatchMeasures& opening);

    /// The opening whose role is asked for.
    [[nodiscard]] const std::optional<PatchMeasures>& role_question() const { return asked_; }

    /// Fills in the form so that the opening gets a role: of the edit that opened all ends, if it
    /// made this opening and it becomes the inlet, else of a new edit.
    void give_role(PatchKind role);

    void forget_role_question() { asked_.reset(); }

    [[nodiscard]] bool update() override;

    [[nodiscard]] bool pending() const override { return openings_.pending(); }

    void form_shown() override;

    void form_dropped() override {
        forget_role_question();
        wanted_inlet_.reset();
        keeps_ends_ = false;
    }

    [[nodiscard]] bool allows_apply() const override {
        return !wanted_inlet_ && openings_.can_apply();
    }

private:
    /// Fills in an edit's form that its ends stay what it made of them, whatever the odds say of
    /// its input now, and the inlet that is wanted.
    void keep_ends();

    Core& core_;
    OpeningsModel openings_;
    std::optional<PatchMeasures> asked_;
    std::optional<Vec3> wanted_inlet_;  ///< becomes the inlet when the form's ends are known
    bool keeps_ends_ = false;           ///< when the ends of an edit's form are known
    int seen_scenes_ = -1;              ///< the document's scene changes
};

}  // namespace vesselbench
