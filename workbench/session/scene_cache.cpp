#include "workbench/session/scene_cache.h"

#include <algorithm>
#include <set>

#include "workbench/project/serialization.h"

namespace vesselbench {

namespace {

/// Sums the sizes of parts, each counted once.
class PartSum {
public:
    std::size_t add(const Scene& scene) {
        for (const ScenePart& part : take_apart(scene).parts)
            if (seen_.insert(identity(part)).second) bytes_ += memory_bytes(part);
        return bytes_;
    }

private:
    std::set<const void*> seen_;
    std::size_t bytes_ = 0;
};

}  // namespace

std::optional<Scene> SceneCache::find(ResultId id) {
    const auto found = std::find_if(scenes_.begin(), scenes_.end(),
                                    [&](const auto& entry) { return entry.first == id; });
    if (found == scenes_.end()) return std::nullopt;
    scenes_.splice(scenes_.begin(), scenes_, found);
    return found->second;
}

void SceneCache::put(ResultId id, const Scene& scene) {
    if (!find(id)) scenes_.emplace_front(id, scene);
    PartSum sum;
    auto entry = scenes_.begin();
    sum.add(entry->second);
    for (++entry; entry != scenes_.end() && sum.add(entry->second) <= budget_;) ++entry;
    scenes_.erase(entry, scenes_.end());
}

std::size_t SceneCache::bytes() const {
    PartSum sum;
    std::size_t bytes = 0;
    for (const auto& [id, scene] : scenes_) bytes = sum.add(scene);
    return bytes;
}

}  // namespace vesselbench
