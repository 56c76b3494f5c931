#include "workbench/review/audit_texts.h"

#include <map>
#include <utility>

#include "geometry/kernel/wording.h"
#include "workbench/case/diagnostic_json.h"
#include "workbench/case/diagnostic_words.h"
#include "workbench/report/rendered_template.h"
#include "workbench/review/audit_template.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

std::string text_at(const Json& facts, const char* key) {
    const auto found = facts.find(key);
    if (found == facts.end()) return "";
    return found->is_string() ? found->get<std::string>() : found->dump();
}

std::string edit_words(const Json& facts) {
    const std::string variant = text_at(facts, "variant"), note = text_at(facts, "note");
    return text_at(facts, "operation") + " (" + text_at(facts, "step") +
           (variant.empty() ? "" : ", " + variant) + ")" +
           (note.empty() ? "" : " \"" + note + "\"");
}

/// "3 accept, 1 reject"
std::string verdict_words(const Json& facts) {
    std::map<std::string, std::size_t> counts;
    if (const auto edits = facts.find("edits"); edits != facts.end() && edits->is_object())
        for (const auto& [edit, verdict] : edits->items())
            if (verdict.is_string()) ++counts[verdict.get<std::string>()];
    std::string text;
    for (const auto& [verdict, count] : counts)
        if (verdict != "none")
            text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + verdict;
    const std::string role = text_at(facts, "role"), signer = text_at(facts, "signer");
    if (text.empty()) text = "no verdict on an edit";
    if (facts.contains("signature"))
        text += signer.empty() ? ", signed" : ", signed by " + signer + " when it was entered";
    return (role.empty() ? "" : role + ": ") + text;
}

std::size_t size_of(const Json& facts, const char* key) {
    const auto found = facts.find(key);
    return found == facts.end() ? 0 : found->size();
}

std::string words_of(const std::string& kind, const Json& facts) {
    if (kind == "edit" || kind == "change") return edit_words(facts);
    if (kind == "result") return "its result, SHA-256 " + text_at(facts, "sha256").substr(0, 12);
    if (kind == "refusal") return "it does not apply: " + text_at(facts, "reason");
    if (kind == "undo" || kind == "redo" || kind == "go")
        return "from state " + text_at(facts, "from");
    if (kind == "note") {
        const std::string note = text_at(facts, "note");
        return note.empty() ? "removed" : "\"" + note + "\"";
    }
    if (kind == "verdicts") return verdict_words(facts);
    if (kind == "export")
        return text_at(facts, "variant") + ", SHA-256 " + text_at(facts, "sha256").substr(0, 12);
    if (kind == "compact") return counted(size_of(facts, "results"), "result") + " dropped";
    if (kind == "found")
        return "the record begins with what was found: " + counted(size_of(facts, "rows"), "row") +
               ", whose history it does not know";
    if (kind == kKeyRetired) return "nobody signs with it any more: " + text_at(facts, "reason");
    if (kind == "new") return "the project begins";
    return kind == "remove" ? "left out" : "stored";
}

std::string value_words(const Json& value) {
    if (value.is_string()) return value.get<std::string>();
    if (value.is_null()) return "-";
    if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
    return value.is_number_float() ? formatted(value.get<double>(), "%.4g") : value.dump();
}

/// Lists of numbers and names as one text, for cells of tables.
Json flat(Json json) {
    for (auto& [key, value] : json.items()) {
        const bool plain = value.is_array() && !value.empty() && value.front().is_primitive();
        if (plain || (value.is_object() && key == "verdicts")) {
            std::string text;
            for (const auto& [name, part] : value.items())
                text += (text.empty() ? "" : ", ") + value_words(part) +
                        (value.is_object() ? " " + name : "");
            value = text;
        } else if (value.is_structured()) {
            value = flat(std::move(value));
        } else {
            value = value_words(value);
        }
    }
    return json;
}

}  // namespace

std::string entry_words(const ChainEntry& entry) {
    const Json facts = Json::parse(entry.content, nullptr, false);
    return facts.is_object() ? words_of(entry.kind, facts) : "?";
}

Json audit_json(const Audit& audit) {
    Json entries = Json::array();
    for (const ChainEntry& entry : audit.record.entries)
        entries.push_back({{"number", entry.number},
                           {"time", entry.time},
                           {"kind", entry.kind},
                           {"subject", entry.subject},
                           {"author", entry.author},
                           {"version", entry.version},
                           {"what", entry_words(entry)},
                           {"hash", entry.hash}});
    return {{"project", audit.project},
            {"id", audit.record.project},
            {"head", audit.record.entries.empty() ? "" : audit.record.entries.back().hash},
            {"verified", audit.findings.empty()},
            {"findings", worded(audit.findings)},
            {"diagnostics", diagnostics_json(audit.findings)},
            {"verified_parts", audit.verified},
            {"unverified", audit.unverified},
            {"entries", entries},
            {"statement", audit.statement}};
}

std::string audit_html(const Audit& audit) {
    Json page = audit_json(audit);
    page.erase("diagnostics");
    page["any_statement"] = !audit.statement.is_null();
    if (!audit.statement.is_null()) page["statement"] = flat(audit.statement);
    for (Json& entry : page["entries"])
        entry["short_hash"] = entry["hash"].get<std::string>().substr(0, 12);
    return rendered_template(audit_templates().at("audit.html"), page);
}

}  // namespace vesselbench
