#pragma once

namespace vesselbench {

/// The text of a code, without an operation's or an argument's name: those are in the remedies.
/// Only what a command alone reaches names the command's options. {place} is the place, {name} a
/// word or a figure with three digits, {name:%.1f} a figure in a printf format, {name#noun|plural}
/// a number with its noun, {fix} and {fix2} the first two remedies. A part in brackets is left out
/// if something in it is not known.
struct CatalogueText {
    const char* code;
    const char* text;
    bool note = false;  ///< what was done as it should be, so that it is no warning
};

/// Of a text: CatalogueText::note.
inline constexpr bool kNote = true;

}  // namespace vesselbench
