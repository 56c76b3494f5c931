#pragma once

#include <bitset>
#include <span>
#include <string>
#include <vector>

namespace vesselbench {

/// What keys ask for.
enum class KeyCommand {
    None,
    // the window
    Help,
    Cancel,
    Accept,  ///< a dialog
    Undo,
    Redo,
    Open,
    SaveCopy,
    Export,
    Apply,
    Preview,
    LargerText,
    SmallerText,
    UsualText,
    // the camera
    FrameAll,
    Anterior,
    Posterior,
    Left,
    Right,
    Superior,
    Inferior,
    Perspective,
    // modes of the view
    ViewOptions,
    ClipPlane,
    Distance,
    Diameter,
    Source,
    Centerlines,
    OpeningNames,
    EditLocations,
    Picture,
    NextWorst,
    PreviousWorst,
    NextFinding,
    PreviousFinding,
    Gallery,
    Spots,
    SwitchComparison,
    // the flight through a vessel
    Flight,
    FlyOrStop,
    FlyForward,
    FlyBack,
    LookAhead,
    // the brush
    SmallerBrush,
    LargerBrush,
    WeakerBrush,
    StrongerBrush,
    SizeBrush,
    // slices
    SliceRow,
    SlicePlanes,
    FrameSlice,
    // the step Review
    NextEdit,
    PreviousEdit,
    AcceptEdit,
    RejectEdit,
    UnsureEdit,
    CommentEdit,
    PlacePin,
    PlaceDistance,
    BlinkEdit,
    Count
};

enum class KeyGroup { Editing, View, Modes, Brushes, Slices, Review };

enum class Modifiers { None, Control, Shift, ControlShift, Any };

/// Whether the key acts while the camera is in a vessel.
enum class KeyUse { Anywhere, Outside, Flight };

enum class KeyPress { Once, Repeats, Held };

/// Where a key acts besides the window itself.
enum class KeyReach { Window, TextFields, Everywhere };

struct KeyBinding {
    KeyCommand command = KeyCommand::None;
    int key = 0;  ///< of keys.h
    Modifiers modifiers = Modifiers::None;
    KeyUse use = KeyUse::Anywhere;
    KeyPress press = KeyPress::Once;
};

/// A line of the help, with the keys that it explains.
struct KeyRow {
    KeyGroup group = KeyGroup::Editing;
    const char* meaning = "";
    const char* mouse = "";                 ///< what the mouse does for it; empty: nothing
    KeyReach reach = KeyReach::Window;      ///< everywhere: also while a dialog is open
    std::vector<KeyBinding> bindings = {};  ///< empty: the mouse only
};

/// All keys of the window, in the order of the help.
[[nodiscard]] std::span<const KeyRow> key_table();

/// "Ctrl+Z", "Up, Down, wheel"
[[nodiscard]] std::string keys_text(const KeyRow& row);

/// The key of a command: "Shift+I"; empty: it has none.
[[nodiscard]] std::string keys_of(KeyCommand command);

/// What the keys of this frame ask for.
class KeyCommands {
public:
    void add(KeyCommand command) { commands_.set(static_cast<std::size_t>(command)); }

    [[nodiscard]] bool has(KeyCommand command) const {
        return commands_.test(static_cast<std::size_t>(command));
    }

private:
    std::bitset<static_cast<std::size_t>(KeyCommand::Count)> commands_;
};

}  // namespace vesselbench
