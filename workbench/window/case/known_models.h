#pragma once

#include <list>
#include <optional>

#include "workbench/case/history.h"
#include "workbench/case/scene.h"
#include "workbench/session/surface_change.h"

namespace vesselbench {

/// Figures of a model.
struct ShownFigures {
    std::optional<double> volume;  ///< [mm^3]
    bool inside_out = false;       ///< closed, and its normals point inward
    /// From the source, of the wall without what was made at its ends; none: it is the source.
    std::optional<PointDeviation> deviation;
};

/// The scene of a result, and what is known of it.
struct KnownModel {
    ResultId result = 0;
    Scene scene;
    std::optional<ShownFigures> figures;
};

/// The models that a window has at hand: the shown one, and others that may be shown again without
/// reading them. A model keeps its address while it is known.
class KnownModels {
public:
    /// Null before the first one.
    [[nodiscard]] KnownModel* shown() { return models_.empty() ? nullptr : &models_.front(); }

    [[nodiscard]] const KnownModel* shown() const {
        return models_.empty() ? nullptr : &models_.front();
    }

    /// Null if it is not known.
    [[nodiscard]] const KnownModel* find(ResultId result) const;

    /// Shows a known one. \return false if it is not known
    bool show(ResultId result);

    /// Shows a new one, in place of one of the same result.
    void put(ResultId result, Scene scene);

    /// Forgets all but the shown one, that of a result, and so many others, last shown first.
    void keep(ResultId result, int others);

    void clear() { models_.clear(); }

private:
    std::list<KnownModel> models_;  ///< last shown first
};

}  // namespace vesselbench
