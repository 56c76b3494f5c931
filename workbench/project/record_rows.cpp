#include "workbench/project/record_rows.h"

#include <iterator>
#include <utility>

#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/plain_name.h"
#include "workbench/case/diagnostic_json.h"
#include "workbench/case/json_fields.h"
#include "workbench/case/json_text.h"
#include "workbench/case/measure_json.h"
#include "workbench/project/compression.h"
#include "workbench/project/stored_text.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

/// What was not measured is left out.
Json stored_change(const SurfaceChange& change) {
    Json json = change_json(change);
    for (auto at = json.begin(); at != json.end();)
        at = at->is_null() ? json.erase(at) : std::next(at);
    return json;
}

Bytes packed_details(const ResultRecord& result) {
    return pack_text(text_from_json(Json({{"resolved", stored_text(result.resolved)},
                                          {"warnings", diagnostics_json(result.warnings)},
                                          {"change", stored_change(result.change)},
                                          {"report", result.report}})));
}

/// Unpacks the texts of a log: all together must be plausible for a file of its size.
class TextBudget {
public:
    explicit TextBudget(const Database& database) : file_(database.bytes()) {}

    /// \throw InvalidInput if the text is damaged, or one too many
    std::string unpack(std::span<const std::byte> blob) {
        constexpr std::uint64_t kLargestLog = std::uint64_t{32} << 20;
        constexpr std::uint64_t kRatio = 250;  // texts compress less than arrays
        std::string text = unpack_text(blob);
        size_ += text.size();
        require_plausible(size_, file_, kLargestLog, kRatio);
        return text;
    }

private:
    std::uint64_t file_;
    std::uint64_t size_ = 0;
};

void unpack_details(std::span<const std::byte> blob, ResultRecord& result, TextBudget& budget) {
    const Json json = json_from_text(budget.unpack(blob), "a result", kLargestStoredJson);
    JsonFields fields(json, "a result");
    result.resolved = arguments_from_stored(fields.required<std::string>("resolved"));
    const Json* warnings = fields.child("warnings");
    result.warnings =
        diagnostics_from(warnings == nullptr ? Json() : *warnings, fields.place_of("warnings"));
    const Json* change = fields.child("change");
    result.change = change_from(change == nullptr ? Json() : *change);
    result.report = fields.required<std::string>("report");
    if (!result.report.empty())  // parsed again by whoever shows it
        JsonFields(json_from_text(result.report, "a report", kLargestStoredJson), "a report");
}

/// Runs a reader of stored data, whose errors then name the file.
template <class Reader>
auto guarded(const Database& database, Reader reader) {
    try {
        return reader();
    } catch (const InvalidInput& error) {
        const std::string text = error.what();  // SQLite's errors name the file already
        throw InvalidInput(
            text.starts_with(database.name()) ? text : database.name() + " is damaged: " + text);
    }
}

constexpr std::int64_t kLargestId = 1'000'000'000;  // leaves room for many more
constexpr std::int64_t kMostRevisions = 1'000'000;
constexpr std::size_t kLongestName = 200;
constexpr std::size_t kLongestPath = 4096;
constexpr std::size_t kLongestText = std::size_t{1} << 20;  // of notes and reasons

std::int64_t number_in(const Statement& row, int column, std::int64_t least, std::int64_t most) {
    const std::int64_t number = row.integer(column);
    if (number < least || number > most)
        throw InvalidInput("a stored number, " + std::to_string(number) + ", is not in [" +
                           std::to_string(least) + ", " + std::to_string(most) + "]");
    return number;
}

std::int64_t id_in(const Statement& row, int column) {
    return number_in(row, column, 0, kLargestId);
}

EditRef edit_ref_in(const Statement& row, int column) {
    return {id_in(row, column), static_cast<int>(number_in(row, column + 1, 0, kMostRevisions))};
}

std::string text_in(const Statement& row, int column, std::size_t longest) {
    if (row.blob(column).size() > longest)
        throw InvalidInput("a stored text is longer than " + std::to_string(longest) + " bytes");
    return row.text(column);
}

EditPlace place_in(const Statement& row, int column) {
    const auto step = number_in(row, column, 1, static_cast<int>(Step::Review));
    std::string variant = text_in(row, column + 1, kLongestName);
    if (!variant.empty()) require_plain_name(variant, "a variant");
    return {static_cast<Step>(step), std::move(variant)};
}

EditRecord edit_from(const Statement& row, TextBudget& budget) {
    EditRecord record;
    record.edit = edit_ref_in(row, 0);
    record.place = place_in(row, 2);
    record.operation = text_in(row, 4, kLongestName);
    record.author = text_in(row, 5, kLongestText);
    record.time = text_in(row, 6, kLongestName);
    record.note = text_in(row, 7, kLongestText);
    record.given = arguments_from_stored(budget.unpack(row.blob(8)));
    return record;
}

ResultRecord result_from(const Statement& row, TextBudget& budget) {
    ResultRecord record;
    record.id = id_in(row, 0);
    record.edit = edit_ref_in(row, 1);
    record.input = id_in(row, 3);
    record.stale_reason = text_in(row, 4, kLongestText);
    record.time = text_in(row, 5, kLongestName);
    record.duration = row.real(6);
    record.program_version = text_in(row, 7, kLongestName);
    record.device = text_in(row, 8, kLongestName);
    unpack_details(row.blob(9), record, budget);
    return record;
}

/// "1,2,3"
template <class Row, class Number>
std::string number_list(const std::vector<Row>& rows, Number number) {
    std::string list;
    for (const Row& row : rows) list += (list.empty() ? "" : ",") + number(row);
    return list;
}

void check_complete(const Database& database, std::size_t found, std::size_t wanted,
                    const char* what) {
    if (found < wanted)
        throw InvalidInput(database.name() + " is damaged: " + what + " is missing");
}

}  // namespace

void insert_edit(const Database& database, const EditRecord& edit) {
    const Bytes given = pack_text(stored_text(edit.given));
    database.prepare("INSERT INTO edits VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?)")
        .bind(0, edit.edit.id)
        .bind(1, std::int64_t{edit.edit.revision})
        .bind(2, static_cast<std::int64_t>(edit.place.step))
        .bind(3, edit.place.variant)
        .bind(4, edit.operation)
        .bind(5, edit.author)
        .bind(6, edit.time)
        .bind(7, edit.note)
        .bind(8, given)
        .step();
}

void update_note(const Database& database, EditRef edit, const std::string& note) {
    database.prepare("UPDATE edits SET note = ? WHERE edit = ? AND revision = ?")
        .bind(0, note)
        .bind(1, edit.id)
        .bind(2, std::int64_t{edit.revision})
        .step();
}

void insert_sources(const Database& database, EditRef edit,
                    const std::vector<SourceFile>& sources) {
    for (const SourceFile& source : sources)
        database.prepare("INSERT INTO sources VALUES(?, ?, ?, ?, ?, ?)")
            .bind(0, edit.id)
            .bind(1, std::int64_t{edit.revision})
            .bind(2, source.parameter)
            .bind(3, source.name)
            .bind(4, source.hash)
            .bind(5, source.place)
            .step();
}

void insert_result(const Database& database, const ResultRecord& result,
                   std::span<const std::byte> scene) {
    const Bytes details = packed_details(result);
    database.prepare("INSERT INTO results VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)")
        .bind(0, result.id)
        .bind(1, result.edit.id)
        .bind(2, std::int64_t{result.edit.revision})
        .bind(3, result.input)
        .bind(4, result.stale_reason)
        .bind(5, result.time)
        .bind(6, result.duration)
        .bind(7, result.program_version)
        .bind(8, result.device)
        .bind(9, details)
        .bind(10, scene)
        .step();
}

std::vector<StateId> write_states(const Database& database, const History& before,
                                  const History& after) {
    std::vector<StateId> written;
    for (const auto& [id, state] : after.states()) {
        const auto old = before.states().find(id);
        const bool is_new = old == before.states().end();
        if (!is_new && old->second.last_child == state.last_child) continue;
        written.push_back(id);
        if (is_new)
            database.prepare("INSERT INTO states VALUES(?, ?, ?, ?, ?, ?)")
                .bind(0, id)
                .bind(1, state.parent)
                .bind(2, static_cast<std::int64_t>(state.change))
                .bind(3, state.edit.id)
                .bind(4, std::int64_t{state.edit.revision})
                .bind(5, state.last_child)
                .step();
        else
            database.prepare("UPDATE states SET last_child = ? WHERE id = ?")
                .bind(0, state.last_child)
                .bind(1, id)
                .step();
    }
    if (before.current() != after.current())
        database.prepare("UPDATE meta SET value = ? WHERE name = 'current'")
            .bind(0, after.current())
            .step();
    return written;
}

namespace {

std::map<EditRef, EditPlace> edit_places(const Database& database) {
    std::map<EditRef, EditPlace> edits;
    for (auto row = database.prepare("SELECT edit, revision, step, variant FROM edits");
         row.step();)
        edits[edit_ref_in(row, 0)] = place_in(row, 2);
    return edits;
}

std::vector<HistoryState> history_states(const Database& database) {
    std::vector<HistoryState> states;
    for (auto row =
             database.prepare("SELECT id, parent, change, edit, revision, last_child FROM states");
         row.step();)
        states.push_back(
            {id_in(row, 0), id_in(row, 1),
             static_cast<StateChange>(number_in(row, 2, 0, static_cast<int>(StateChange::Remove))),
             edit_ref_in(row, 3), id_in(row, 5)});
    return states;
}

std::vector<HistoryResult> history_results(const Database& database) {
    std::vector<HistoryResult> results;
    for (auto row = database.prepare(
             "SELECT id, edit, revision, input, stale, stale = '' AND scene IS NULL FROM results");
         row.step();)
        results.push_back({id_in(row, 0), edit_ref_in(row, 1), id_in(row, 3),
                           text_in(row, 4, kLongestText), row.integer(5) != 0});
    return results;
}

}  // namespace

History read_history(const Database& database) {
    database.run(
        "BEGIN");  // a consistent snapshot of all tables, although another process may write
    History history = guarded(database, [&] {
        auto edits = edit_places(database);
        auto states = history_states(database);
        auto results = history_results(database);
        const StateId current = database.number("SELECT value FROM meta WHERE name = 'current'");
        return History(std::move(edits), std::move(states), std::move(results), current);
    });
    database.run("COMMIT");
    return history;
}

std::map<EditRef, EditRecord> read_edits(const Database& database,
                                         const std::vector<EditRef>& edits) {
    const std::string pairs = number_list(edits, [](EditRef edit) {
        return "(" + std::to_string(edit.id) + "," + std::to_string(edit.revision) + ")";
    });
    TextBudget budget(database);
    std::map<EditRef, EditRecord> records;
    for (auto row = database.prepare(
             "SELECT edit, revision, step, variant, operation, author, time, note, given"
             " FROM edits WHERE (edit, revision) IN (VALUES " +
             (pairs.empty() ? "(0,0)" : pairs) + ")");
         row.step();) {
        EditRecord record = guarded(database, [&] { return edit_from(row, budget); });
        records.emplace(record.edit, std::move(record));
    }
    check_complete(database, records.size(), edits.size(), "an edit");
    return records;
}

std::map<ResultId, ResultRecord> read_results(const Database& database,
                                              const std::vector<ResultId>& results) {
    TextBudget budget(database);
    std::map<ResultId, ResultRecord> records;
    for (auto row = database.prepare(
             "SELECT id, edit, revision, input, stale, time, duration, version, device, details"
             " FROM results WHERE id IN (" +
             number_list(results, [](ResultId id) { return std::to_string(id); }) + ")");
         row.step();) {
        ResultRecord record = guarded(database, [&] { return result_from(row, budget); });
        records.emplace(record.id, std::move(record));
    }
    check_complete(database, records.size(), results.size(), "a result");
    return records;
}

std::vector<SourceFile> read_sources(const Database& database, EditRef edit) {
    Statement row = database.prepare(
        "SELECT parameter, name, hash, place FROM sources WHERE edit = ? AND revision = ?");
    row.bind(0, edit.id).bind(1, std::int64_t{edit.revision});
    std::vector<SourceFile> sources;
    while (row.step())
        sources.push_back(guarded(database, [&] {
            return SourceFile{text_in(row, 0, kLongestName), text_in(row, 1, kLongestPath),
                              text_in(row, 2, kLongestName), text_in(row, 3, kLongestPath)};
        }));
    return sources;
}

}  // namespace vesselbench
