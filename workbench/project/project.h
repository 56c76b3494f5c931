#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "geometry/kernel/progress.h"
#include "workbench/case/edit_record.h"
#include "workbench/case/history.h"
#include "workbench/case/scene.h"
#include "workbench/project/source_file.h"
#include "workbench/project/stored_verdicts.h"

namespace vesselbench {

/// Image voxels up to this size are embedded; larger ones are kept as size and SHA-256 only.
constexpr std::size_t kEmbeddedImageBytes = std::size_t{256} << 20;

/// A result added by a transaction.
struct NewResult {
    const ResultRecord* record = nullptr;
    const Scene* scene = nullptr;  ///< null: the result is stale
    const Scene* input = nullptr;  ///< the scene it was made from
};

/// The additions of one transaction to a project: the difference between two histories, with its
/// data.
struct ProjectChange {
    const History* before = nullptr;
    const History* after = nullptr;
    const EditRecord* edit = nullptr;  ///< of the new edit revision, if there is one
    std::vector<SourceFile> sources;   ///< of the new edit revision
    std::vector<NewResult> results;    ///< each after the results it runs on

    /// The new edit's result is by its author.
    [[nodiscard]] const std::string& author_of(const NewResult& result,
                                               const std::string& others) const {
        return edit != nullptr && result.record->edit == edit->edit ? edit->author : others;
    }
};

/// An entry of the record that stands for something outside the project: an exported file.
struct OutsideEntry {
    std::string kind;     ///< "export"
    std::string subject;  ///< the file's name without its folder
    std::string facts;    ///< a JSON object
};

/// True if a file is a database, as projects are, whatever its name; false if it cannot be read.
[[nodiscard]] bool is_project_file(const std::filesystem::path& path);

struct ChainEntry;
struct RecordCheck;

/// A project file: SQLite in WAL mode, one transaction per change, one writer. Committed changes
/// survive the death of the process at any moment.
class ProjectFile {
public:
    /// \param embed_limit [bytes] see kEmbeddedImageBytes
    /// \param make_room called once no other process can open a project of this path for writing:
    /// it may rename an earlier one
    /// \throw IoError if the file exists, is open elsewhere, or cannot be written
    [[nodiscard]] static ProjectFile create(const std::filesystem::path& path,
                                            std::size_t embed_limit = kEmbeddedImageBytes,
                                            const std::function<void()>& make_room = {});
    /// \throw IoError if it cannot be read, InvalidInput if it is no project, damaged, or newer
    [[nodiscard]] static ProjectFile open(const std::filesystem::path& path,
                                          std::size_t embed_limit = kEmbeddedImageBytes);
    /// The same without the lock, beside whoever writes it; it stays as it is.
    /// \param reason completes "is opened read-only: "
    /// \throw as open()
    [[nodiscard]] static ProjectFile open_to_read(const std::filesystem::path& path,
                                                  const std::string& reason);
    /// A project without a name, in a temporary file.
    [[nodiscard]] static ProjectFile temporary(std::size_t embed_limit = kEmbeddedImageBytes);

    ProjectFile(ProjectFile&&) noexcept;
    ProjectFile& operator=(ProjectFile&&) noexcept;
    ~ProjectFile();

    /// Empty if it is writable.
    [[nodiscard]] const std::string& read_only_reason() const;

    /// The file's name without its folder; empty for a temporary project.
    [[nodiscard]] std::string name() const;

    /// The file's folder; empty for a temporary project.
    [[nodiscard]] std::filesystem::path folder() const;

    /// A lasting random id, which copies share. Empty if the file is of an earlier version and
    /// cannot be written.
    [[nodiscard]] std::string id() const;

    /// The hash of the last entry of the record (chain.h); empty as id().
    [[nodiscard]] std::string record_head() const;

    /// True if an entry of the record has this hash.
    [[nodiscard]] bool has_entry(const std::string& hash) const;

    /// The record's entries, in order, unverified.
    [[nodiscard]] std::vector<ChainEntry> record_entries() const;

    /// As check_record_rows(): without the content of data.
    [[nodiscard]] RecordCheck check_record_rows() const;

    /// Verifies the record and everything stored against it; see record_check.h.
    [[nodiscard]] RecordCheck check_record(const Progress& progress = {}) const;

    /// Who changes the project from now on where a change names no author of its own: removals,
    /// moves through the history, notes, exports.
    void set_author(const std::string& author);

    /// Enters something outside the project into its record. \throw IoError as commit()
    void record(const OutsideEntry& entry);

    /// Enters a reviewer's verdicts, once. \param verdicts their time is that of the call
    /// \param hash SHA-256 of what they say
    /// \return false if these are entered already
    /// \throw IoError as commit()
    bool add_verdicts(const StoredVerdicts& verdicts, const std::string& hash,
                      const OutsideEntry& entry);

    /// The verdicts in the order they were entered.
    /// \throw InvalidInput if one is damaged
    [[nodiscard]] std::vector<StoredVerdicts> verdicts() const;

    [[nodiscard]] History history() const;

    /// The records of one or of several edits or results, by one query.
    /// \throw InvalidInput if one is missing or damaged
    [[nodiscard]] EditRecord edit(EditRef edit) const;
    [[nodiscard]] std::map<EditRef, EditRecord> edits(const std::vector<EditRef>& edits) const;
    [[nodiscard]] std::map<ResultId, ResultRecord> results(
        const std::vector<ResultId>& results) const;

    [[nodiscard]] std::vector<SourceFile> sources(EditRef edit) const;

    /// One transaction. \throw IoError if it cannot be written; the project is then unchanged
    void commit(const ProjectChange& change);

    /// Replaces the note of an edit revision. \throw IoError as commit()
    void set_note(EditRef edit, const std::string& note);

    /// The scene of a result, sharing its parts with the scenes in memory.
    /// \throw InvalidInput if it is damaged, or if a part of it is referenced only and was not
    ///        recalled
    [[nodiscard]] Scene scene(ResultId id, const Progress& progress = {}) const;

    /// SHA-256 of the result's scene, from the stored SHA-256 of its parts. Empty if it has none:
    /// it is stale, or was dropped. \throw InvalidInput if it is damaged
    [[nodiscard]] std::string digest(ResultId id) const;

    /// True if the result's scene contains an image that is only referenced and not in memory.
    [[nodiscard]] bool needs_recall(ResultId id) const;

    /// Offers a scene whose parts replace stored ones that are only referenced, during its
    /// lifetime.
    void recall(const Scene& scene) const;

    /// Names of the parts in which a scene differs from the stored one, bit for bit; empty: none.
    [[nodiscard]] std::vector<std::string> differences(ResultId id, const Scene& scene) const;

    /// What is wrong with stored parts of a result: damaged, or not what their checksum says.
    [[nodiscard]] std::vector<std::string> damages(ResultId id,
                                                   const Progress& progress = {}) const;

    /// Drops the scenes of all other results, and returns the space to the file system. Their
    /// records stay: an edit whose result was dropped is pending there, with what it had resolved.
    /// The history has to be read again. \throw IoError if it cannot be written
    void drop_scenes(const std::set<ResultId>& kept);

    /// After this, the file alone is the whole project, without the write-ahead log beside it.
    /// \throw IoError if it cannot be written, or another process does not end reading it: the edits
    /// are then in the log
    void fold_log() const;

    /// Removes the file while no other process can open it for writing, unless it was replaced. The
    /// object can then only be destroyed.
    void discard();

    /// \throw IoError if the file exists or cannot be written; Cancelled: then there is no file
    void save_as(const std::filesystem::path& path, const Progress& progress = {}) const;

private:
    struct Parts;
    explicit ProjectFile(std::unique_ptr<Parts> parts);
    std::unique_ptr<Parts> parts_;
};

}  // namespace vesselbench
