#pragma once

#include <map>
#include <string>

#include "workbench/window/style/fonts.h"
#include "workbench/window/style/theme.h"

namespace vesselbench {

/// A rectangle of the window [pixels], from its upper left corner.
struct ScreenRect {
    float x = 0, y = 0, width = 0, height = 0;

    [[nodiscard]] float middle_x() const { return x + width / 2; }

    [[nodiscard]] float middle_y() const { return y + height / 2; }

    [[nodiscard]] bool overlaps(const ScreenRect& other) const {
        return x < other.x + other.width && other.x < x + width && y < other.y + other.height &&
               other.y < y + height;
    }

    bool operator==(const ScreenRect&) const = default;
};

/// Something that can be clicked, as of the last frame.
struct UiItem {
    ScreenRect rect;  ///< its visible part
    bool enabled = true;
    std::string label = {};  ///< what it says; empty: an icon, or it says nothing lasting
};

/// What every panel needs to draw: colours, fonts, sizes; and the register of interactive items by
/// lasting names ("operation.apply"), by which tests and scripts click.
class Ui {
public:
    Theme theme;
    Fonts fonts;
    float em = 15.0F;  ///< size of the text [pixels]; all sizes follow from it

    /// So many times 8 pixels at the usual scale.
    [[nodiscard]] float grid(float count) const { return count * em * (8.0F / 15.0F); }

    void begin_frame() { items_.clear(); }

    /// Registers ImGui's last item, unless nothing of it is visible.
    void item(const std::string& name, bool enabled = true);

    /// Registers a rectangle.
    void item(const std::string& name, const ScreenRect& rect, bool enabled = true);

    /// What an item says, if it is registered.
    void say(const std::string& name, const std::string& label);

    [[nodiscard]] const std::map<std::string, UiItem>& items() const { return items_; }

private:
    std::map<std::string, UiItem> items_;
};

}  // namespace vesselbench
