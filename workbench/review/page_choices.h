#pragma once

#include <string>
#include <vector>

#include "workbench/session/session.h"

namespace vesselbench {

/// Something that an author decided otherwise than the operation would have by itself.
struct OtherChoice {
    std::string what;           ///< "outlet_1 was made the inlet; the program would take inlet"
    double doubt = 0.0;         ///< what speaks against it, in radii of the vessel [-], 0 or more
    Vec3 place = Vec3::Zero();  ///< [mm]
};

/// What the author of an edit that opens vessels decided otherwise: the inlet, directions of cuts,
/// ends that stay closed or are opened. The operation runs once more without those arguments, and
/// with the likelier choice where it would ask; nothing is entered. Empty: nothing was decided by
/// hand, it agrees, or the operation finds no openings by itself.
/// \param operation of the edit \param entry a done edit \throw Cancelled
[[nodiscard]] std::vector<OtherChoice> other_choices(Session& session, const LogEntry& entry,
                                                     const Operation& operation,
                                                     const Progress& progress = {});

/// The openings of an edit, as its result has them.
struct DecidedOpening {
    std::string name;
    bool inlet = false;
    Vec3 tip = Vec3::Zero();      ///< [mm]
    Vec3 normal = Vec3::UnitZ();  ///< unit, out of the vessel
    double diameter = 0.0;        ///< [mm]; 0: unknown
    double direction_sd = 0.0;    ///< standard deviation of the normal [deg]
};

/// An end, and how likely it is an opening.
struct JudgedEnd {
    Vec3 place = Vec3::Zero();  ///< [mm]
    double diameter = 0.0;      ///< [mm]
    double opening = 0.5;       ///< probability [-]
};

struct DecidedOpenings {
    std::vector<DecidedOpening> openings;
    std::vector<JudgedEnd> ends;
};

/// What an author decided; all else the operation decided, perhaps on another surface.
struct ByHand {
    bool inlet = false;       ///< which opening is the inlet
    bool ends = false;        ///< which ends are opened
    bool directions = false;  ///< how they are cut
};

/// Where decisions differ in what was decided by hand.
[[nodiscard]] std::vector<OtherChoice> compared(const DecidedOpenings& given,
                                                const DecidedOpenings& own, const ByHand& by_hand);

}  // namespace vesselbench
