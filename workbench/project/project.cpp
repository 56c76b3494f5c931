#include "workbench/project/project.h"

#include <algorithm>
#include <fstream>
#include <functional>
#include <map>
#include <system_error>
#include <utility>

#include <unistd.h>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/pending_files.h"
#include "geometry/kernel/regular_file.h"
#include "workbench/project/chain_entries.h"
#include "workbench/project/compression.h"
#include "workbench/project/database.h"
#include "workbench/project/file_lock.h"
#include "workbench/project/part_store.h"
#include "workbench/project/record_check.h"
#include "workbench/project/record_rows.h"
#include "workbench/project/scene_rows.h"
#include "workbench/project/schema.h"
#include "workbench/project/serialization.h"
#include "workbench/project/verdict_rows.h"

namespace vesselbench {

namespace {

/// [bytes] of a scene's parts: an embedded image and its mask take half of it.
constexpr std::uint64_t kLargestScene = std::uint64_t{1} << 30;

/// \throw IoError if there is a file
void require_missing(const std::filesystem::path& path) {
    if (file_exists(path))
        throw IoError(path.filename().string() +
                      " already exists; choose another name or remove it first");
}

/// \throw IoError, InvalidInput unless it is a file that can be read
void require_readable(const std::filesystem::path& path) {
    const std::string name = path.filename().string();
    if (!file_exists(path)) throw IoError(name + " does not exist");
    if (!std::filesystem::is_regular_file(path)) throw InvalidInput(name + " is not a file");
    if (access(path.c_str(), R_OK) != 0) throw IoError("cannot read " + name + ": no permission");
}

/// Removes what SQLite keeps beside a project. The log of a project that was deleted after a crash
/// would be replayed into a new one of the same name.
void remove_companions(const std::filesystem::path& project) {
    for (const char* suffix : {"-wal", "-shm"}) {
        std::filesystem::path companion = project;
        std::error_code error;  // where nothing can be removed, nothing can be written either
        std::filesystem::remove(companion += suffix, error);
    }
}

/// Gives a project written under another name its own: nobody sees a partial file, and an existing
/// file is kept.
void name_new_project(const std::filesystem::path& path, PendingFiles& files) {
    require_missing(path);
    remove_companions(path);
    files.commit(Existing::Keep);
}

/// Lets a read-only connection write a copy, which SQLite's query_only refuses as well.
class CopyingAllowed {
public:
    CopyingAllowed(const Database& database, bool read_only)
        : database_(database), read_only_(read_only) {
        if (read_only_) database_.run("PRAGMA query_only = OFF");
    }

    ~CopyingAllowed() {
        if (read_only_) try {
                database_.run("PRAGMA query_only = ON");
            } catch (const std::exception&) {  // the caller reports what broke the connection
            }
    }

    CopyingAllowed(const CopyingAllowed&) = delete;
    CopyingAllowed& operator=(const CopyingAllowed&) = delete;

private:
    const Database& database_;
    bool read_only_;
};

}  // namespace

struct ProjectFile::Parts {
    std::filesystem::path path;
    std::string read_only_reason;
    std::string author;
    std::unique_ptr<FileLock> lock;
    Database database;
    PartStore store;

    Parts(std::filesystem::path p, OpenMode mode, std::size_t embed_limit)
        : path(std::move(p)), database(path, mode), store(database, embed_limit) {}

    /// The opened file, read once: an unusable file is detected here.
    static std::unique_ptr<Parts> open(const std::filesystem::path& path, OpenMode mode,
                                       std::size_t embed_limit) {
        auto parts = std::make_unique<Parts>(path, mode, embed_limit);
        check_version(parts->database);
        check_tables(parts->database);
        return parts;
    }

    static std::unique_ptr<Parts> open_to_write(const std::filesystem::path& path,
                                                std::size_t embed_limit,
                                                std::unique_ptr<FileLock> lock) {
        auto parts = open(path, OpenMode::Write, embed_limit);
        parts->database.run("PRAGMA journal_mode = WAL");
        parts->database.run("PRAGMA synchronous = FULL");
        parts->database.run("PRAGMA journal_size_limit = 16777216");
        parts->lock = std::move(lock);
        return parts;
    }

    static std::unique_ptr<Parts> open_to_read(const std::filesystem::path& path,
                                               std::size_t embed_limit, const std::string& reason) {
        std::unique_ptr<Parts> parts;
        try {
            parts = open(path, OpenMode::Read, embed_limit);
        } catch (const IoError&) {
            // WAL mode writes beside the file even for reading; without a log of unfinished
            // changes, the file alone is complete.
            std::filesystem::path log = path;
            log += "-wal";
            if (file_exists(log) && std::filesystem::file_size(log) > 0) throw;
            parts = open(path, OpenMode::Frozen, embed_limit);
        }
        parts->read_only_reason = path.filename().string() + " is opened read-only: " + reason;
        return parts;
    }

    /// Gives a project of an earlier version its record.
    void require_record() const {
        if (!lacks_record(database)) return;
        Transaction transaction(database);
        begin_record(database);
        transaction.commit();
    }

    /// \throw IoError if nothing can be written, or would be lost
    void check_writable() const {
        if (!read_only_reason.empty()) throw IoError(read_only_reason);
        if (!path.empty() && database.has_moved())
            throw IoError(database.name() +
                          " was deleted, moved or replaced while it was open: the last change is "
                          "lost; open it again where it is now");
    }

    /// \throw InvalidInput if the file is too small for contents of this size
    void check_plausible(std::uint64_t size, std::uint64_t free) const {
        if (path.empty() || size <= free) return;
        try {
            require_plausible(size, database.bytes(), free);
        } catch (const InvalidInput& error) {
            throw InvalidInput(database.name() + ": " + error.what());
        }
    }

    /// Stores and records a result inside the caller's transaction.
    void add_result(const NewResult& result, const std::string& by) {
        const BlobId last = store.last();
        Bytes packed;
        std::string digest;
        if (result.scene != nullptr) {
            const SceneRow row = store_scene(store, *result.scene, result.input);
            digest = scene_digest(store, row);
            packed = pack(row);
        }
        insert_result(database, *result.record, packed);
        enter_result(database, *result.record, digest, last, by);
    }

    [[nodiscard]] NewEntry entry_of(const OutsideEntry& entry) const {
        return {.kind = entry.kind,
                .subject = entry.subject,
                .author = author,
                .facts = nlohmann::json::parse(entry.facts),
                .rows = {},
                .gone = {}};
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

ProjectFile ProjectFile::create(const std::filesystem::path& path, std::size_t embed_limit,
                                const std::function<void()>& make_room) {
    PendingFiles files;
    make_tables(Database(files.add(path), OpenMode::Create));
    FileLock::Attempt attempt = FileLock::acquire(path);
    if (!attempt.lock)
        throw IoError(path.filename().string() + " cannot be created: " + attempt.reason);
    if (make_room) make_room();
    name_new_project(path, files);
    return ProjectFile(Parts::open_to_write(path, embed_limit, std::move(attempt.lock)));
}

ProjectFile ProjectFile::open_to_read(const std::filesystem::path& path,
                                      const std::string& reason) {
    require_readable(path);
    return ProjectFile(Parts::open_to_read(path, kEmbeddedImageBytes, reason));
}

ProjectFile ProjectFile::open(const std::filesystem::path& path, std::size_t embed_limit) {
    require_readable(path);
    FileLock::Attempt attempt;
    if (access(path.c_str(), W_OK) != 0)
        attempt.reason = "it cannot be written";
    else
        attempt = FileLock::acquire(path);
    if (!attempt.lock) return ProjectFile(Parts::open_to_read(path, embed_limit, attempt.reason));
    std::unique_ptr<Parts> parts;
    try {
        parts = Parts::open_to_write(path, embed_limit, std::move(attempt.lock));
        parts->require_record();
    } catch (const IoError& error) {  // a full disk, for one: it can still be read
        parts.reset();
        return ProjectFile(Parts::open_to_read(path, embed_limit, error.what()));
    }
    remove_abandoned(path.has_parent_path() ? path.parent_path() : ".");
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

std::string ProjectFile::name() const {
    return parts_->path.filename().string();
}

std::filesystem::path ProjectFile::folder() const {
    if (parts_->path.empty()) return {};
    return std::filesystem::absolute(parts_->path).parent_path();
}

History ProjectFile::history() const {
    return read_history(parts_->database);
}

EditRecord ProjectFile::edit(EditRef edit) const {
    return edits({edit}).begin()->second;
}

std::map<EditRef, EditRecord> ProjectFile::edits(const std::vector<EditRef>& edits) const {
    return read_edits(parts_->database, edits);
}

std::map<ResultId, ResultRecord> ProjectFile::results(const std::vector<ResultId>& results) const {
    return read_results(parts_->database, results);
}

std::vector<SourceFile> ProjectFile::sources(EditRef edit) const {
    return read_sources(parts_->database, edit);
}

void ProjectFile::commit(const ProjectChange& change) {
    parts_->check_writable();
    const Database& database = parts_->database;
    const BlobId last = parts_->store.last();
    try {
        Transaction transaction(database);
        const auto states = write_states(database, *change.before, *change.after);
        if (change.edit != nullptr) {
            insert_edit(database, *change.edit);
            insert_sources(database, change.edit->edit, change.sources);
        }
        enter_change(database, *change.before, *change.after, change.edit, states, parts_->author);
        for (const NewResult& result : change.results)
            parts_->add_result(result, change.author_of(result, parts_->author));
        transaction.commit();
        parts_->check_writable();  // it may have gone meanwhile
    } catch (...) {
        parts_->store.forget_after(last);
        throw;
    }
}

void ProjectFile::set_note(EditRef edit, const std::string& note) {
    parts_->check_writable();
    const Database& database = parts_->database;
    Transaction transaction(database);
    update_note(database, edit, note);
    enter_note(database, edit, note, parts_->author);
    transaction.commit();
}

std::string ProjectFile::id() const {
    return project_id(parts_->database);
}

std::string ProjectFile::record_head() const {
    return chain_head(parts_->database);
}

bool ProjectFile::has_entry(const std::string& hash) const {
    return vesselbench::has_entry(parts_->database, hash);
}

std::vector<ChainEntry> ProjectFile::record_entries() const {
    return read_chain(parts_->database);
}

RecordCheck ProjectFile::check_record_rows() const {
    return vesselbench::check_record_rows(parts_->database);
}

RecordCheck ProjectFile::check_record(const Progress& progress) const {
    return vesselbench::check_record(parts_->database, progress);
}

void ProjectFile::set_author(const std::string& author) {
    parts_->author = author;
}

void ProjectFile::record(const OutsideEntry& entry) {
    parts_->check_writable();
    Transaction transaction(parts_->database);
    append_entry(parts_->database, parts_->entry_of(entry));
    transaction.commit();
}

bool ProjectFile::add_verdicts(const StoredVerdicts& verdicts, const std::string& hash,
                               const OutsideEntry& entry) {
    parts_->check_writable();
    Transaction transaction(parts_->database);
    const bool are_new = insert_verdicts(parts_->database, verdicts, hash, parts_->entry_of(entry));
    transaction.commit();
    return are_new;
}

std::vector<StoredVerdicts> ProjectFile::verdicts() const {
    return read_verdicts(parts_->database);
}

std::string ProjectFile::digest(ResultId id) const {
    Statement query = parts_->database.prepare("SELECT scene FROM results WHERE id = ?");
    query.bind(0, id);
    if (!query.step() || query.blob(0).empty()) return "";
    return scene_digest(parts_->store, unpack_scene_row(query.blob(0)));
}

Scene ProjectFile::scene(ResultId id, const Progress& progress) const {
    if (id == 0) return {};
    const SceneRow row = parts_->scene_row(id);
    std::vector<ScenePart> parts;
    std::set<const void*> counted;
    std::uint64_t size = 0;
    for (const BlobId blob : row.blobs) {
        progress.check_cancelled();
        parts.push_back(parts_->store.load(blob));
        if (counted.insert(identity(parts.back())).second) size += memory_bytes(parts.back());
        parts_->check_plausible(size, kLargestScene);
    }
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
    return vesselbench::differences(parts_->store, parts_->scene_row(id), scene);
}

std::vector<std::string> ProjectFile::damages(ResultId id, const Progress& progress) const {
    return vesselbench::damages(parts_->store, parts_->scene_row(id), progress);
}

void ProjectFile::drop_scenes(const std::set<ResultId>& kept) {
    parts_->check_writable();
    const Database& database = parts_->database;
    const History before = history();
    {
        Transaction transaction(database);
        std::set<BlobId> used;
        std::vector<ResultId> dropped;
        for (const auto& [id, result] : before.results()) {
            if (result.dropped || !result.stale_reason.empty()) continue;
            if (kept.contains(id))
                for (const BlobId blob : parts_->scene_row(id).blobs) used.insert(blob);
            else
                dropped.push_back(id);
        }
        for (const ResultId id : dropped)
            database.prepare("UPDATE results SET scene = NULL WHERE id = ?").bind(0, id).step();
        const std::vector<BlobId> gone = parts_->store.keep_only(std::move(used));
        enter_compaction(database, dropped, gone, parts_->author);
        transaction.commit();
    }
    database.run("VACUUM");
    database.fold_log();
}

void ProjectFile::fold_log() const {
    if (parts_->path.empty()) return;
    parts_->check_writable();
    const std::string log = name() + "-wal";
    try {
        if (parts_->database.fold_log()) return;
    } catch (const IoError& error) {
        throw IoError("the last edits are in " + log + " only: " + error.what());
    }
    throw IoError("the last edits are in " + log + " only: another program is reading " + name() +
                  "; close it there, and keep both files together until then");
}

void ProjectFile::discard() {
    if (parts_->path.empty() || !parts_->lock || parts_->database.has_moved()) return;
    remove_companions(parts_->path);
    std::error_code ignored;
    std::filesystem::remove(parts_->path, ignored);
}

void ProjectFile::save_as(const std::filesystem::path& path, const Progress& progress) const {
    require_missing(path);
    progress.check_cancelled();
    PendingFiles files;
    {
        const CopyingAllowed allowed(parts_->database, !parts_->read_only_reason.empty());
        const Interruptible copying(parts_->database, progress);
        Statement copy = parts_->database.prepare("VACUUM INTO ?");
        const std::string name = files.add(path).string();
        std::ofstream(name, std::ios::app);  // as the umask allows; SQLite takes an empty file
        copy.bind(0, name).step();
    }
    name_new_project(path, files);
}

bool is_project_file(const std::filesystem::path& path) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) return false;
    constexpr std::string_view kHeader = "SQLite format 3";
    std::string head(kHeader.size(), ' ');
    std::ifstream file(path, std::ios::binary);
    file.read(head.data(), static_cast<std::streamsize>(head.size()));
    return file && head == kHeader;
}

}  // namespace vesselbench
