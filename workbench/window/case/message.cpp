#include "workbench/window/case/message.h"

#include <algorithm>
#include <cctype>

#include "geometry/kernel/catalogue.h"
#include "workbench/case/diagnostic_words.h"
#include "workbench/window/case/local_time.h"
#include "workbench/window/case/readable.h"

namespace vesselbench {

namespace {

/// Not with the name of a file or of an operation, which stay as they are.
bool begins_with_word(const std::string& text) {
    const std::string first = text.substr(0, text.find_first_of(" ,:"));
    return std::ranges::all_of(
        first, [](unsigned char letter) { return std::isalpha(letter) != 0 || letter == '\''; });
}

}  // namespace

Message make_message(MessageKind kind, std::string text) {
    if (kind == MessageKind::Error && begins_with_word(text))
        text = readable_sentence(std::move(text));
    return {.kind = kind, .text = std::move(text), .time = local_time("%H:%M:%S")};
}

Message make_message(const Diagnostic& diagnostic) {
    const MessageKind kind = diagnostic.severity == Severity::Error ? MessageKind::Error
                             : is_note(diagnostic)                  ? MessageKind::Remark
                                                                    : MessageKind::Warning;
    std::vector<Remedy> remedies = diagnostic.remedies;
    for (Remedy& remedy : remedies)
        if (remedy.operation.empty()) remedy.operation = diagnostic.operation;
    std::string text = worded_with_operation(diagnostic, {.window = true});
    if (begins_with_word(text)) text = readable_sentence(std::move(text));
    return {.kind = kind,
            .text = std::move(text),
            .time = local_time("%H:%M:%S"),
            .edit = diagnostic.edit,
            .place = diagnostic.place,
            .operation = diagnostic.operation,
            .remedies = std::move(remedies)};
}

bool holds_now(const Message& message, const Snapshot& snapshot, const std::string& variant,
               bool previewed) {
    if (message.of_preview) return previewed;
    if (!message.variant.empty() && message.variant != variant) return false;
    if (!message.edit || (message.kind != MessageKind::Warning && !message.result)) return true;
    const auto entry = std::ranges::find(snapshot.log, *message.edit,
                                         [](const LogEntry& e) { return e.edit.edit.id; });
    if (entry == snapshot.log.end() || !is_part_of(entry->edit.place, variant)) return false;
    if (!message.result) return entry->status == EditStatus::Stale;
    return entry->result && entry->result->id == *message.result;
}

Diagnostic refusal_of(const LogEntry& stale) {
    const EditRecord& edit = stale.edit;
    Diagnostic why = stale.refusal.empty() ? plain_text(stale.reason) : stale.refusal.front();
    why.operation = edit.operation;
    why.edit = edit.edit.id;
    return why;
}

std::string reason_of(const LogEntry& stale) {
    return worded(refusal_of(stale), {.window = true});
}

Message stale_message(const LogEntry& stale) {
    Message message = make_message(refusal_of(stale));
    message.kind = MessageKind::Warning;
    message.text = readable(stale.edit.operation) + " no longer applies: " + reason_of(stale);
    return message;
}

}  // namespace vesselbench
