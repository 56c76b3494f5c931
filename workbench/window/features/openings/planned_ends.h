#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geometry/vessel/openings/openings.h"
#include "workbench/case/operation.h"

namespace vesselbench {

/// What clip-opening decides about all ends of a scene if a user names none of them. The numbers
/// are those that `vesselbench ends` lists.
struct PlainEnds {
    OpeningPlan plan;
    std::vector<bool> removable;  ///< by end of the plan: its branch can be cut off at its root

    /// Null: there is no end of this number.
    [[nodiscard]] const EndRecord* end(int number) const;
};

/// The ends of a scene: as they are decided without a user, and with the ends that a user named.
struct PlannedEnds {
    std::shared_ptr<const PlainEnds> plain;     ///< never null
    std::shared_ptr<const OpeningPlan> chosen;  ///< null: it cannot be planned, see `problem`
    std::string problem;                        ///< why the named ends cannot be planned

    /// The same end with the user's choices; of `plain` while they are not planned.
    [[nodiscard]] const EndRecord& decided(const EndRecord& end) const;

    /// Where an end would be opened; null: nowhere, or that is not known.
    [[nodiscard]] const PlannedOpening* opening(int number) const;

    /// The numbered end that a point means: the nearest one, by its place or by its tip; none
    /// within 4 of its radii.
    [[nodiscard]] std::optional<int> number_at(const Vec3& point) const;
};

/// What a plan depends on: without the planes that replace one.
[[nodiscard]] Arguments planning_arguments(Arguments given);

/// The same, and without the ends that a user named.
[[nodiscard]] Arguments plain_arguments(Arguments given);

/// \param operation clip-opening \param given its arguments, without `tip`
/// \param known of an earlier call with the same scene and plain_arguments(); null: none
/// \throw AlgorithmFailure if the scene has no end; UsageError; Cancelled
[[nodiscard]] PlannedEnds plan_ends(const Operation& operation, const Scene& scene,
                                    const Arguments& given, std::shared_ptr<const PlainEnds> known,
                                    const Progress& progress);

}  // namespace vesselbench
