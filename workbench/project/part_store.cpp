#include "workbench/project/part_store.h"

#include <utility>

#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

constexpr std::size_t kVoxels = 4;  // of ScenePart's alternatives

template <std::size_t I = 0>
ScenePart part_of(std::size_t kind, const std::shared_ptr<const void>& part) {
    if constexpr (I + 1 < std::variant_size_v<ScenePart>)
        if (kind != I) return part_of<I + 1>(kind, part);
    using Shared = std::variant_alternative_t<I, ScenePart>;
    return std::static_pointer_cast<typename Shared::element_type>(part);
}

std::shared_ptr<const void> shared(const ScenePart& part) {
    return std::visit([](const auto& p) { return std::shared_ptr<const void>(p); }, part);
}

}  // namespace

void PartStore::make_table(const Database& database) {
    database.run(
        "CREATE TABLE blobs(id INTEGER PRIMARY KEY, hash TEXT NOT NULL UNIQUE,"
        " base INTEGER, content BLOB)");
}

void PartStore::hold(BlobId id, const ScenePart& part) {
    const Held held{id, part.index(), shared(part)};
    by_address_[identity(part)] = held;
    by_id_[id] = held;
}

std::optional<ScenePart> PartStore::in_memory(BlobId id) const {
    const auto found = by_id_.find(id);
    if (found == by_id_.end()) return std::nullopt;
    const auto alive = found->second.part.lock();
    return alive ? std::optional(part_of(found->second.kind, alive)) : std::nullopt;
}

std::optional<BlobId> PartStore::known(const ScenePart& part) const {
    const auto found = by_address_.find(identity(part));
    // The address may belong to a part that no longer exists.
    if (found == by_address_.end() || found->second.part.expired() ||
        found->second.kind != part.index())
        return std::nullopt;
    return found->second.id;
}

std::optional<BlobId> PartStore::find(const std::string& hash) const {
    Statement query = database_->prepare("SELECT id FROM blobs WHERE hash = ?");
    query.bind(0, hash);
    return query.step() ? std::optional(query.integer(0)) : std::nullopt;
}

BlobId PartStore::store(const ScenePart& part, const std::optional<ScenePart>& base) {
    if (const auto id = known(part)) return *id;
    const std::string hash = content_hash(part);
    const auto stored = find(hash);
    const BlobId id = stored ? *stored : insert(part, hash, base);
    hold(id, part);
    return id;
}

BlobId PartStore::insert(const ScenePart& part, const std::string& hash,
                         const std::optional<ScenePart>& base) {
    const bool embedded = part.index() != kVoxels || memory_bytes(part) <= embed_limit_;
    BlobId base_id = base ? known(*base).value_or(0) : 0;
    std::optional<Bytes> content;
    if (embedded && base_id != 0 && available(base_id)) content = encode_difference(part, *base);
    if (!content) base_id = 0;
    if (embedded && !content) content = encode(part, Compression::Zstd);

    Statement insert =
        database_->prepare("INSERT INTO blobs(hash, base, content) VALUES(?, ?, ?) RETURNING id");
    insert.bind(0, hash);
    if (base_id != 0) insert.bind(1, base_id);
    if (content) insert.bind(2, std::span<const std::byte>(*content));
    insert.step();
    const BlobId id = insert.integer(0);
    insert.step();  // to its end, else the statement stays open
    return id;
}

ScenePart PartStore::load(BlobId id) {
    if (auto part = in_memory(id)) return *part;
    // Down the chain of differences to a whole blob or a part in memory, then up again.
    std::vector<Bytes> differences;
    std::optional<PartDecoder> decoder;
    for (BlobId at = id; !decoder;) {
        if (const auto part = in_memory(at)) {
            decoder.emplace(*part);
            break;
        }
        Statement query = database_->prepare("SELECT base, content FROM blobs WHERE id = ?");
        query.bind(0, at);
        if (!query.step() || query.is_null(1))
            throw InvalidInput(database_->name() + " lacks part of this state's data");
        const auto content = query.blob(1);
        if (query.is_null(0)) {
            decoder.emplace(content);
        } else {
            differences.emplace_back(content.begin(), content.end());
            if (query.integer(0) >= at)
                throw InvalidInput(database_->name() + " is damaged: a part is based on itself");
            at = query.integer(0);
        }
    }
    for (; !differences.empty(); differences.pop_back())
        decoder->apply_difference(differences.back());
    ScenePart part = decoder->finish();
    // What a blob says of itself proves nothing: the row of another blob may stand in its place.
    if (content_hash(part) != hash_of(id))
        throw InvalidInput(database_->name() + " is damaged: its " + part_words(part) +
                           ": not the content of the SHA-256 that is stored");
    hold(id, part);
    return part;
}

std::string PartStore::hash_of(BlobId id) const {
    Statement query = database_->prepare("SELECT hash FROM blobs WHERE id = ?");
    query.bind(0, id);
    return query.step() ? query.text(0) : std::string();
}

bool PartStore::available(BlobId id) const {
    if (in_memory(id)) return true;
    Statement query = database_->prepare("SELECT content IS NULL FROM blobs WHERE id = ?");
    query.bind(0, id);
    return query.step() && query.integer(0) == 0;
}

void PartStore::recall(const ScenePart& part) {
    if (known(part)) return;
    if (const auto id = find(content_hash(part))) hold(*id, part);
}

std::vector<BlobId> PartStore::keep_only(std::set<BlobId> parts) {
    // A base is older than what differs from it: from the newest on, one pass finds all.
    Statement row = database_->prepare("SELECT id, base FROM blobs ORDER BY id DESC");
    std::vector<BlobId> unused;
    while (row.step()) {
        if (!parts.contains(row.integer(0)))
            unused.push_back(row.integer(0));
        else if (!row.is_null(1))
            parts.insert(row.integer(1));
    }
    for (const BlobId id : unused)
        database_->prepare("DELETE FROM blobs WHERE id = ?").bind(0, id).step();
    forget_after(0);
    return unused;
}

BlobId PartStore::last() const {
    return database_->number("SELECT coalesce(max(id), 0) FROM blobs");
}

void PartStore::forget_after(BlobId last) {
    std::erase_if(by_address_, [&](const auto& entry) { return entry.second.id > last; });
    std::erase_if(by_id_, [&](const auto& entry) { return entry.first > last; });
}

}  // namespace vesselbench
