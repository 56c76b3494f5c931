#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "gpu/render/renderer.h"

namespace vesselbench {

/// What is under the cursor. Near it, points and lines win over surfaces and slices.
struct Picked {
    std::uint32_t layer = 0;    ///< id of the layer; 0: nothing is there
    std::uint32_t element = 0;  ///< triangle, segment or mark
    Vec3 point = Vec3::Zero();  ///< the place on it [mm]
};

/// Finds what is under the cursor by drawing ids of the few pixels around it into a buffer, which
/// is read when it is complete: neither call waits for the device. The renderer must outlive it.
class Picker {
public:
    explicit Picker(Renderer& renderer);
    ~Picker();
    Picker(Picker&&) noexcept;
    Picker& operator=(Picker&&) noexcept;

    /// Starts a search; an earlier one without a result is forgotten. Draws: the bound framebuffer
    /// is kept.
    /// \param x, y pixel of the view's framebuffer, from its lower left corner
    /// \param radius further pixels to each side that are searched, 0 to 4
    void request(const SceneView& view, const Layers& layers, int x, int y, int radius = 2);

    /// Drops the request.
    void forget();

    /// True from a request to its result.
    [[nodiscard]] bool pending() const;

    /// The result of the request, once, when the device has it; nothing is there if the device was
    /// lost.
    [[nodiscard]] std::optional<Picked> result();

    /// request() and its result, after waiting for it.
    [[nodiscard]] Picked pick(const SceneView& view, const Layers& layers, int x, int y,
                              int radius = 2);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace vesselbench
