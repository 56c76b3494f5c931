#pragma once

#include <span>
#include <vector>

#include "geometry/kernel/progress.h"
#include "workbench/case/scene.h"
#include "workbench/project/part_store.h"

namespace vesselbench {

/// A stored scene: the blobs of its parts, and its manifest.
struct SceneRow {
    std::vector<BlobId> blobs;
    Bytes manifest;
};

[[nodiscard]] Bytes pack(const SceneRow& row);

/// \throw InvalidInput if the bytes are damaged
[[nodiscard]] SceneRow unpack_scene_row(std::span<const std::byte> bytes);

/// Stores the parts of a scene inside the caller's transaction.
/// \param input the scene it was made from, as a base for storing differences; null: none
[[nodiscard]] SceneRow store_scene(PartStore& store, const Scene& scene, const Scene* input);

/// SHA-256 of a stored scene: of its manifest and the SHA-256 of each part. The same scene has the
/// same digest wherever it is stored.
[[nodiscard]] std::string scene_digest(const PartStore& store, const SceneRow& row);

/// Names of the parts in which a scene differs from the stored one, bit for bit; empty: none.
[[nodiscard]] std::vector<std::string> differences(const PartStore& store, const SceneRow& row,
                                                   const Scene& scene);

/// What is wrong with stored parts whose content is damaged or does not match their checksum.
/// \throw Cancelled
[[nodiscard]] std::vector<std::string> damages(PartStore& store, const SceneRow& row,
                                               const Progress& progress);

}  // namespace vesselbench
