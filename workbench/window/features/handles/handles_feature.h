#pragma once

#include <optional>

#include "workbench/window/core/core.h"
#include "workbench/window/features/handles/crop_handles.h"

namespace vesselbench {

/// What handles in the view and in slices need to know.
class HandlesFeature : public Feature {
public:
    explicit HandlesFeature(Core& core) : core_(core) {}

    /// The box that a form which crops offers; none: it offers none [mm].
    [[nodiscard]] const std::optional<Bounds>& offered_box() const { return offered_.bounds(); }

    [[nodiscard]] bool update() override;

private:
    Core& core_;
    OfferedBox offered_;
};

}  // namespace vesselbench
