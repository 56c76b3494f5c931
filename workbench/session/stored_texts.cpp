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

constexpr const char* kView = "view";  ///< row_digests.cpp leaves it out

/// \param key a bound text must live until the step
std::string text_in(const Database& database, const std::string& key) {
    Statement query = database.prepare("SELECT value FROM meta WHERE name = ?");
    query.bind(0, key);
    return query.step() ? query.text(0) : "";
}

void put_text(const Database& database, const std::string& key, const std::string& text) {
    database.prepare("INSERT OR REPLACE INTO meta VALUES(?, ?)").bind(0, key).bind(1, text).step();
}

/// True if the file alone is all of the project.
bool has_no_log(std::filesystem::path project) {
    project += "-wal";
    std::error_code missing;
    const auto size = std::filesystem::file_size(project, missing);
    return missing || size == 0;
}

std::string text_of_key(const std::filesystem::path& project, const std::string& key) {
    try {
        return text_in(Database(project, OpenMode::Read), key);
    } catch (const IoError&) {  // in a folder that cannot be written
        if (!has_no_log(project)) throw;
        return text_in(Database(project, OpenMode::Frozen), key);
    }
}

}  // namespace

void store_text(const std::filesystem::path& project, StoredText which, const std::string& text,
                const StoredChange& change) {
    const Database database(project, OpenMode::Write);
    const std::string key = key_of(which);
    if (text_in(database, key) == text) return;
    Transaction transaction(database);
    if (lacks_record(database)) begin_record(database);
    put_text(database, key, text);
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
    return text_of_key(project, key_of(which));
}

void store_view(const std::filesystem::path& project, const std::string& text) {
    const Database database(project, OpenMode::Write);
    Transaction transaction(database);
    put_text(database, kView, text);
    transaction.commit();
}

std::string stored_view(const std::filesystem::path& project) {
    return text_of_key(project, kView);
}

}  // namespace vesselbench
