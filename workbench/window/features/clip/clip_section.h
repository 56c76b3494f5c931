#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "gpu/render/drawn_surface.h"
#include "gpu/render/layers.h"
#include "meshing/tetrahedra/volume_section.h"
#include "workbench/colours/colourings.h"
#include "workbench/session/task.h"
#include "workbench/window/core/panel_context.h"
#include "workbench/window/drawing/view_choice.h"
#include "workbench/window/drawing/view_strips.h"

namespace vesselbench {

/// The clip plane of the view: where it is, what fills its section, and the strip that moves it.
/// While colours show the tetrahedra's quality, the section is through the volume mesh.
class ClipSection {
public:
    /// \param wake as Viewport's
    explicit ClipSection(std::function<void()> wake);

    /// Once a frame, before anything is drawn; needs the window's OpenGL context.
    /// \param surface that is drawn; null: none
    void update(const PanelContext& context, const Surface* surface, const ViewCamera& camera);

    /// Forgets the model: the case is closed.
    void forget();

    [[nodiscard]] const std::optional<ClipPlane>& plane() const { return plane_; }

    /// Counts changes of the plane, and of what is drawn in it.
    [[nodiscard]] int version() const { return version_; }

    [[nodiscard]] bool pending() const { return search_.pending(); }

    /// Fills the section of the model's layer, or adds that of the volume mesh.
    void add_to(Layers& layers, double line_width) const;

    /// True if the colours of tetrahedra are shown.
    [[nodiscard]] bool shows_tetrahedra() const { return cells_ != nullptr; }

    /// The values at the ends of their colours.
    [[nodiscard]] const ValueRange& range() const { return range_; }

    void draw_strip(PanelContext& context, ViewStrips& strips) const;

private:
    struct Prepared {
        DrawingArrays arrays;
        std::vector<double> values;
        std::vector<Polyline> outlines;
    };

    /// What a section of the volume mesh was asked for.
    struct Asked {
        std::shared_ptr<const ColourValues> colours;
        Vec3 point = Vec3::Zero(), normal = Vec3::Zero();

        bool operator==(const Asked&) const = default;
    };

    [[nodiscard]] static Prepared prepared(const VolumeMesh& mesh, const ColourValues& colours,
                                           const Plane& plane, const Progress& progress);
    void measure(const PanelContext& context, const Surface& surface);
    void choose_side(ClipChoice& choice, const ViewCamera& camera);
    void update_cells(const PanelContext& context);
    void take_cells();
    [[nodiscard]] std::string place_text(const ClipChoice& choice) const;

    Task<Prepared> search_;
    std::optional<ClipPlane> plane_;
    std::shared_ptr<const Positions> measured_;  ///< whose box it is
    Bounds box_;
    std::optional<ClipAxis> axis_;  ///< of the plane whose side was chosen
    Asked asked_;
    std::shared_ptr<DrawnSurface> cells_;
    std::shared_ptr<const DrawnLines> outlines_;
    ValueRange range_;
    int version_ = 0;
};

}  // namespace vesselbench
