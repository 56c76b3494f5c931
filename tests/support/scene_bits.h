#pragma once

#include <span>
#include <string>

#include "workbench/project/content_hash.h"
#include "workbench/project/serialization.h"

namespace vesselbench::test {

/// Digest of a scene's bits. What its parts share does not count: a scene whose mask is its image
/// has both in memory once or twice, as it was read.
inline std::string bits_of(const Scene& scene) {
    const SceneParts taken = take_apart(scene);
    ContentHash hash;
    hash.add(taken.manifest);
    for (const ScenePart& part : taken.parts) {
        const std::string content = content_hash(part);
        hash.add(std::as_bytes(std::span(content)));
    }
    return hash.hex();
}

}  // namespace vesselbench::test
