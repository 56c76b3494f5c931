#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "workbench/project/database.h"
#include "workbench/project/part_codec.h"

namespace vesselbench {

using BlobId = std::int64_t;

/// The scene parts of a project: each content is stored once, similar ones as differences, and
/// shared in memory as long as it is in use.
class PartStore {
public:
    /// \param embed_limit [bytes] of image voxels; larger ones are referenced by their hash only
    PartStore(const Database& database, std::size_t embed_limit)
        : database_(&database), embed_limit_(embed_limit) {}

    static void make_table(const Database& database);

    /// Stores a part inside the caller's transaction, unless its content is already stored.
    /// \param base a stored part that may serve as its base
    BlobId store(const ScenePart& part, const std::optional<ScenePart>& base);

    /// \throw InvalidInput if it is damaged, not what its SHA-256 says, or referenced only
    [[nodiscard]] ScenePart load(BlobId id);

    /// The blob of a part in memory that was stored or loaded by this object.
    [[nodiscard]] std::optional<BlobId> known(const ScenePart& part) const;

    [[nodiscard]] std::string hash_of(BlobId id) const;

    /// True if load() would succeed on an undamaged file.
    [[nodiscard]] bool available(BlobId id) const;

    /// Uses the part in place of the stored one with the same content, during its lifetime.
    void recall(const ScenePart& part);

    /// Removes what none of these parts consists of, inside the caller's transaction.
    /// \return what was removed
    std::vector<BlobId> keep_only(std::set<BlobId> parts);

    /// After a rollback: forgets what was stored since.
    void forget_after(BlobId last);
    [[nodiscard]] BlobId last() const;

private:
    struct Held {
        BlobId id = 0;
        std::size_t kind = 0;
        std::weak_ptr<const void> part;
    };

    void hold(BlobId id, const ScenePart& part);
    [[nodiscard]] std::optional<ScenePart> in_memory(BlobId id) const;
    [[nodiscard]] std::optional<BlobId> find(const std::string& hash) const;
    BlobId insert(const ScenePart& part, const std::string& hash,
                  const std::optional<ScenePart>& base);

    const Database* database_;
    std::size_t embed_limit_;
    std::unordered_map<const void*, Held> by_address_;
    std::map<BlobId, Held> by_id_;
};

}  // namespace vesselbench
