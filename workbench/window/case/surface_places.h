#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geometry/kernel/measure.h"
#include "geometry/kernel/progress.h"
#include "geometry/vessel/centerlines/centerline_graph.h"

namespace vesselbench {

/// A place that is marked in the view.
struct NamedPlace {
    Vec3 point = Vec3::Zero();  ///< [mm]
    std::string name;
    double reach = 0.0;  ///< a click on the surface that is nearer means this place [mm]

    bool operator==(const NamedPlace&) const = default;
};

/// The places of a surface that can be picked by name.
struct SurfacePlaces {
    std::vector<PatchMeasures> openings;  ///< patches other than walls
    std::vector<NamedPlace> tips;         ///< vessel ends on the centerlines
    std::string problem;                  ///< why the ends are not known; empty: no problem
};

/// \param tips whether vessel ends are wanted, whose centerlines may take seconds
/// \throw Cancelled
[[nodiscard]] SurfacePlaces places_of(const Surface& surface, bool tips, const Progress& progress);

/// "inlet: diameter 4.52 mm, area 16 mm\u00B2"
[[nodiscard]] std::string opening_text(const PatchMeasures& opening);

/// The openings as marks, and the vessel ends that are not open yet.
[[nodiscard]] std::vector<NamedPlace> openings_and_tips(const SurfacePlaces& places);

/// The opening of a patch label; null: none.
[[nodiscard]] const PatchMeasures* opening_of(const SurfacePlaces& places, std::size_t label);

/// What a click names.
struct PickSpot {
    Vec3 point = Vec3::Zero();         ///< [mm]
    std::optional<std::size_t> place;  ///< which of the offered places; none: the surface itself
};

/// \param offered places; empty: the surface itself is meant
/// \param hit the point of the surface under the cursor
/// \param near the offered place whose mark is under the cursor: it wins
/// \return none if nothing is there
[[nodiscard]] std::optional<PickSpot> pick_spot(const std::vector<NamedPlace>& offered,
                                                const std::optional<Vec3>& hit,
                                                std::optional<std::size_t> near);

}  // namespace vesselbench
