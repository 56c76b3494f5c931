#pragma once

#include <optional>
#include <string>

#include "geometry/kernel/vec3.h"
#include "workbench/case/history.h"

namespace vesselbench {

enum class MessageKind { Remark, Success, Warning, Error };

/// A line of the window's messages.
struct Message {
    MessageKind kind = MessageKind::Remark;
    std::string text;
    std::string remedy;          ///< name of an operation that the text recommends; empty: none
    std::string time;            ///< local, "14:05:31"
    std::optional<EditId> edit;  ///< that it is about
    std::optional<Vec3> place;   ///< that the text names [mm]
};

/// A message of now. \param failed the operation it is about, which is no remedy for itself
[[nodiscard]] Message make_message(MessageKind kind, std::string text,
                                   const std::string& failed = {});

/// The first place in a text: "(3.7617, 25.896, 13.937) mm"; none: it names no place.
[[nodiscard]] std::optional<Vec3> place_in(const std::string& text);

/// The first operation that a text names as a whole word, other than `failed`; empty: none.
[[nodiscard]] std::string remedy_in(const std::string& text, const std::string& failed);

}  // namespace vesselbench
