#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "geometry/kernel/vec3.h"
#include "workbench/colours/colourings.h"
#include "workbench/window/case/document.h"
#include "workbench/window/features/colours/view_data.h"
#include "workbench/window/features/live/live_model.h"

namespace vesselbench {

/// A place where the shown measure is worst among its surroundings.
struct WorstPlace {
    Vec3 place;                       ///< [mm]
    double value = 0.0;               ///< in the colouring's unit
    std::size_t index = 0;            ///< of the point
    std::optional<double> sharpness;  ///< of a staircase, by which it is ranked [-]
    Vec3 outward = Vec3::Zero();      ///< unit normal of the surface there; zero: unknown
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
    /// The model as the view shows it.
    struct Seen {
        const Document& document;
        const ViewData& data;
        std::shared_ptr<const LiveModel> live;  ///< in place of the document's; null: it is not
        ColouringKind kind = ColouringKind::Patches;
    };

    /// The place `steps` further, round and round; the first if the colours have changed.
    /// \return none: there are no colours now
    std::optional<WorstPlace> go(const Seen& seen, int steps);

    /// "2 of 10"
    [[nodiscard]] std::string position() const;

private:
    struct Coloured;

    [[nodiscard]] static std::optional<Coloured> coloured(const Seen& seen);
    [[nodiscard]] bool is_of(const Seen& seen, const Coloured& now) const;
    void find(const Coloured& now, ColouringKind kind);

    /// What the places are of: the values and the scene's number, or the live model.
    std::pair<const void*, int> of_ = {nullptr, -1};
    std::weak_ptr<const LiveModel> of_live_;
    std::vector<WorstPlace> places_;
    std::size_t at_ = 0;
};

}  // namespace vesselbench
