#include "workbench/review/witness.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <map>
#include <sstream>
#include <utility>

#include "geometry/kernel/bare_name.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/printable.h"
#include "workbench/project/project.h"
#include "workbench/project/utc_time.h"

namespace vesselbench {

namespace {

constexpr std::string_view kLineBegins = "vesselbench-witness";
constexpr std::size_t kFewestDigits = 16;  ///< of a hash that a person copies: 64 bits

Diagnostic contradiction(std::string code, std::map<std::string, std::string> words) {
    return {.code = std::move(code), .severity = Severity::Error, .words = std::move(words)};
}

Witness witness_from(const std::string& name, const VerdictFile& verdicts) {
    return {.name = name,
            .who = printable(verdicts.reviewer),
            .project = verdicts.project,
            .project_name = verdicts.project_name,
            .head = verdicts.chain_head,
            .time = verdicts.written};
}

bool is_digest_part(const std::string& text) {
    return text.size() >= kFewestDigits && text.size() <= chain_start().size() &&
           text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

/// "project=..." and the others by their names.
std::map<std::string, std::string> named_words(const std::string& line) {
    std::map<std::string, std::string> words;
    std::istringstream stream(line);
    for (std::string word; stream >> word;)
        if (const std::size_t is = word.find('='); is != std::string::npos)
            words[word.substr(0, is)] = word.substr(is + 1);
    return words;
}

Witness witness_in_line(const std::string& line, const std::string& name) {
    auto words = named_words(line);
    const std::string& entries = words["entries"];
    Witness made{.name = name,
                 .who = "the witness",
                 .project = words["project"],
                 .head = words["head"],
                 .time = words["time"]};
    const auto read = std::from_chars(entries.data(), entries.data() + entries.size(), made.number);
    if (read.ec != std::errc() || read.ptr != entries.data() + entries.size() || made.number < 1 ||
        !is_digest_part(made.head) || made.project.empty() || !is_utc_time(made.time))
        throw InvalidInput(name + ": '" + shortened(printable(line), 160) +
                           "' is no line as 'audit --witness' prints it: project=, entries=, head= "
                           "with at least " +
                           std::to_string(kFewestDigits) + " digits, and time=");
    return made;
}

std::vector<Witness> witnesses_in_lines(const std::string& text, const std::string& name) {
    std::vector<Witness> list;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
        if (const std::size_t at = line.find(kLineBegins); at != std::string::npos)
            list.push_back(witness_in_line(line.substr(at), name));
    return list;
}

/// An older copy saw its own last entry.
Witness witness_in_copy(const std::string& path, const RecordCheck& record) {
    const std::string name = bare_name(path);
    const RecordCheck copy = ProjectFile::open_to_read(path, "it is a witness").check_record_rows();
    if (!copy.findings.empty())
        throw InvalidInput(name +
                           " is no witness: it is not what its own record says ('audit' "
                           "says more)");
    const auto differs = std::ranges::mismatch(copy.entries, record.entries, {}, &ChainEntry::hash,
                                               &ChainEntry::hash);
    const auto same = std::distance(copy.entries.begin(), differs.in1);
    return {.name = name,
            .who = "this copy",
            .project = copy.project,
            .project_name = name,
            .head = copy.entries.back().hash,
            .number = copy.entries.back().number,
            .time = copy.entries.back().time,
            .where = "after entry " + std::to_string(same)};
}

/// Where a record was rewritten that no longer has what a witness saw.
std::string rewritten_where(const Witness& witness, std::span<const Witness> all,
                            const RecordCheck& record) {
    if (!witness.where.empty()) return witness.where;
    std::int64_t last = 0, confirmed = 0;
    for (const ChainEntry& entry : record.entries)
        if (entry.time <= witness.time) last = entry.number;
    for (const Witness& other : all)
        if (const std::int64_t seen = entry_seen(other, record); seen <= last)
            confirmed = std::max(confirmed, seen);
    if (last == 0) return "as a whole after " + witness.time;
    if (confirmed == last) return "after entry " + std::to_string(last);
    return "between entry " + std::to_string(confirmed + 1) + " and entry " + std::to_string(last);
}

bool is_cut_off(const Witness& witness, const RecordCheck& record) {
    return witness.number > static_cast<std::int64_t>(record.entries.size());
}

}  // namespace

std::string witness_line(const RecordCheck& record, const std::string& time) {
    return std::string(kLineBegins) + " project=" + record.project +
           " entries=" + std::to_string(record.entries.size()) +
           " head=" + (record.entries.empty() ? chain_start() : record.entries.back().hash) +
           " time=" + time;
}

std::vector<Witness> witnesses_in(const std::string& given, const RecordCheck& record) {
    if (given.starts_with(kLineBegins)) return {witness_in_line(given, "the line")};
    if (is_project_file(given)) return {witness_in_copy(given, record)};
    const std::string name = bare_name(given), text = verdict_text_in(given);
    std::vector<Witness> lines;
    if (!text.starts_with('{')) lines = witnesses_in_lines(text, name);
    if (!lines.empty()) return lines;
    return {witness_from(name, verdicts_from_text(text, name))};
}

std::vector<Witness> witnesses_of(const std::vector<EnteredVerdicts>& entered) {
    std::vector<Witness> list;
    for (const EnteredVerdicts& one : entered)
        list.push_back(witness_from("verdicts in the project", one.verdicts));
    return list;
}

std::int64_t entry_seen(const Witness& witness, const RecordCheck& record) {
    if (witness.head.size() < kFewestDigits) return 0;
    for (const ChainEntry& entry : record.entries)
        if (entry.hash.starts_with(witness.head) &&
            (witness.number == 0 || witness.number == entry.number))
            return entry.number;
    return 0;
}

std::vector<Diagnostic> contradictions_of(std::span<const Witness> witnesses,
                                          const RecordCheck& record) {
    std::vector<Diagnostic> found;
    for (const Witness& witness : witnesses) {
        std::map<std::string, std::string> words = {{"file", witness.name},
                                                    {"reviewer", witness.who}};
        if (witness.project != record.project) {
            words["name"] =
                witness.project_name.empty() ? "a project" : printable(witness.project_name);
            found.push_back(contradiction("record-other-project", words));
        } else if (entry_seen(witness, record) == 0) {
            words["head"] = witness.head.substr(0, 12);
            words["where"] = rewritten_where(witness, witnesses, record);
            words["number"] = std::to_string(witness.number);
            words["last"] = std::to_string(record.entries.size());
            found.push_back(contradiction(
                is_cut_off(witness, record) ? "record-cut-off" : "record-rewritten", words));
        }
    }
    return found;
}

}  // namespace vesselbench
