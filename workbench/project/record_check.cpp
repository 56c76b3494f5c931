#include "workbench/project/record_check.h"

#include <map>
#include <utility>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/printable.h"
#include "workbench/case/json_fields.h"
#include "workbench/project/part_store.h"

namespace vesselbench {

namespace {

Diagnostic finding(std::string code, std::map<std::string, std::string> words) {
    return {.code = std::move(code), .severity = Severity::Error, .words = std::move(words)};
}

std::string words_of(const ChainEntry& entry) {
    return std::to_string(entry.number) + " (" + printable(entry.kind) + ", " +
           shortened(printable(entry.subject)) + ", " + printable(entry.time) + ")";
}

bool is_text(const ChainEntry& entry) {
    for (const std::string* text : {&entry.time, &entry.kind, &entry.subject, &entry.author,
                                    &entry.version, &entry.content, &entry.hash})
        if (!is_utf8(*text)) return false;
    return true;
}

void check_links(const Database& database, RecordCheck& check) {
    std::string earlier = chain_start();
    std::int64_t number = 0;
    for (const ChainEntry& entry : check.entries) {
        if (entry.number != number + 1)
            check.findings.push_back(
                finding("record-entry-missing",
                        {{"entry", words_of(entry)}, {"number", std::to_string(number + 1)}}));
        else if (!is_text(entry) || link_of(earlier, entry) != entry.hash)
            check.findings.push_back(finding("record-entry-altered", {{"entry", words_of(entry)}}));
        number = entry.number;
        earlier = entry.hash;
    }
    if (kept_chain_head(database) != earlier)
        check.findings.push_back(
            finding("record-head-altered", {{"number", std::to_string(number)}}));
}

/// What the entries say of a row.
struct BoundRow {
    std::string digest;
    const ChainEntry* entry = nullptr;  ///< the last one that wrote it
};

using BoundRows = std::map<std::string, BoundRow>;

void apply(const ChainEntry& entry, BoundRows& rows) {
    constexpr std::size_t kLargest = std::size_t{64} << 20;  // [bytes]
    const auto json = json_from_text(entry.content, "an entry", kLargest);
    JsonFields fields(json, "an entry");
    if (const auto* written = fields.child("rows"))
        for (const auto& [key, digest] : written->items())
            rows[key] = {json_value<std::string>(digest, "an entry"), &entry};
    for (const std::string& key :
         fields.optional<std::vector<std::string>>("gone").value_or(std::vector<std::string>()))
        rows.erase(key);
}

BoundRows bound_rows(RecordCheck& check) {
    BoundRows rows;
    for (const ChainEntry& entry : check.entries) {
        try {
            apply(entry, rows);
        } catch (const InvalidInput&) {  // then its hash is wrong as well, unless it was forged
            check.findings.push_back(finding("record-entry-altered", {{"entry", words_of(entry)}}));
        }
    }
    return rows;
}

void check_rows(const Database& database, RecordCheck& check) {
    const BoundRows bound = bound_rows(check);
    const RowDigests stored = all_row_digests(database);
    check.rows = stored.size();
    for (const auto& [key, row] : bound) {
        const auto found = stored.find(key);
        if (found != stored.end() && found->second == row.digest) continue;
        check.findings.push_back(
            finding(found == stored.end() ? "record-row-missing" : "record-row-altered",
                    {{"row", row_words(key)}, {"entry", words_of(*row.entry)}}));
    }
    for (const auto& [key, digest] : stored)
        if (!bound.contains(key))
            check.findings.push_back(finding("record-row-unknown", {{"row", row_words(key)}}));
}

/// Kept in memory so that the differences that follow need not be unpacked from the start.
constexpr std::size_t kRecentParts = 16;

/// Why a blob does not have the content of its checksum; empty: it has.
std::string damage(PartStore& store, BlobId id, std::vector<ScenePart>& recent) {
    try {
        if (recent.size() == kRecentParts) recent.erase(recent.begin());
        recent.push_back(store.load(id));
        return "";
    } catch (const InvalidInput& error) {
        return error.what();
    } catch (const std::bad_alloc&) {
        return "it would not fit into memory";
    }
}

void check_blobs(const Database& database, RecordCheck& check, const Progress& progress) {
    std::vector<std::pair<BlobId, bool>> blobs;
    for (auto row = database.prepare("SELECT id, content IS NULL FROM blobs ORDER BY id");
         row.step();)
        blobs.emplace_back(row.integer(0), row.integer(1) != 0);
    PartStore store(database, 0);
    std::vector<ScenePart> recent;
    for (std::size_t i = 0; i < blobs.size(); ++i) {
        progress.report(static_cast<double>(i) / static_cast<double>(blobs.size()),
                        "verifying the results");
        const auto [id, referenced] = blobs[i];
        if (referenced) {
            ++check.referenced;
            continue;
        }
        if (const std::string why = damage(store, id, recent); !why.empty())
            check.findings.push_back(
                finding("record-data-damaged",
                        {{"row", row_words("blobs " + std::to_string(id))}, {"reason", why}}));
    }
}

/// The pages of the file, and its indices.
void check_pages(const Database& database, RecordCheck& check) {
    Statement row = database.prepare("PRAGMA integrity_check(1)");
    if (row.step() && row.text(0) != "ok")
        check.findings.push_back(finding("record-unreadable", {{"reason", row.text(0)}}));
}

}  // namespace

RecordCheck check_record_rows(const Database& database) {
    RecordCheck check;
    try {
        check.project = project_id(database);
        check.entries = read_chain(database);
        if (check.entries.empty()) {
            check.findings.push_back(finding("record-missing", {}));
            return check;
        }
        check_links(database, check);
        check_rows(database, check);
    } catch (const InvalidInput& error) {
        check.findings.push_back(finding("record-unreadable", {{"reason", error.what()}}));
    }
    return check;
}

RecordCheck check_record(const Database& database, const Progress& progress) {
    RecordCheck check = check_record_rows(database);
    if (check.entries.empty()) return check;
    try {
        check_blobs(database, check, progress);
        check_pages(database, check);
    } catch (const InvalidInput& error) {
        check.findings.push_back(finding("record-unreadable", {{"reason", error.what()}}));
    }
    return check;
}

std::string row_words(const std::string& key) {
    static const std::map<std::string, std::string> names = {
        {"edits", "edit"},   {"sources", "the files read by edit"},
        {"states", "state"}, {"results", "result"},
        {"blobs", "data"},   {"verdicts", "the verdicts"},
        {"meta", "the text"}};
    const std::size_t blank = key.find(' ');
    const auto name = names.find(key.substr(0, blank));
    if (blank == std::string::npos || name == names.end()) return printable(key);
    return name->second + " " + shortened(printable(key.substr(blank + 1)));
}

}  // namespace vesselbench
