#include "workbench/review/retired_keys.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/printable.h"
#include "workbench/case/json_text.h"
#include "workbench/project/project.h"
#include "workbench/review/signing_key.h"

namespace vesselbench {

namespace {

std::string retirement_reason(const ChainEntry& entry) {
    const auto facts = nlohmann::json::parse(entry.content, nullptr, false);
    const auto found = facts.find("reason");
    return found != facts.end() && found->is_string() ? found->get<std::string>() : "";
}

}  // namespace

std::vector<RetiredKey> retired_keys(std::span<const ChainEntry> entries) {
    std::vector<RetiredKey> keys;
    std::size_t files = 0;
    for (const ChainEntry& entry : entries) {
        if (entry.kind == kVerdictsEntered) ++files;
        if (entry.kind != kKeyRetired) continue;
        keys.push_back({.fingerprint = entry.subject,
                        .time = entry.time,
                        .author = entry.author,
                        .reason = retirement_reason(entry),
                        .files_before = files});
    }
    return keys;
}

std::vector<RetiredKey> retired_keys(const ProjectFile& project) {
    return retired_keys(project.record_entries());
}

const RetiredKey* find_retired(const std::vector<RetiredKey>& keys,
                               const std::string& fingerprint) {
    const auto found = std::ranges::find(keys, fingerprint, &RetiredKey::fingerprint);
    return found == keys.end() ? nullptr : &*found;
}

std::string retired_words(const RetiredKey& key) {
    return "its key was retired on " + printable(key.time) + ": " + printable(key.reason);
}

void retire_key(Session& session, const std::string& fingerprint, const std::string& reason) {
    if (!is_key_fingerprint(fingerprint))
        throw UsageError("--retire-key '" + shortened(printable(fingerprint)) +
                         "': give a key's fingerprint, SHA256:..., as 'review' lists those that "
                         "signed, and 'ssh-keygen -l -f KEY.pub' prints it");
    const std::vector<RetiredKey> keys = retired_keys(session.project());
    if (const RetiredKey* known = find_retired(keys, fingerprint))
        throw InvalidInput(fingerprint + " is retired already: " + retired_words(*known));
    session.record({.kind = kKeyRetired,
                    .subject = fingerprint,
                    .facts = text_from_json(nlohmann::ordered_json{{"reason", reason}})});
}

}  // namespace vesselbench
