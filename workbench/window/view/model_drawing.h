#pragma once

#include <cstdint>
#include <functional>
#include <future>
#include <memory>
#include <optional>

#include "gpu/render/drawn_surface.h"
#include "gpu/render/layers.h"
#include "workbench/case/scene.h"
#include "workbench/window/model/deviation_map.h"

namespace vesselbench {

/// The model's layer, for picking.
inline constexpr std::uint32_t kModelLayer = 1;

/// How the model is shown.
struct ViewLook {
    bool edges = false;
    bool flat = false;
    bool transparent = false;
    bool deviation = false;  ///< coloured by the distance from the source

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

    /// Values for colours; null: none.
    void set_deviation(std::shared_ptr<const DeviationMap> deviation);

    /// Uploads what is ready. \return true if the drawing has changed
    bool update();

    [[nodiscard]] bool pending() const { return next_.valid(); }

    /// The surface that is drawn; null: none.
    [[nodiscard]] const Surface* surface() const;

    [[nodiscard]] Layers layers(const ViewLook& look, double edge_width) const;

    /// True if the colours show the deviation.
    [[nodiscard]] bool shows_deviation(const ViewLook& look) const;

    [[nodiscard]] const DeviationMap* deviation() const { return deviation_.get(); }

private:
    void begin();
    [[nodiscard]] bool upload_values();

    std::function<void()> wake_;
    std::shared_ptr<DrawnSurface> drawn_;
    std::future<DrawingArrays> next_;
    std::optional<Surface> wanted_;  ///< to be laid out after `next_`
    std::shared_ptr<const DeviationMap> deviation_, uploaded_;
};

}  // namespace vesselbench
