#include "workbench/project/project.h"

#include <algorithm>
#include <fstream>
#include <functional>
#include <map>
#include <system_error>
#include <utility>

#include <nlohmann/json.hpp>
#include <unistd.h>

#include "geometry/formats/pending_files.h"
#include "geometry/kernel/errors.h"
#include "workbench/case/version.h"
#include "workbench/project/database.h"
#include "workbench/project/file_lock.h"
#include "workbench/project/part_store.h"
#include "workbench/project/serialization.h"
#include "workbench/project/stored_text.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::int64_t kApplication = 0x56424e43;  // "VBNC", PRAGMA application_id
constexpr std::int64_t kVersion = 1;               // PRAGMA user_version
constexpr const char* kPartNames[] = {"triangles", "positions", "patch labels",
                                      "attribute", "voxels",    "volume mesh"};

void make_tables(const Database& database) {
    database.run(
        "CREATE TABLE meta(name TEXT PRIMARY KEY, value) WITHOUT ROWID;"
        "CREATE TABLE edits(edit INTEGER, revision INTEGER, step INTEGER NOT NULL,"
        " variant TEXT NOT NULL, operation TEXT NOT NULL, author TEXT NOT NULL,"
        " time TEXT NOT NULL, note TEXT NOT NULL, given BLOB NOT NULL,"
        " PRIMARY KEY(edit, revision)) WITHOUT ROWID;"
        "CREATE TABLE states(id INTEGER PRIMARY KEY, parent INTEGER NOT NULL,"
        " change INTEGER NOT NULL, edit INTEGER NOT NULL, revision INTEGER NOT NULL,"
        " last_child INTEGER NOT NULL);"
        "CREATE TABLE results(id INTEGER PRIMARY KEY, edit INTEGER NOT NULL,"
        " revision INTEGER NOT NULL, input INTEGER NOT NULL, stale TEXT NOT NULL,"
        " time TEXT NOT NULL, duration REAL NOT NULL, version TEXT NOT NULL,"
        " device TEXT NOT NULL, details BLOB NOT NULL, scene BLOB);"
        "CREATE TABLE sources(edit INTEGER, revision INTEGER, parameter TEXT, name TEXT NOT NULL,"
        " hash TEXT NOT NULL, place TEXT NOT NULL, PRIMARY KEY(edit, revision, parameter))"
        " WITHOUT ROWID;"
        "INSERT INTO states VALUES(0, 0, 0, 0, 0, 0);"
        "INSERT INTO meta VALUES('current', 0);");
    const std::string program = version();
    database.prepare("INSERT INTO meta VALUES('written by', ?)").bind(0, program).step();
    PartStore::make_table(database);
    database.run("PRAGMA application_id = " + std::to_string(kApplication));
    database.run("PRAGMA user_version = " + std::to_string(kVersion));
}

std::string writer_of(const Database& database) {
    Statement query = database.prepare("SELECT value FROM meta WHERE name = 'written by'");
    return query.step() ? query.text(0) : "?";
}

void check_version(const Database& database) {
    const auto stored = database.number("PRAGMA user_version");
    if (database.number("PRAGMA application_id") != kApplication || stored < 1)
        throw InvalidInput(database.name() + " is not a vesselbench project");
    if (stored > kVersion)
        throw InvalidInput(database.name() + " is a project of version " + std::to_string(stored) +
                           ", written by vesselbench " + writer_of(database) +
                           "; this vesselbench, " + version() + ", reads up to version " +
                           std::to_string(kVersion) + ": use the newer program");
}

Json to_json(const SurfaceChange& change) {
    Json json;
    const auto put = [&](const char* name, const std::optional<double>& value) {
        if (value) json[name] = *value;
    };
    put("volume_before_mm3", change.volume_before);
    put("volume_after_mm3", change.volume_after);
    put("largest_deviation_mm", change.largest_deviation);
    put("mean_deviation_mm", change.mean_deviation);
    json["triangles_before"] = change.triangles_before;
    json["triangles_after"] = change.triangles_after;
    json["moved_vertices"] = change.moved_vertices;
    return json;
}

SurfaceChange change_from(const Json& json) {
    SurfaceChange change;
    const auto get = [&](const char* name) {
        const auto found = json.find(name);
        return found == json.end() || !found->is_number() ? std::nullopt
                                                          : std::optional(found->get<double>());
    };
    change.volume_before = get("volume_before_mm3");
    change.volume_after = get("volume_after_mm3");
    change.largest_deviation = get("largest_deviation_mm");
    change.mean_deviation = get("mean_deviation_mm");
    change.triangles_before = json.at("triangles_before").get<std::size_t>();
    change.triangles_after = json.at("triangles_after").get<std::size_t>();
    change.moved_vertices = json.at("moved_vertices").get<std::size_t>();
    return change;
}

Bytes packed_details(const ResultRecord& result) {
    return pack_text(Json({{"resolved", stored_text(result.resolved)},
                           {"warnings", result.warnings},
                           {"change", to_json(result.change)},
                           {"report", result.report}})
                         .dump(-1, ' ', false, Json::error_handler_t::replace));
}

void unpack_details(std::span<const std::byte> blob, ResultRecord& result) {
    const Json json = Json::parse(unpack_text(blob));
    result.resolved = arguments_from_stored(json.at("resolved").get<std::string>());
    result.warnings = json.at("warnings").get<std::vector<std::string>>();
    result.change = change_from(json.at("change"));
    result.report = json.at("report").get<std::string>();
}

/// Runs a reader of stored JSON. \throw InvalidInput instead of the JSON library's errors
template <class Reader>
auto guarded(const Database& database, Reader reader) {
    try {
        return reader();
    } catch (const Json::exception& error) {
        throw InvalidInput(database.name() + " is damaged: " + error.what());
    }
}

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

void insert_result(const Database& database, const ResultRecord& result, const Bytes& scene) {
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

void write_states(const Database& database, const History& before, const History& after) {
    for (const auto& [id, state] : after.states()) {
        const auto old = before.states().find(id);
        if (old == before.states().end())
            database.prepare("INSERT INTO states VALUES(?, ?, ?, ?, ?, ?)")
                .bind(0, id)
                .bind(1, state.parent)
                .bind(2, static_cast<std::int64_t>(state.change))
                .bind(3, state.edit.id)
                .bind(4, std::int64_t{state.edit.revision})
                .bind(5, state.last_child)
                .step();
        else if (old->second.last_child != state.last_child)
            database.prepare("UPDATE states SET last_child = ? WHERE id = ?")
                .bind(0, state.last_child)
                .bind(1, id)
                .step();
    }
    if (before.current() != after.current())
        database.prepare("UPDATE meta SET value = ? WHERE name = 'current'")
            .bind(0, after.current())
            .step();
}

/// A stored scene: the blobs of its parts, and its manifest.
struct SceneRow {
    std::vector<BlobId> blobs;
    Bytes manifest;
};

Bytes pack(const SceneRow& row) {
    ByteWriter writer;
    writer.put<std::uint64_t>(row.blobs.size());
    for (const BlobId id : row.blobs) writer.put(id);
    writer.append(row.manifest);
    return writer.take();
}

SceneRow unpack_scene_row(std::span<const std::byte> bytes) {
    ByteReader reader(bytes);
    SceneRow row;
    for (auto left = reader.get<std::uint64_t>(); left > 0; --left)
        row.blobs.push_back(reader.get<BlobId>());
    const auto rest = reader.get_bytes(reader.left());
    row.manifest.assign(rest.begin(), rest.end());
    return row;
}

/// For each new part of a scene, in order, the part of its kind that it replaced.
std::vector<std::optional<ScenePart>> bases_of(const std::vector<ScenePart>& parts,
                                               const Scene* input) {
    std::vector<std::optional<ScenePart>> bases(parts.size());
    if (input == nullptr) return bases;
    const std::vector<ScenePart> old = take_apart(*input).parts;
    const auto holds = [](const std::vector<ScenePart>& list, const ScenePart& part) {
        return std::any_of(list.begin(), list.end(),
                           [&](const auto& p) { return identity(p) == identity(part); });
    };
    std::map<std::size_t, std::vector<ScenePart>> replaced;
    for (auto part = old.rbegin(); part != old.rend(); ++part)
        if (!holds(parts, *part)) replaced[part->index()].push_back(*part);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        auto& candidates = replaced[parts[i].index()];
        if (candidates.empty() || holds(old, parts[i])) continue;
        bases[i] = candidates.back();
        candidates.pop_back();
    }
    return bases;
}

SceneRow store_scene(PartStore& store, const Scene& scene, const Scene* input) {
    SceneParts taken = take_apart(scene);
    SceneRow row;
    const auto bases = bases_of(taken.parts, input);
    for (std::size_t i = 0; i < taken.parts.size(); ++i)
        row.blobs.push_back(store.store(taken.parts[i], bases[i]));
    row.manifest = std::move(taken.manifest);
    return row;
}

/// \throw IoError if that cannot be told
bool missing(const std::filesystem::path& path) {
    std::error_code error;
    const bool there = std::filesystem::exists(path, error);
    if (error) throw IoError("cannot reach " + path.filename().string() + ": " + error.message());
    return !there;
}

/// Has a file written under another name, then renames it: nobody sees half of it, and a file that
/// is there stays.
void write_whole(const std::filesystem::path& path,
                 const std::function<void(const std::filesystem::path&)>& write) {
    const std::string name = path.filename().string();
    if (!missing(path))
        throw IoError(name + " exists already; choose another name or remove it first");
    PendingFiles files;
    write(files.add(path));
    files.commit(Existing::Keep);
}

}  // namespace

struct ProjectFile::Parts {
    std::filesystem::path path;
    std::string read_only_reason;
    std::unique_ptr<FileLock> lock;
    Database database;
    PartStore store;

    Parts(std::filesystem::path p, OpenMode mode, std::size_t embed_limit)
        : path(std::move(p)), database(path, mode), store(database, embed_limit) {}

    /// The opened file, read once: an unusable file shows here.
    static std::unique_ptr<Parts> open(const std::filesystem::path& path, OpenMode mode,
                                       std::size_t embed_limit) {
        auto parts = std::make_unique<Parts>(path, mode, embed_limit);
        check_version(parts->database);
        return parts;
    }

    [[nodiscard]] SceneRow scene_row(ResultId id) const {
        Statement query = database.prepare("SELECT scene FROM results WHERE id = ?");
        query.bind(0, id);
        if (!query.step())
            throw InvalidInput(database.name() + " is damaged: result " + std::to_string(id) +
                               " is missing");
        return unpack_scene_row(query.blob(0));
    }
};

ProjectFile::ProjectFile(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}

ProjectFile::ProjectFile(ProjectFile&&) noexcept = default;
ProjectFile& ProjectFile::operator=(ProjectFile&&) noexcept = default;
ProjectFile::~ProjectFile() = default;

ProjectFile ProjectFile::create(const std::filesystem::path& path, std::size_t embed_limit) {
    write_whole(path, [](const std::filesystem::path& unfinished) {
        make_tables(Database(unfinished, OpenMode::Create));
    });
    return open(path, embed_limit);
}

ProjectFile ProjectFile::open(const std::filesystem::path& path, std::size_t embed_limit) {
    const std::string name = path.filename().string();
    if (missing(path)) throw IoError(name + " does not exist");
    if (!std::filesystem::is_regular_file(path)) throw InvalidInput(name + " is not a file");
    if (access(path.c_str(), R_OK) != 0) throw IoError("cannot read " + name + ": no permission");
    FileLock::Attempt attempt;
    if (access(path.c_str(), W_OK) != 0)
        attempt.reason = "it cannot be written";
    else
        attempt = FileLock::acquire(path);
    std::unique_ptr<Parts> parts;
    if (attempt.lock) {
        parts = Parts::open(path, OpenMode::Write, embed_limit);
        parts->database.run("PRAGMA journal_mode = WAL");
        parts->database.run("PRAGMA synchronous = FULL");
        parts->database.run("PRAGMA journal_size_limit = 16777216");
    } else {
        try {
            parts = Parts::open(path, OpenMode::Read, embed_limit);
        } catch (const IoError&) {
            // WAL mode needs to write beside the file even to read it; without a log of unfinished
            // changes, the file alone is complete.
            std::filesystem::path log = path;
            log += "-wal";
            if (!missing(log) && std::filesystem::file_size(log) > 0) throw;
            parts = Parts::open(path, OpenMode::Frozen, embed_limit);
        }
        parts->read_only_reason = name + " can only be read: " + attempt.reason;
    }
    parts->lock = std::move(attempt.lock);
    return ProjectFile(std::move(parts));
}

ProjectFile ProjectFile::temporary(std::size_t embed_limit) {
    auto parts = std::make_unique<Parts>("", OpenMode::Temporary, embed_limit);
    make_tables(parts->database);
    return ProjectFile(std::move(parts));
}

const std::string& ProjectFile::read_only_reason() const {
    return parts_->read_only_reason;
}

std::filesystem::path ProjectFile::folder() const {
    if (parts_->path.empty()) return {};
    return std::filesystem::absolute(parts_->path).parent_path();
}

History ProjectFile::history() const {
    const Database& database = parts_->database;
    database.run("BEGIN");  // all tables as of one moment, though another process may write
    std::map<EditRef, EditPlace> edits;
    for (auto row = database.prepare("SELECT edit, revision, step, variant FROM edits");
         row.step();)
        edits[{row.integer(0), static_cast<int>(row.integer(1))}] = {
            static_cast<Step>(row.integer(2)), row.text(3)};
    std::vector<HistoryState> states;
    for (auto row =
             database.prepare("SELECT id, parent, change, edit, revision, last_child FROM states");
         row.step();)
        states.push_back({row.integer(0),
                          row.integer(1),
                          static_cast<StateChange>(row.integer(2)),
                          {row.integer(3), static_cast<int>(row.integer(4))},
                          row.integer(5)});
    std::vector<HistoryResult> results;
    for (auto row = database.prepare("SELECT id, edit, revision, input, stale FROM results");
         row.step();)
        results.push_back({row.integer(0),
                           {row.integer(1), static_cast<int>(row.integer(2))},
                           row.integer(3),
                           row.text(4)});
    const StateId current = database.number("SELECT value FROM meta WHERE name = 'current'");
    database.run("COMMIT");
    try {
        return {std::move(edits), std::move(states), std::move(results), current};
    } catch (const InvalidInput& error) {
        throw InvalidInput(database.name() + " is damaged: " + error.what());
    }
}

EditRecord ProjectFile::edit(EditRef edit) const {
    Statement row = parts_->database.prepare(
        "SELECT step, variant, operation, author, time, note, given FROM edits"
        " WHERE edit = ? AND revision = ?");
    row.bind(0, edit.id).bind(1, std::int64_t{edit.revision});
    if (!row.step())
        throw InvalidInput(parts_->database.name() + " is damaged: an edit is missing");
    EditRecord record;
    record.edit = edit;
    record.place = {static_cast<Step>(row.integer(0)), row.text(1)};
    record.operation = row.text(2);
    record.author = row.text(3);
    record.time = row.text(4);
    record.note = row.text(5);
    record.given = arguments_from_stored(unpack_text(row.blob(6)));
    return record;
}

ResultRecord ProjectFile::result(ResultId id) const {
    Statement row = parts_->database.prepare(
        "SELECT edit, revision, input, stale, time, duration, version, device, details"
        " FROM results WHERE id = ?");
    row.bind(0, id);
    if (!row.step())
        throw InvalidInput(parts_->database.name() + " is damaged: a result is missing");
    ResultRecord record;
    record.id = id;
    record.edit = {row.integer(0), static_cast<int>(row.integer(1))};
    record.input = row.integer(2);
    record.stale_reason = row.text(3);
    record.time = row.text(4);
    record.duration = row.real(5);
    record.program_version = row.text(6);
    record.device = row.text(7);
    guarded(parts_->database, [&] { unpack_details(row.blob(8), record); });
    return record;
}

std::vector<SourceFile> ProjectFile::sources(EditRef edit) const {
    Statement row = parts_->database.prepare(
        "SELECT parameter, name, hash, place FROM sources WHERE edit = ? AND revision = ?");
    row.bind(0, edit.id).bind(1, std::int64_t{edit.revision});
    std::vector<SourceFile> sources;
    while (row.step()) sources.push_back({row.text(0), row.text(1), row.text(2), row.text(3)});
    return sources;
}

void ProjectFile::commit(const ProjectChange& change) {
    if (!parts_->read_only_reason.empty()) throw IoError(parts_->read_only_reason);
    const Database& database = parts_->database;
    const BlobId last = parts_->store.last();
    try {
        Transaction transaction(database);
        write_states(database, *change.before, *change.after);
        if (change.edit != nullptr) insert_edit(database, *change.edit);
        if (change.result != nullptr) {
            Bytes row;
            if (change.scene != nullptr)
                row = pack(store_scene(parts_->store, *change.scene, change.input));
            insert_result(database, *change.result, row);
        }
        if (change.edit != nullptr) insert_sources(database, change.edit->edit, change.sources);
        transaction.commit();
    } catch (...) {
        parts_->store.forget_after(last);
        throw;
    }
}

Scene ProjectFile::scene(ResultId id) const {
    if (id == 0) return {};
    const SceneRow row = parts_->scene_row(id);
    std::vector<ScenePart> parts;
    for (const BlobId blob : row.blobs) parts.push_back(parts_->store.load(blob));
    return put_together(row.manifest, parts);
}

bool ProjectFile::needs_recall(ResultId id) const {
    if (id == 0) return false;
    const SceneRow row = parts_->scene_row(id);
    return !std::all_of(row.blobs.begin(), row.blobs.end(),
                        [&](BlobId blob) { return parts_->store.available(blob); });
}

void ProjectFile::recall(const Scene& scene) const {
    for (const ScenePart& part : take_apart(scene).parts) parts_->store.recall(part);
}

std::vector<std::string> ProjectFile::differences(ResultId id, const Scene& scene) const {
    const SceneRow row = parts_->scene_row(id);
    const SceneParts taken = take_apart(scene);
    std::vector<std::string> names;
    if (taken.manifest != row.manifest) names.emplace_back("patches, grid or kinds of data");
    for (std::size_t i = 0; i < taken.parts.size(); ++i) {
        const ScenePart& part = taken.parts[i];
        if (i < row.blobs.size() && (parts_->store.known(part) == row.blobs[i] ||
                                     content_hash(part) == parts_->store.hash_of(row.blobs[i])))
            continue;
        names.emplace_back(kPartNames[part.index()]);
    }
    if (taken.parts.size() < row.blobs.size()) names.emplace_back("missing data");
    return names;
}

std::vector<std::string> ProjectFile::damages(ResultId id) const {
    std::vector<std::string> names;
    for (const BlobId blob : parts_->scene_row(id).blobs) {
        const ScenePart part = parts_->store.load(blob);
        if (content_hash(part) != parts_->store.hash_of(blob))
            names.emplace_back(std::string(kPartNames[part.index()]) + " (stored checksum)");
    }
    return names;
}

void ProjectFile::save_as(const std::filesystem::path& path) const {
    write_whole(path, [&](const std::filesystem::path& unfinished) {
        Statement copy = parts_->database.prepare("VACUUM INTO ?");
        const std::string name = unfinished.string();
        copy.bind(0, name).step();
    });
}

bool is_project_file(const std::filesystem::path& path) {
    constexpr std::string_view kHeader = "SQLite format 3";
    std::string head(kHeader.size(), ' ');
    std::ifstream file(path, std::ios::binary);
    file.read(head.data(), static_cast<std::streamsize>(head.size()));
    return file && head == kHeader;
}

}  // namespace vesselbench
