#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "geometry/vessel/openings/planned_cut.h"
#include "workbench/session/task.h"
#include "workbench/window/case/document.h"
#include "workbench/window/features/openings/end_rows.h"
#include "workbench/window/form/operation_form.h"

namespace vesselbench {

/// All vessel ends of a form of clip-opening: what is planned for them, and what the user wants
/// otherwise. The form's texts hold the wishes; plans are made in the background, on the document's
/// current model, on which the operation runs. Used by the frame's thread.
class OpeningsModel {
public:
    /// \param wake called by the other thread when update() has something to do
    explicit OpeningsModel(std::function<void()> wake) : task_(std::move(wake)) {}

    /// Once a frame. \param form null: none \return true if something has changed
    bool update(const Document& document, const OperationForm* form);

    /// True if the form opens vessel ends.
    [[nodiscard]] bool has_form() const { return has_form_; }

    /// True if it opens all of them, so that there is a table; false if it opens one, at its `tip`.
    [[nodiscard]] bool lists_ends() const { return has_form_ && !has_tip_; }

    [[nodiscard]] const std::vector<EndRow>& rows() const { return rows_; }

    /// Null: there is no end of this number.
    [[nodiscard]] const EndRow* row(int number) const;

    /// True while the ends are not known, or not as the form says now.
    [[nodiscard]] bool pending() const { return reading_ || task_.pending(); }

    /// Why the ends cannot be found, or not be opened as the form says; empty: no problem.
    [[nodiscard]] const std::string& problem() const { return problem_; }

    /// False while texts that fix the plan are not those of the wishes.
    [[nodiscard]] bool can_apply() const {
        return !fixes_plan_ || (!pending() && problem_.empty());
    }

    /// What the operation runs on; null: not known, or not needed.
    [[nodiscard]] const Surface* surface() const;

    // --- wishes, as texts for the form

    [[nodiscard]] std::vector<FieldText> wish_texts(const OperationForm& form, int number,
                                                    EndWish wish) const;

    /// Makes an end one more inlet.
    [[nodiscard]] std::vector<FieldText> inlet_texts(const OperationForm& form, int number) const;

    /// \param cut none: as planned
    [[nodiscard]] std::vector<FieldText> move_texts(const OperationForm& form, int number,
                                                    const std::optional<Plane>& cut) const;

    /// Takes back all wishes.
    [[nodiscard]] std::vector<FieldText> plain_texts() const;

    /// Texts that follow from a plan that has arrived; empty: the form has them.
    [[nodiscard]] std::vector<FieldText> due_texts(const OperationForm& form) const;

    // --- the chosen end

    void select(std::optional<int> number) { selected_ = number; }

    /// The end that a point means, if there is one [mm].
    void select_near(const Vec3& point);

    [[nodiscard]] const std::optional<int>& selected() const { return selected_; }

    /// The mouse is over the row or the marker of an end: both are lit up in the next frame.
    void point_at(int number) { next_pointed_ = number; }

    [[nodiscard]] const std::optional<int>& pointed() const { return pointed_; }

    // --- dragging the cut of the chosen end

    /// A form of the chosen end's cut alone, for cut_shape() and cut_texts(); none: it has none.
    [[nodiscard]] std::optional<OperationForm> cut_form() const;

    /// What cut_texts() says of cut_form(), as texts of the whole form.
    /// \param cut that was dragged, with a branch
    [[nodiscard]] std::vector<FieldText> dragged_texts(const OperationForm& form,
                                                       const OperationForm& cut_form,
                                                       const Cut& cut,
                                                       const std::vector<FieldText>& texts) const;

private:
    struct Answer {
        Arguments question;
        PlannedEnds planned;
    };

    void forget();
    void take();
    void take_input(const Document& document);
    void ask(const OperationForm& form);
    void await_model();
    void renew(const OperationForm& form);

    std::optional<Scene> input_;  ///< none: it is not known
    std::string input_problem_;
    bool reading_ = false;
    Task<Answer> task_;
    std::optional<Arguments> asked_;  ///< planning_arguments() of the form
    Surface surface_;                 ///< of the question
    const Operation* operation_ = nullptr;
    std::optional<PlannedEnds> planned_;
    Arguments plain_;  ///< plain_arguments() of planned_
    std::vector<EndRow> rows_;
    std::string problem_;
    std::optional<int> selected_, pointed_, next_pointed_;
    std::pair<std::optional<EditId>, int> seen_ = {};  ///< the form of the rows
    bool has_form_ = false, has_tip_ = false, fixes_plan_ = false, new_plan_ = false;
};

}  // namespace vesselbench
