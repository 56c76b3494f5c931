#include "workbench/window/case/message.h"

#include <algorithm>
#include <cctype>

#include "workbench/case/diagnostic_words.h"
#include "workbench/operations/table.h"
#include "workbench/window/case/local_time.h"
#include "workbench/window/case/readable.h"

namespace vesselbench {

namespace {

bool is_part_of_word(char letter) {
    return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '-' || letter == '_';
}

/// Where a whole word begins; npos: nowhere.
std::size_t find_word(const std::string& text, const std::string& word) {
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
        const std::size_t end = at + word.size();
        if ((at == 0 || !is_part_of_word(text[at - 1])) &&
            (end == text.size() || !is_part_of_word(text[end])))
            return at;
    }
    return std::string::npos;
}

/// Not with the name of a file or of an operation, which stay as they are.
bool begins_with_word(const std::string& text) {
    const std::string first = text.substr(0, text.find_first_of(" ,:"));
    return std::ranges::all_of(
        first, [](unsigned char letter) { return std::isalpha(letter) != 0 || letter == '\''; });
}

}  // namespace

std::string remedy_in(const std::string& text, const std::string& failed) {
    std::string first;
    std::size_t place = std::string::npos;
    for (const Operation& operation : operation_table()) {
        const std::size_t at = find_word(text, operation.name);
        if (operation.name == failed || at >= place) continue;
        place = at;
        first = operation.name;
    }
    return first;
}

Message make_message(MessageKind kind, std::string text, const std::string& failed) {
    if (kind == MessageKind::Error && begins_with_word(text))
        text = readable_sentence(std::move(text));
    Message message{.kind = kind, .text = std::move(text), .time = local_time("%H:%M:%S")};
    if (kind == MessageKind::Error) message.remedy = remedy_in(message.text, failed);
    return message;
}

Message make_message(const Diagnostic& diagnostic) {
    const bool failed = diagnostic.severity == Severity::Error;
    const auto remedy = std::ranges::find_if(diagnostic.remedies, [&](const Remedy& one) {
        return !one.operation.empty() && one.operation != diagnostic.operation;
    });
    std::string text = worded_with_operation(diagnostic, {.window = true});
    if (begins_with_word(text)) text = readable_sentence(std::move(text));
    return {.kind = failed ? MessageKind::Error : MessageKind::Warning,
            .text = std::move(text),
            .remedy = remedy == diagnostic.remedies.end() ? "" : remedy->operation,
            .time = local_time("%H:%M:%S"),
            .edit = diagnostic.edit,
            .place = diagnostic.place};
}

}  // namespace vesselbench
