#include "workbench/window/keys/key_table.h"

#include <algorithm>

#include "workbench/window/keys/keys.h"

namespace vesselbench {

namespace {

using enum KeyCommand;
using enum KeyPress;

constexpr auto kCtrl = Modifiers::Control;
constexpr auto kShift = Modifiers::Shift;
constexpr auto kCtrlShift = Modifiers::ControlShift;
constexpr auto kPlain = Modifiers::None;
constexpr auto kAnyModifiers = Modifiers::Any;
constexpr auto kOutside = KeyUse::Outside;
constexpr auto kInFlight = KeyUse::Flight;

constexpr int digit(int number) {
    return keys::k0 + number;
}

constexpr int pad(int number) {
    return keys::kPad0 + number;
}

std::vector<KeyRow> editing_rows() {
    const auto letter = keys::letter;
    const KeyGroup group = KeyGroup::Editing;
    const KeyReach typing = KeyReach::TextFields, everywhere = KeyReach::Everywhere;
    return {{group, "undo", "", KeyReach::Window, {{Undo, letter('Z'), kCtrl}}},
            {group,
             "redo",
             "",
             KeyReach::Window,
             {{Redo, letter('Z'), kCtrlShift}, {Redo, letter('Y'), kCtrl}}},
            {group, "open a file", "", typing, {{Open, letter('O'), kCtrl}}},
            {group, "save as", "", typing, {{SaveCopy, letter('S'), kCtrl}}},
            {group, "export the model", "", typing, {{Export, letter('E'), kCtrl}}},
            {group,
             "apply the operation",
             "",
             typing,
             {{Apply, keys::kEnter, kCtrl}, {Apply, keys::kPadEnter, kCtrl}}},
            {group, "preview the operation", "", typing, {{Preview, letter('P'), kCtrl}}},
            {group,
             "enter a value, accept a file",
             "",
             everywhere,
             {{Accept, keys::kEnter}, {Accept, keys::kPadEnter}}},
            {group,
             "restore a field, cancel, or close",
             "",
             everywhere,
             {{Cancel, keys::kEscape, kAnyModifiers}}},
            {group,
             "text size",
             "",
             everywhere,
             {{LargerText, keys::kEqual, kCtrl},
              {LargerText, keys::kEqual, kCtrlShift},
              {LargerText, keys::kPadAdd, kCtrl},
              {SmallerText, keys::kMinus, kCtrl},
              {SmallerText, keys::kPadSubtract, kCtrl},
              {UsualText, digit(0), kCtrl},
              {UsualText, pad(0), kCtrl}}},
            {group, "this help", "", everywhere, {{Help, keys::kF1, kAnyModifiers}}}};
}

std::vector<KeyRow> view_rows() {
    const KeyGroup group = KeyGroup::View;
    const KeyReach window = KeyReach::Window;
    return {{group, "rotate", "Left drag"},
            {group, "pan", "Middle or Shift+left drag"},
            {group, "zoom to the cursor", "Wheel"},
            {group, "set the centre; beside the model, enlarge the view", "Double click"},
            {group, "in Smooth's form: drive two fields", "Right drag"},
            {group, "in Smooth's form: drive a third", "Shift+right drag"},
            {group,
             "from front, side, above",
             "",
             window,
             {{Anterior, digit(1), kPlain, kOutside},
              {Anterior, pad(1), kPlain, kOutside},
              {Left, digit(3), kPlain, kOutside},
              {Left, pad(3), kPlain, kOutside},
              {Superior, digit(7), kPlain, kOutside},
              {Superior, pad(7), kPlain, kOutside}}},
            {group,
             "from the opposite side",
             "",
             window,
             {{Posterior, digit(1), kCtrl, kOutside},
              {Posterior, pad(1), kCtrl, kOutside},
              {Right, digit(3), kCtrl, kOutside},
              {Right, pad(3), kCtrl, kOutside},
              {Inferior, digit(7), kCtrl, kOutside},
              {Inferior, pad(7), kCtrl, kOutside}}},
            {group, "show everything", "", window, {{FrameAll, keys::kHome, kPlain, kOutside}}},
            {group,
             "perspective or parallel",
             "",
             window,
             {{Perspective, digit(5), kPlain, kOutside}, {Perspective, pad(5), kPlain, kOutside}}}};
}

std::vector<KeyRow> mode_rows() {
    const auto letter = keys::letter;
    const KeyGroup group = KeyGroup::Modes;
    const KeyReach window = KeyReach::Window;
    return {{group, "view options", "", window, {{ViewOptions, letter('V')}}},
            {group, "clip plane; Ctrl+wheel moves it", "", window, {{ClipPlane, letter('C')}}},
            {group, "enter or leave the vessel", "", window, {{Flight, letter('E')}}},
            {group,
             "in the vessel: fly or stop",
             "",
             window,
             {{FlyOrStop, keys::kSpace, kPlain, kInFlight}}},
            {group,
             "in the vessel: forward, back",
             "wheel",
             window,
             {{FlyForward, keys::kUp, kPlain, kInFlight, Repeats},
              {FlyBack, keys::kDown, kPlain, kInFlight, Repeats}}},
            {group,
             "in the vessel: look ahead",
             "",
             window,
             {{LookAhead, keys::kHome, kPlain, kInFlight}}},
            {group,
             "measure a distance, a diameter",
             "",
             window,
             {{Distance, letter('M')}, {Diameter, letter('D')}}},
            {group,
             "source as wireframe, centerlines",
             "",
             window,
             {{Source, letter('W')}, {Centerlines, letter('L')}}},
            {group,
             "opening names, edit locations",
             "",
             window,
             {{OpeningNames, letter('N')}, {EditLocations, letter('A')}}},
            {group,
             "next, previous worst place of the colours",
             "",
             window,
             {{NextWorst, letter('X')}, {PreviousWorst, letter('X'), kShift}}},
            {group,
             "next, previous finding: what looks wrong",
             "",
             window,
             {{NextFinding, letter('T')}, {PreviousFinding, letter('T'), kShift}}},
            {group,
             "in Smooth's form: suggestions side by side, spots",
             "",
             window,
             {{Gallery, letter('G')}, {Spots, letter('G'), kShift}}},
            {group,
             "switch a blinking comparison",
             "",
             window,
             {{SwitchComparison, keys::kSpace, kPlain, kOutside}}},
            {group, "save a picture of the view", "", window, {{Picture, keys::kF12}}}};
}

std::vector<KeyRow> brush_rows() {
    const auto anywhere = KeyUse::Anywhere;
    const KeyGroup group = KeyGroup::Brushes;
    const KeyReach window = KeyReach::Window;
    return {{group, "brush on the surface", "Left drag"},
            {group,
             "radius, by key or mouse",
             "",
             window,
             {{SmallerBrush, keys::kLeftBracket, kPlain, anywhere, Repeats},
              {LargerBrush, keys::kRightBracket, kPlain, anywhere, Repeats},
              {SizeBrush, keys::letter('F'), kPlain, anywhere, Held}}},
            {group,
             "strength, by key or mouse",
             "",
             window,
             {{WeakerBrush, keys::kLeftBracket, kShift, anywhere, Repeats},
              {StrongerBrush, keys::kRightBracket, kShift, anywhere, Repeats},
              {SizeBrush, keys::letter('F'), kShift, anywhere, Held}}},
            {group, "smooth, whatever the brush", "Shift+left drag"},
            {group, "invert", "Ctrl+left drag"}};
}

std::vector<KeyRow> slice_rows() {
    const KeyGroup group = KeyGroup::Slices;
    const KeyReach window = KeyReach::Window;
    return {{group, "slices of the image", "", window, {{SliceRow, keys::letter('I')}}},
            {group,
             "its planes in the 3D view",
             "",
             window,
             {{SlicePlanes, keys::letter('I'), kShift}}},
            {group, "move the cross", "Left drag"},
            {group, "window and level", "Right drag"},
            {group, "next slice; with Ctrl, zoom", "Wheel"},
            {group, "enlarge a slice", "Double click"},
            {group, "show all of a slice", "", window, {{FrameSlice, keys::kHome}}}};
}

/// The letters of the review page; with Shift those that the view has taken.
std::vector<KeyRow> review_rows() {
    const auto letter = keys::letter;
    const KeyGroup group = KeyGroup::Review;
    const KeyReach window = KeyReach::Window;
    return {
        {group,
         "next, previous edit",
         "",
         window,
         {{NextEdit, letter('J')}, {PreviousEdit, letter('K')}}},
        {group,
         "accept, reject, unsure",
         "",
         window,
         {{AcceptEdit, letter('A'), kShift}, {RejectEdit, letter('R')}, {UnsureEdit, letter('U')}}},
        {group, "comment", "", window, {{CommentEdit, letter('C'), kShift}}},
        {group,
         "place pins, distances",
         "",
         window,
         {{PlacePin, letter('P')}, {PlaceDistance, letter('D'), kShift}}},
        {group, "blink before and after", "", window, {{BlinkEdit, letter('B')}}}};
}

std::string key_name(int key) {
    switch (key) {
        case keys::kSpace:
            return "Space";
        case keys::kEscape:
            return "Esc";
        case keys::kEnter:
            return "Enter";
        case keys::kHome:
            return "Home";
        case keys::kUp:
            return "Up";
        case keys::kDown:
            return "Down";
        case keys::kF1:
            return "F1";
        case keys::kF12:
            return "F12";
        case keys::kEqual:
            return "Plus";
        case keys::kMinus:
            return "Minus";
        default:
            return {static_cast<char>(key)};
    }
}

std::string prefix_of(Modifiers modifiers) {
    switch (modifiers) {
        case Modifiers::Control:
            return "Ctrl+";
        case Modifiers::Shift:
            return "Shift+";
        case Modifiers::ControlShift:
            return "Ctrl+Shift+";
        default:
            return "";
    }
}

/// The number pad repeats other keys, and Plus may need Shift or not: neither is named.
bool is_named(const std::vector<KeyBinding>& bindings, std::size_t i) {
    const bool repeated = i > 0 && bindings[i - 1].command == bindings[i].command &&
                          bindings[i - 1].key == bindings[i].key;
    return bindings[i].key < keys::kPad0 && !repeated;
}

}  // namespace

std::span<const KeyRow> key_table() {
    static const std::vector<KeyRow> table = [] {
        std::vector<KeyRow> all;
        for (const auto& rows :
             {editing_rows(), view_rows(), mode_rows(), brush_rows(), slice_rows(), review_rows()})
            all.insert(all.end(), rows.begin(), rows.end());
        return all;
    }();
    return table;
}

std::string keys_text(const KeyRow& row) {
    std::string text;
    std::string last;
    for (std::size_t i = 0; i < row.bindings.size(); ++i) {
        if (!is_named(row.bindings, i)) continue;
        const std::string prefix = prefix_of(row.bindings[i].modifiers);
        if (!text.empty()) text += ", ";
        text += (prefix == last ? "" : prefix) + key_name(row.bindings[i].key);
        last = prefix;
    }
    const std::string mouse = row.mouse;
    return text + (text.empty() || mouse.empty() ? "" : ", ") + mouse;
}

std::string keys_of(KeyCommand command) {
    for (const KeyRow& row : key_table())
        for (const KeyBinding& binding : row.bindings)
            if (binding.command == command)
                return prefix_of(binding.modifiers) + key_name(binding.key);
    return "";
}

}  // namespace vesselbench
