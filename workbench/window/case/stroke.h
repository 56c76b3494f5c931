#pragma once

#include <optional>
#include <vector>

#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// Size and strength of a brush.
struct BrushTip {
    double radius = 0.0;    ///< along the surface [mm]; 0: not chosen yet
    double strength = 0.5;  ///< -1 ... 1, negative: inverted [-]

    bool operator==(const BrushTip&) const = default;
};

enum class BrushKey { Smaller, Larger, Weaker, Stronger };

/// The tip after a key press: the radius changes by a fifth, the strength by 0.05 but keeps its
/// sign. Rounded to three digits, so that it reads well as a text.
[[nodiscard]] BrushTip after_key(const BrushTip& tip, BrushKey key);

/// The tip with its radius changed by a factor, rounded as above.
[[nodiscard]] BrushTip scaled(const BrushTip& tip, double factor);

/// The tip with another strength, of the same sign, limited to 0.05 ... 1 and rounded to 0.01.
[[nodiscard]] BrushTip with_strength(const BrushTip& tip, double strength);

/// A place on the surface that a brush touches.
struct StrokePlace {
    Vec3 point = Vec3::Zero();    ///< [mm]
    Vec3 normal = Vec3::UnitZ();  ///< outward, unit
    bool between = false;         ///< on the straight line between two places: near the surface
};

/// A drag of the mouse with a brush, from pressing the button to releasing it: decides whether it
/// paints or turns the view, and where the dabs are. What is under the cursor is found in the
/// background, so that it arrives later than the mouse's events.
class Stroke {
public:
    enum class State {
        Idle,
        Deciding,  ///< the button is down; it is not known yet on what
        Painting,
        Turning,  ///< begun beside the surface
        Dropped   ///< cancelled; waits for the button
    };

    [[nodiscard]] State state() const { return state_; }

    /// The button goes down.
    /// \param radius of the brush [mm], > 0
    void begin(double radius);

    /// What is under the cursor now; none: the background, which interrupts the line of dabs.
    /// \return places of further dabs, a quarter of the radius apart
    [[nodiscard]] std::vector<StrokePlace> extend(const std::optional<StrokePlace>& place);

    /// The button is up, and its last place was given.
    void end() { state_ = State::Idle; }

    /// Paints nothing more until the button goes down again.
    void cancel();

private:
    [[nodiscard]] std::vector<StrokePlace> dabs_to(const StrokePlace& place);

    State state_ = State::Idle;
    double spacing_ = 1.0;  ///< [mm]
    double next_ = 0.0;     ///< length of path from `last_` to the next dab [mm]
    std::optional<StrokePlace> last_;
};

}  // namespace vesselbench
