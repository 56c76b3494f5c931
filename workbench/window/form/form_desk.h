#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "workbench/window/case/document.h"
#include "workbench/window/case/pick_target.h"
#include "workbench/window/case/rerun.h"
#include "workbench/window/form/automatic_values.h"
#include "workbench/window/form/field_text.h"
#include "workbench/window/form/form_listener.h"
#include "workbench/window/form/label_list.h"
#include "workbench/window/form/operation_form.h"

namespace vesselbench {

/// A document and the form that is open for one of its edits: which one, what its fields say, what
/// clicks and drags give it, its preview. Used by one thread.
class FormDesk {
public:
    explicit FormDesk(const DocumentOptions& options);
    virtual ~FormDesk() = default;

    FormDesk(const FormDesk&) = delete;
    FormDesk& operator=(const FormDesk&) = delete;

    Document document;

    // --- the form

    [[nodiscard]] std::optional<OperationForm>& form() { return form_; }

    [[nodiscard]] const std::optional<OperationForm>& form() const { return form_; }

    /// Null if there is none.
    [[nodiscard]] const OperationForm* open_form() const { return form_ ? &*form_ : nullptr; }

    [[nodiscard]] Step step() const { return step_; }

    /// Shows the operations of a step.
    void choose_step(Step step);

    /// Shows the form of an operation, and the model that its edit will run on. The edit will
    /// belong to the given step if the operation is allowed there, else to its usual step. \throw
    /// UsageError if there is none of this name
    void choose(const std::string& operation, std::optional<Step> step = {});

    /// Shows the form of an edit of the current state, and the model that it runs on. Ignored if
    /// the operation is of another version.
    void choose_edit(EditId edit);

    /// Closes the form and drops its preview: the newest model is shown.
    void leave_form();

    /// The form's command line.
    [[nodiscard]] std::string command() const;

    // --- its fields

    void set_field(const std::string& parameter, const std::string& text);

    /// The field of a parameter gets the keyboard in the next frame that draws it; empty: none.
    void want_field(const std::string& parameter) { wanted_field_ = parameter; }

    [[nodiscard]] const std::string& wanted_field() const { return wanted_field_; }

    void fill_form(const std::vector<FieldText>& texts);
    void reset_form();

    /// True while what fields show is not known: automatic values, labels.
    [[nodiscard]] bool finds_field_values() const {
        return automatic_.pending() || labels_.pending();
    }

    /// The labels that the form may take.
    [[nodiscard]] const LabelList& labels() const { return labels_; }

    // --- running it

    [[nodiscard]] bool can_change() const { return document.can(RequestKind::Edit); }

    [[nodiscard]] bool can_apply() const;
    void preview();

    /// Enters the preview if it is of what the form says, else runs the form.
    void apply();

    /// The same, and then the edits that it makes pending.
    void apply_and_run();

    /// What apply_and_run() runs after the form's edit.
    [[nodiscard]] Rerun following() const;

    // --- clicks

    /// Lets clicks give a value to a parameter of the form; an armed one is disarmed. Drops a
    /// preview, whose surface is not what the operation will run on.
    void arm(const std::string& parameter);

    void disarm() { armed_.clear(); }

    /// The parameter that clicks are for; empty: none.
    [[nodiscard]] const std::string& armed() const { return armed_; }

    /// What a click means now; none unless a parameter is armed.
    [[nodiscard]] std::optional<PickTarget> armed_target() const;

    /// Fills in the armed parameter, and disarms it when its value is complete. Ignored while the
    /// view shows another model than the edit will run on.
    void pick(const Vec3& point);

    /// Adds a label to the armed parameter, or removes it.
    void pick_label(int label);

    /// The view is needed for the model alone.
    void want_model();

    // --- drags

    /// Begins to drag something that fields follow. \return the drag's number, > 0
    int begin_drag();

    /// Fills in fields during a drag.
    void drag(const std::vector<FieldText>& texts);

    void end_drag();

    /// Ends a drag, and brings back the texts from before it.
    void cancel_drag();

    /// Brings back the texts from before the last drag. \return false if it changed nothing, or
    /// something was entered since
    bool take_back_drag();

    /// The form when the drag began; none: nothing is dragged.
    [[nodiscard]] const std::optional<OperationForm>& before_drag() const { return before_drag_; }

    /// Number of the last drag; 0: there was none.
    [[nodiscard]] int drags() const { return drags_; }

    [[nodiscard]] bool is_dragging(int number) const { return before_drag_ && drags_ == number; }

protected:
    using Listen = std::function<void(FormListener&)>;

    /// Calls it for all that listen.
    virtual void for_listeners(const Listen& call) = 0;

    /// True if all that listen allow the form to be run.
    [[nodiscard]] virtual bool listeners_allow_apply() const = 0;

    /// Closes the form of an edit that was entered meanwhile.
    void take_entered();

    /// \return true if what fields show has changed
    bool update_field_values();

private:
    void drop_form();
    void end_applied_form();
    void show_form();
    void arm_required();
    void bring_back(const OperationForm& before);
    [[nodiscard]] Arguments suggested_arguments(const Operation& operation) const;
    [[nodiscard]] bool preview_is_current() const;

    std::optional<OperationForm> form_;
    int form_number_ = 0;    ///< counts forms
    int applied_form_ = -1;  ///< the one that apply() was called for
    Step step_ = Step::Source;
    int previewed_changes_ = -1;  ///< the form's, when its preview was asked for
    int seen_entered_ = 0;
    std::string armed_, wanted_field_;
    int drags_ = 0;
    std::optional<OperationForm> before_drag_;
    std::optional<OperationForm> dragged_;  ///< the form before the drag that ended last
    int dragged_changes_ = -1;              ///< the form's at that end
    AutomaticValues automatic_;
    LabelList labels_;
};

}  // namespace vesselbench
