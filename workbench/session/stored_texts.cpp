#include "workbench/session/stored_texts.h"

#include "geometry/kernel/errors.h"
#include "workbench/project/chain.h"
#include "workbench/project/database.h"
#include "workbench/project/schema.h"
#include "workbench/session/login_name.h"

namespace vesselbench {

namespace {

std::string key_of(StoredText which) {
    switch (which) {
        case StoredText::Recipes:
            return "recipes";
        case StoredText::GivenRecipes:
            return "given recipes";
        case StoredText::Flow:
            return "flow";
        case StoredText::Warnings:
            return "warnings";
        case StoredText::Purposes:
            return "purposes";
        case StoredText::InputName:
            return "input name";
        case StoredText::Acceptance:
            return "acceptance";
        case StoredText::CaseFolder:
            return "case folder";
        case StoredText::Measures:
            return "measures";
        case StoredText::Dismissals:
            return "dismissals";
        case StoredText::Spots:
            break;
    }
    return "spots";
}

std::string text_in(const Database& database, StoredText which) {
    const std::string key = key_of(which);  // a bound text must live until the step
    Statement query = database.prepare("SELECT value FROM meta WHERE name = ?");
    query.bind(0, key);
    return query.step() ? query.text(0) : "";
}

/// True if the file alone is all of the project.
bool has_no_log(std::filesystem::path project) {
    project += "-wal";
    std::error_code missing;
    const auto size = std::filesystem::file_size(project, missing);
    return missing || size == 0;
}

}  // namespace

void store_text(const std::filesystem::path& project, StoredText which, const std::string& text,
                const StoredChange& change) {
    const Database database(project, OpenMode::Write);
    if (text_in(database, which) == text) return;
    const std::string key = key_of(which);
    Transaction transaction(database);
    if (lacks_record(database)) begin_record(database);
    database.prepare("INSERT OR REPLACE INTO meta VALUES(?, ?)").bind(0, key).bind(1, text).step();
    NewEntry entry{.kind = key,
                   .subject = change.subject,
                   .author = login_name(),
                   .facts = nlohmann::json::parse(change.facts),
                   .rows = {},
                   .gone = {}};
    add_row_digests(database, "meta", "name = '" + key + "'", entry.rows);
    append_entry(database, entry);
    transaction.commit();
}

std::string stored_text(const std::filesystem::path& project, StoredText which) {
    try {
        return text_in(Database(project, OpenMode::Read), which);
    } catch (const IoError&) {  // in a folder that cannot be written
        if (!has_no_log(project)) throw;
        return text_in(Database(project, OpenMode::Frozen), which);
    }
}

}  // namespace vesselbench
