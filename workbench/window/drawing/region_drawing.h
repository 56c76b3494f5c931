#pragma once

#include <memory>
#include <vector>

#include "gpu/render/layers.h"
#include "workbench/window/drawing/region_lines.h"

namespace vesselbench {

/// The lines of a form in the 3D view.
class RegionDrawing {
public:
    /// Needs the window's OpenGL context if the lines have changed.
    void show(std::vector<RegionLine> lines);

    /// Counts changes.
    [[nodiscard]] int version() const { return version_; }

    /// \param width [pixels] \param pull of lines that lie on the surface, towards the eye [mm]
    void add_to(Layers& layers, double width, double pull) const;

private:
    std::vector<RegionLine> shown_;
    std::shared_ptr<const DrawnLines> faint_, lines_, front_;
    int version_ = 0;
};

}  // namespace vesselbench
