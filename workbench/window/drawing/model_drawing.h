#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geometry/kernel/deviation_map.h"
#include "gpu/render/drawn_surface.h"
#include "gpu/render/layers.h"
#include "workbench/case/scene.h"
#include "workbench/colours/colourings.h"
#include "workbench/session/task.h"
#include "workbench/window/case/live_stroke.h"

namespace vesselbench {

/// The model's layer, for picking.
inline constexpr std::uint32_t kModelLayer = 1;

/// How the model is shown.
struct ViewLook {
    bool edges = false;
    bool flat = false;
    bool transparent = false;
    bool deviation = false;  ///< coloured by the distance from the source
    bool coarse = false;     ///< of fewer triangles, unless their edges are seen

    bool operator==(const ViewLook&) const = default;
};

/// The shown surface on the device. It is laid out for drawing on another thread; until that is
/// done, the previous one stays.
class ModelDrawing {
public:
    /// \param wake called by the other thread when update() has something to do
    explicit ModelDrawing(std::function<void()> wake);

    /// Begins to show a scene's surface, or nothing.
    void show(const Scene* scene);

    /// Begins to show another shape of the shown surface. Unlike show(), it leaves a shape that is
    /// being laid out to be shown, too: those that come faster do not keep each other from the
    /// view.
    void reshape(const Surface& surface);

    /// Follows a dab: what it changed is uploaded at once if the drawing shows the surface before
    /// it, else all is laid out again.
    void move(const SceneMove& move);

    /// Colours show a vertex attribute from 0 to 1, absent ones as 0; empty: they do not.
    void set_painted(const std::string& attribute) { painted_ = attribute; }

    /// Values for colours; null: none.
    void set_deviation(std::shared_ptr<const DeviationMap> deviation);

    /// Values for colours instead of the deviation; null, or not #V: none.
    void set_colouring(std::shared_ptr<const ColourValues> colours) {
        colours_ = std::move(colours);
    }

    /// Typed ends of the colours' range; none: that of the values.
    void set_range(std::optional<ValueRange> range) { typed_range_ = range; }

    /// Uploads what is ready. \return true if the drawing has changed
    bool update();

    /// True if the last update() began to show another surface, rather than moves or colours.
    [[nodiscard]] bool is_new() const { return new_; }

    /// Why the scene's surface cannot be drawn, as on a device without memory for it; empty: it
    /// can. Otherwise surface() is null.
    [[nodiscard]] const std::string& problem() const { return problem_; }

    [[nodiscard]] bool pending() const { return task_.pending(); }

    /// The surface that is drawn, with the dabs so far; null: none.
    [[nodiscard]] const Surface* surface() const;

    [[nodiscard]] Layers layers(const ViewLook& look, double edge_width) const;

    /// True if the colours show a painted attribute.
    [[nodiscard]] bool shows_weight() const;

    /// True if the colours show the deviation.
    [[nodiscard]] bool shows_deviation(const ViewLook& look) const;

    [[nodiscard]] const DeviationMap* deviation() const { return deviation_.get(); }

    /// True if the colours show the values of set_colouring.
    [[nodiscard]] bool shows_colouring() const;

    /// The values at the ends of the colours.
    [[nodiscard]] ValueRange colour_range() const;

    using Values = std::shared_ptr<const std::vector<double>>;

    /// Those that the colours show, #V; null: none.
    [[nodiscard]] const Values& values() const { return uploaded_; }

private:
    void release();
    void lay_out(const Surface& surface);
    template <class Work>
    void upload(const Work& work);
    void fail(const std::string& problem);
    void take(DrawingArrays arrays);
    void follow(const SceneMove& move);
    void follow_late();
    [[nodiscard]] Values painted_values() const;
    [[nodiscard]] Values wanted_values() const;
    [[nodiscard]] bool upload_values();
    void colour(SurfaceLayer& layer, const ViewLook& look) const;

    std::shared_ptr<DrawnSurface> drawn_;
    Surface shown_;  ///< as drawn, with all moves
    Task<DrawingArrays> task_;
    std::vector<SceneMove> late_;  ///< moves since a layout was asked for
    bool moved_ = false;           ///< since the last update
    bool new_ = false;
    std::string problem_;
    std::string painted_;
    std::shared_ptr<const DeviationMap> deviation_;
    std::shared_ptr<const ColourValues> colours_;
    std::optional<ValueRange> typed_range_;
    Values uploaded_;
};

}  // namespace vesselbench
