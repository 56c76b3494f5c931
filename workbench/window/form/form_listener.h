#pragma once

#include "workbench/window/case/pick_target.h"

namespace vesselbench {

/// Who hears what happens to the form of a FormDesk.
class FormListener {
public:
    FormListener() = default;
    virtual ~FormListener() = default;

    FormListener(const FormListener&) = delete;
    FormListener& operator=(const FormListener&) = delete;

    /// Another form is shown.
    virtual void form_shown() {}

    /// The form, if there is one, is closed, or about to be replaced.
    virtual void form_dropped() {}

    /// A field has another text.
    virtual void field_changed() {}

    /// Clicks are for a parameter from now on.
    virtual void parameter_armed(PickTarget) {}

    /// The texts from before a drag were brought back.
    virtual void drag_undone() {}

    /// The view is needed for the model alone, such as to click on it.
    virtual void model_wanted() {}

    /// False while what the form is about is not known.
    [[nodiscard]] virtual bool allows_apply() const { return true; }

    /// The form is about to be run, or its preview to be entered.
    virtual void applying() {}
};

}  // namespace vesselbench
