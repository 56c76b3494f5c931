#pragma once

#include <memory>
#include <vector>

#include "gpu/render/layers.h"
#include "workbench/window/model/typed_region.h"

namespace vesselbench {

/// The typed region of a form as lines of the 3D view.
class RegionDrawing {
public:
    /// Needs the window's OpenGL context if the lines have changed.
    void show(std::vector<RegionLine> lines);

    /// Counts changes.
    [[nodiscard]] int version() const { return version_; }

    void add_to(Layers& layers, double width) const;

private:
    std::vector<RegionLine> shown_;
    std::shared_ptr<const DrawnLines> lines_;
    int version_ = 0;
};

}  // namespace vesselbench
