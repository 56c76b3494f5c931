#pragma once

#include <optional>
#include <string>
#include <utility>

#include "meshing/products/cfd_parameters.h"
#include "workbench/session/task.h"
#include "workbench/window/case/export_state.h"
#include "workbench/window/core/panel_context.h"
#include "workbench/window/form/operation_form.h"

namespace vesselbench {

/// What belongs to an export beside its file: the state of the model's review, which may ask or
/// refuse, and the flow of a solver's case.
class ExportChoices {
public:
    /// Reads the shown variant's state on the case's thread. \pre a case is open
    void begin(PanelContext& context);

    /// Collects what was read; once a frame.
    void poll();

    [[nodiscard]] bool pending() const { return reading_.pending(); }

    /// Why nothing can be exported; empty: it can.
    [[nodiscard]] std::string refusal() const;

    /// What the user has to confirm: "The model's review is rejected: 2 of 5 edits accepted".
    /// Empty: nothing.
    [[nodiscard]] std::string doubt() const;

    /// One line: the state of the review.
    void draw_review(PanelContext& context) const;

    /// The flow's fields, and what they mean in this vessel.
    void draw_flow(PanelContext& context);

    /// The flow as its fields have it; none: they are not known. \pre refusal() is empty
    [[nodiscard]] std::optional<FlowSettings> flow() const;

private:
    void draw_meaning(PanelContext& context);
    [[nodiscard]] std::string meaning(const Surface& surface) const;

    Task<ExportState> reading_;
    std::optional<ExportState> state_;
    std::string problem_;                ///< why it could not be read
    std::optional<OperationForm> form_;  ///< of the flow
    /// What the flow means in the vessel, and of which changes of form and scene this is said.
    std::string meaning_;
    std::pair<int, int> meant_ = {-1, -1};
};

}  // namespace vesselbench
