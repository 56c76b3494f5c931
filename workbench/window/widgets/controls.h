#pragma once

#include <string>
#include <vector>

#include "workbench/window/widgets/ui.h"

namespace vesselbench {

// The window's own controls, drawn at ImGui's cursor. `name` is what Ui registers; labels may be
// equal. Widths are in pixels; 0: as wide as the label needs, -1: all that is left.

struct ButtonLook {
    const char* icon = "";
    bool primary = false;  ///< filled with the accent
    bool quiet = false;    ///< no frame until the mouse is over it
    bool enabled = true;
    float width = 0.0F;
    std::string help = {};  ///< shown on hover
};

/// \return true when it is clicked
bool button(Ui& ui, const std::string& name, const std::string& label, const ButtonLook& look = {});

/// A square button with an icon alone.
bool icon_button(Ui& ui, const std::string& name, const char* icon, const std::string& help,
                 bool enabled = true, bool pressed = false);

struct FieldLook {
    std::string hint = {};  ///< shown while it is empty
    bool wrong = false;     ///< with a red frame
    float width = -1.0F;
    bool focus = false;  ///< takes the keyboard now
};

/// A line of text to be edited. \return true when the text has changed
bool text_field(Ui& ui, const std::string& name, std::string& text, const FieldLook& look = {});

/// A choice among texts. \return true when another one was chosen
bool choice(Ui& ui, const std::string& name, const std::vector<std::string>& options,
            std::string& chosen, float width = -1.0F);

/// \return true when it was switched
bool checkbox(Ui& ui, const std::string& name, const std::string& label, bool& on);

void text(const Ui& ui, const std::string& words, Paint colour);
void small_text(const Ui& ui, const std::string& words, Paint colour);
void wrapped(const Ui& ui, const std::string& words, Paint colour, bool small = true);
void heading(const Ui& ui, const std::string& words);
/// A small heading of a group, in muted capitals.
void group_heading(const Ui& ui, const std::string& words);

/// A line of text that is cut to a width, with the whole text on hover.
void clipped_text(const Ui& ui, const std::string& words, Paint colour, float width);

/// A help text for ImGui's last item, shown while the mouse is over it.
void help_on_hover(const Ui& ui, const std::string& words);

/// A help text beside the mouse.
void tooltip(const Ui& ui, const std::string& words);

/// Vertical space of so many times 8 pixels.
void space(const Ui& ui, float count);

void separator(const Ui& ui);

/// A text in lines of at most this width, broken at blanks. ImGui would break at points and commas
/// as well: within numbers. A word that is wider is left whole.
[[nodiscard]] std::string broken(const std::string& words, float width);

/// A text that fits a width, ended by an ellipsis if needed.
[[nodiscard]] std::string fitted(const std::string& words, float width);

/// Takes the keyboard from a text field, which keeps what was typed.
void take_keyboard();

}  // namespace vesselbench
