#pragma once

#include <functional>
#include <map>
#include <string>

namespace vesselbench {

/// What the keyboard's layout prints on the key that has a number (keys.h) on a US keyboard, as
/// UTF-8 and without Shift; empty: nothing.
using KeyNames = std::function<std::string(int position)>;

/// The number of a pressed key by what is printed on it: Ctrl+Z is the key with the Z, wherever the
/// layout has it. A key keeps its position's number if nothing in ASCII is printed on it, or
/// something that no key of a US keyboard has without Shift; and so do all keys of a layout without
/// Latin letters.
[[nodiscard]] int key_by_layout(int position, const KeyNames& names);

/// The keys that are down. A key keeps its number until it is released, also if the layout is
/// changed meanwhile.
class PressedKeys {
public:
    /// \return the number of a key that goes down
    [[nodiscard]] int press(int position, const KeyNames& names);

    /// \return the number that it had when it went down
    [[nodiscard]] int release(int position);

private:
    std::map<int, int> numbers_;  ///< by positions
};

}  // namespace vesselbench
