#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "geometry/kernel/vec3.h"
#include "workbench/window/model/colourings.h"
#include "workbench/window/model/document.h"
#include "workbench/window/model/view_data.h"

namespace vesselbench {

/// A place where the shown measure is worst among its surroundings.
struct WorstPlace {
    Vec3 place;          ///< [mm]
    double value = 0.0;  ///< in the colouring's unit
};

/// The worst values, the worst one first, none nearer to an earlier one than `apart`; values that
/// are not finite count for nothing.
/// \param apart [mm]  \param most largest number of places
[[nodiscard]] std::vector<WorstPlace> worst_places(std::span<const Vec3> points,
                                                   std::span<const double> values, WorstEnd end,
                                                   double apart, std::size_t most);

/// A tour of the worst places of what the model's colours show.
class WorstTour {
public:
    /// The place `steps` further, round and round; the first if the colours have changed.
    /// \return none: there are no colours now
    std::optional<WorstPlace> go(const Document& document, const ViewData& data, ColouringKind kind,
                                 int steps);

    /// "2 of 10"
    [[nodiscard]] std::string position() const;

private:
    /// The values that the places are of, and the scene's number.
    std::pair<const void*, int> of_ = {nullptr, -1};
    std::vector<WorstPlace> places_;
    std::size_t at_ = 0;
};

}  // namespace vesselbench
