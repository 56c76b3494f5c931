#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/kernel/diagnostic.h"
#include "workbench/session/snapshot.h"

namespace vesselbench {

enum class MessageKind { Remark, Success, Warning, Error };

/// A line of the window's messages.
struct Message {
    MessageKind kind = MessageKind::Remark;
    std::string text;
    std::string time;                     ///< local, "14:05:31"
    std::optional<EditId> edit;           ///< that it is about
    std::optional<Vec3> place;            ///< that it is about [mm]
    std::string operation;                ///< that it is about; empty: none
    std::vector<Remedy> remedies;         ///< with their operations, the best first
    std::string variant = {};             ///< whose model it is about; empty: of all
    std::optional<ResultId> result = {};  ///< that warned of it
    bool of_preview = false;              ///< it is about what is previewed
};

/// A message of now.
[[nodiscard]] Message make_message(MessageKind kind, std::string text);

/// What an edit, a recipe or an error says, in the window's words, with its operation before it.
[[nodiscard]] Message make_message(const Diagnostic& diagnostic);

/// True unless what the message is about is gone or not shown: another variant, a preview that was
/// dropped; and of a warning, another result of its edit, or none.
/// \param variant that is shown
[[nodiscard]] bool holds_now(const Message& message, const Snapshot& snapshot,
                             const std::string& variant, bool previewed);

/// Why an edit is stale; without remedies in projects of old versions.
[[nodiscard]] Diagnostic refusal_of(const LogEntry& stale);

/// The same in the window's words, without the edit's operation.
[[nodiscard]] std::string reason_of(const LogEntry& stale);

/// "Smooth no longer applies: ..."
[[nodiscard]] Message stale_message(const LogEntry& stale);

}  // namespace vesselbench
