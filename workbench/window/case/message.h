#pragma once

#include <optional>
#include <string>

#include "geometry/kernel/diagnostic.h"
#include "workbench/case/history.h"

namespace vesselbench {

enum class MessageKind { Remark, Success, Warning, Error };

/// A line of the window's messages.
struct Message {
    MessageKind kind = MessageKind::Remark;
    std::string text;
    std::string remedy;          ///< name of an operation that would solve it; empty: none
    std::string time;            ///< local, "14:05:31"
    std::optional<EditId> edit;  ///< that it is about
    std::optional<Vec3> place;   ///< that it is about [mm]
};

/// A message of now. \param failed the operation it is about, which is no remedy for itself
[[nodiscard]] Message make_message(MessageKind kind, std::string text,
                                   const std::string& failed = {});

/// What an edit, a recipe or an error says, in the window's words, with its operation before it.
[[nodiscard]] Message make_message(const Diagnostic& diagnostic);

/// The first operation that an error's text names as a whole word, other than `failed`; empty:
/// none. For errors that have no diagnostics.
[[nodiscard]] std::string remedy_in(const std::string& text, const std::string& failed);

}  // namespace vesselbench
