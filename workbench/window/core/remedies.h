#pragma once

#include <string>
#include <vector>

#include "workbench/window/case/message.h"
#include "workbench/window/core/core.h"

namespace vesselbench {

/// The remedies of a message that can be followed now, the best first: an edit that it is about is
/// still there, and this build has the operation and its parameters.
[[nodiscard]] std::vector<Remedy> remedies_of(const Document& document, const Message& message);

/// What the button of a remedy says: "Set edge to 0.5 mm", "Fill hole", "Remove Smooth".
/// \param about the operation that the message is about
[[nodiscard]] std::string remedy_label(const std::string& about, const Remedy& remedy);

/// What the one button of a message says: its best remedy, else where its edit is; empty: it has
/// none.
[[nodiscard]] std::string button_of(const Document& document, const Message& message);

/// What that button does.
void follow(Core& place, const Message& message);

/// Opens the form that the remedy is about and fills in its values, as if they were typed; what has
/// to be chosen is armed, asked for or gets the keyboard. An edit that is to go or to choose again
/// does so at once; undo brings it back.
/// \param message copied: it may be the failure that an opened form forgets
void follow(Core& place, Message message, Remedy remedy);

}  // namespace vesselbench
