#pragma once

#include <cstddef>
#include <list>
#include <optional>
#include <utility>

#include "workbench/case/history.h"
#include "workbench/case/scene.h"

namespace vesselbench {

/// The scenes used last, within a number of bytes; what several of them share counts once.
class SceneCache {
public:
    explicit SceneCache(std::size_t budget) : budget_(budget) {}

    [[nodiscard]] std::optional<Scene> find(ResultId id);

    /// Keeps a scene; drops the ones longest unused where the budget asks for it, but never this.
    void put(ResultId id, const Scene& scene);

    /// [bytes] held now
    [[nodiscard]] std::size_t bytes() const;

    [[nodiscard]] std::size_t size() const { return scenes_.size(); }

private:
    std::size_t budget_;
    std::list<std::pair<ResultId, Scene>> scenes_;  ///< the one used last in front
};

}  // namespace vesselbench
