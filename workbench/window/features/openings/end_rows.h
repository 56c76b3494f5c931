#pragma once

#include <optional>
#include <string>
#include <vector>

#include "workbench/window/features/openings/end_choices.h"

namespace vesselbench {

/// What a user can want of an end.
enum class EndWish { Inlet, Outlet, Closed, Removed };

/// A vessel end as a table and a marker show it.
struct EndRow {
    int number = 0;                          ///< as `vesselbench ends` lists it
    Vec3 place = Vec3::Zero();               ///< [mm]
    double diameter = 0.0;                   ///< [mm]
    double share = 0.0;                      ///< of the flow [-]
    double odds = 0.0;                       ///< of being an opening [-]
    EndWish wish = EndWish::Closed;          ///< what becomes of it
    EndWish planned = EndWish::Closed;       ///< what would without the user
    bool chosen = false;                     ///< named by the user
    bool doubtful = false;                   ///< the odds do not decide, and no user has
    bool removable = false;                  ///< EndWish::Removed can be chosen
    bool sac = false;                        ///< it looks like an aneurysm
    bool moved = false;                      ///< its cut is not where it was planned
    std::string why;                         ///< may be empty
    std::optional<PlannedOpening> cut = {};  ///< of an open end; none: not known yet

    [[nodiscard]] bool is_open() const { return wish == EndWish::Inlet || wish == EndWish::Outlet; }

    [[nodiscard]] bool is_changed() const { return moved || wish != planned; }
};

[[nodiscard]] std::string to_string(EndWish wish);  ///< "Inlet", "Outlet", "Closed", "Removed"

/// Those in doubt first, then by number.
[[nodiscard]] std::vector<EndRow> rows_of(const EndChoices& choices, const PlannedEnds& planned);

/// The wish after the next click: open, closed, removed if it can be, open.
[[nodiscard]] EndWish next_wish(const EndRow& row);

/// The choices with a wish for one end. A new inlet takes the place of all others.
[[nodiscard]] EndChoices with_wish(EndChoices choices, const PlannedEnds& planned, int number,
                                   EndWish wish);

/// The choices with one more inlet.
[[nodiscard]] EndChoices with_another_inlet(EndChoices choices, const PlannedEnds& planned,
                                            int number);

/// "5 of 7 ends open, 1 in doubt; changed: 3, 5"
[[nodiscard]] std::string summary_of(const std::vector<EndRow>& rows);

}  // namespace vesselbench
