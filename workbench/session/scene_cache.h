#pragma once

#include <cstddef>
#include <list>
#include <optional>
#include <utility>

#include "workbench/case/history.h"
#include "workbench/case/scene.h"

namespace vesselbench {

/// The most recently used scenes, bounded in bytes; shared parts count once.
class SceneCache {
public:
    explicit SceneCache(std::size_t budget) : budget_(budget) {}

    [[nodiscard]] std::optional<Scene> find(ResultId id);

    /// Keeps a scene; drops the least recently used ones if the budget requires it, but never this
    /// one.
    void put(ResultId id, const Scene& scene);

    /// [bytes] currently held
    [[nodiscard]] std::size_t bytes() const;

    [[nodiscard]] std::size_t size() const { return scenes_.size(); }

private:
    std::size_t budget_;
    std::list<std::pair<ResultId, Scene>> scenes_;  ///< most recently used first
};

}  // namespace vesselbench
