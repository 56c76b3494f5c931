#pragma once

#include <string>

namespace vesselbench {

enum class MessageKind { Remark, Success, Warning, Error };

/// A line of the window's messages.
struct Message {
    MessageKind kind = MessageKind::Remark;
    std::string text;
    std::string remedy;  ///< name of an operation that the text recommends; empty: none
    std::string time;    ///< local, "14:05:31"
};

/// A message of now. \param failed the operation it is about, which is no remedy for itself
[[nodiscard]] Message make_message(MessageKind kind, std::string text,
                                   const std::string& failed = {});

/// The first operation that a text names as a whole word, other than `failed`; empty: none.
[[nodiscard]] std::string remedy_in(const std::string& text, const std::string& failed);

}  // namespace vesselbench
