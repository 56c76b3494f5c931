#include "workbench/project/scene_rows.h"

#include <algorithm>
#include <map>
#include <utility>

#include "geometry/kernel/errors.h"
#include "workbench/project/content_hash.h"
#include "workbench/project/serialization.h"

namespace vesselbench {

namespace {

/// For each new part of a scene, in order, the part it replaced.
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

}  // namespace

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

SceneRow store_scene(PartStore& store, const Scene& scene, const Scene* input) {
    SceneParts taken = take_apart(scene);
    SceneRow row;
    const auto bases = bases_of(taken.parts, input);
    for (std::size_t i = 0; i < taken.parts.size(); ++i)
        row.blobs.push_back(store.store(taken.parts[i], bases[i]));
    row.manifest = std::move(taken.manifest);
    return row;
}

std::string scene_digest(const PartStore& store, const SceneRow& row) {
    ContentHash hash;
    hash.add(row.manifest);
    for (const BlobId blob : row.blobs) {
        const std::string part = store.hash_of(blob);
        hash.add(std::as_bytes(std::span(part)));
    }
    return hash.hex();
}

std::vector<std::string> differences(const PartStore& store, const SceneRow& row,
                                     const Scene& scene) {
    const SceneParts taken = take_apart(scene);
    std::vector<std::string> names;
    if (taken.manifest != row.manifest) names.emplace_back("patches, grid or kinds of data");
    for (std::size_t i = 0; i < taken.parts.size(); ++i) {
        const ScenePart& part = taken.parts[i];
        if (i < row.blobs.size() && (store.known(part) == row.blobs[i] ||
                                     content_hash(part) == store.hash_of(row.blobs[i])))
            continue;
        names.push_back(part_words(part));
    }
    if (taken.parts.size() < row.blobs.size()) names.emplace_back("missing data");
    return names;
}

std::vector<std::string> damages(PartStore& store, const SceneRow& row, const Progress& progress) {
    std::vector<std::string> names;
    for (const BlobId blob : row.blobs) {
        progress.check_cancelled();
        try {
            static_cast<void>(store.load(blob));
        } catch (const InvalidInput& error) {
            names.emplace_back(error.what());
        }
    }
    return names;
}

}  // namespace vesselbench
