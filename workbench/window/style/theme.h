#pragma once

#include <cstdint>

namespace vesselbench {

/// A colour as the window's drawing takes it: 0xAABBGGRR.
using Paint = std::uint32_t;

[[nodiscard]] constexpr Paint paint(std::uint32_t rrggbb, std::uint32_t alpha = 255) {
    return (alpha << 24) | ((rrggbb & 0xFF) << 16) | (rrggbb & 0xFF00) | (rrggbb >> 16);
}

/// The same colour, more transparent. \param alpha [0, 1]
[[nodiscard]] constexpr Paint faded(Paint colour, double alpha) {
    const auto opacity = static_cast<Paint>(static_cast<double>(colour >> 24) * alpha);
    return (colour & 0x00FFFFFF) | (opacity << 24);
}

/// The colours of the window: greys, one accent, and three that have a meaning.
struct Theme {
    bool dark = true;
    Paint window = 0;  ///< behind the panels
    Paint panel = 0;   ///< panels and bars
    Paint raised = 0;  ///< buttons, cards
    Paint hover = 0;   ///< of raised things and rows
    Paint field = 0;   ///< text fields
    Paint border = 0;
    Paint text = 0;
    Paint muted = 0;  ///< secondary texts
    Paint accent = 0;
    Paint accent_hover = 0;
    Paint on_accent = 0;  ///< texts on the accent
    Paint selected = 0;   ///< behind chosen rows
    Paint good = 0, warning = 0, danger = 0;
    Paint view_above = 0, view_below = 0;  ///< behind the model
};

[[nodiscard]] Theme dark_theme();
[[nodiscard]] Theme light_theme();

/// Sets colours, spacing and roundings of the current ImGui context; sizes follow from the font.
/// \param em size of the text [pixels]
void apply_theme(const Theme& theme, float em);

}  // namespace vesselbench
