#pragma once

#include "workbench/window/core/core.h"

namespace vesselbench {

/// Moving through the states.
class HistoryFeature : public Feature {
public:
    explicit HistoryFeature(Core& core) : core_(core) {}

    void keys(PanelContext& context) override;

private:
    Core& core_;
};

}  // namespace vesselbench
