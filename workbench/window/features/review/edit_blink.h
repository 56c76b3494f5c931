#pragma once

#include <optional>
#include <string>

#include "workbench/window/core/core.h"

namespace vesselbench {

/// Shows the models before and after an edit in turn, by a comparison. Later edits are in neither.
class EditBlink {
public:
    explicit EditBlink(Core& core) : core_(core) {}

    /// Why it cannot be done for an edit now; empty: it can.
    [[nodiscard]] std::string why_not(EditId edit) const;

    /// The edit that blinks; none: none does.
    [[nodiscard]] const std::optional<EditId>& edit() const { return edit_; }

    /// Ignored if why_not() says why.
    void start(EditId edit);

    /// Ends it, and shows the newest model; ignored if nothing blinks.
    void stop();

    /// Once a frame: ends with the comparison, and with any change of the edits.
    void update();

private:
    [[nodiscard]] bool compares() const;

    Core& core_;
    std::optional<EditId> edit_;
    int changes_ = 0;  ///< the document's snapshot changes at the start
};

}  // namespace vesselbench
