#pragma once

#include <span>
#include <vector>

#include "geometry/kernel/progress.h"
#include "workbench/case/scene.h"
#include "workbench/project/bytes.h"
#include "workbench/project/part_codec.h"

namespace vesselbench {

/// A scene as its parts and a few bytes that describe how they belong together. A part used in
/// several places is listed as often, so that the bytes do not depend on sharing.
struct SceneParts {
    Bytes manifest;
    std::vector<ScenePart> parts;
};

[[nodiscard]] SceneParts take_apart(const Scene& scene);

/// The scene rebuilt from its parts, sharing them.
/// \throw InvalidInput if the manifest is damaged, or parts are inconsistent
[[nodiscard]] Scene put_together(std::span<const std::byte> manifest,
                                 const std::vector<ScenePart>& parts);

/// A whole scene in one uncompressed blob, for worker processes. Parts of `known` are not written
/// but referenced; decode_scene needs the same known parts.
[[nodiscard]] Bytes encode_scene(const Scene& scene, const std::vector<ScenePart>& known = {});
/// The same blob, without a copy of the arrays.
void write_scene(const Scene& scene, const std::vector<ScenePart>& known, const ByteSink& sink);
/// \throw InvalidInput if the blob is damaged; Cancelled
[[nodiscard]] Scene decode_scene(std::span<const std::byte> blob,
                                 const std::vector<ScenePart>& known = {},
                                 const Progress& progress = {});

}  // namespace vesselbench
