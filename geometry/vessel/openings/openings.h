#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "geometry/kernel/diagnostic.h"
#include "geometry/kernel/progress.h"
#include "geometry/vessel/centerlines/stubs.h"
#include "geometry/vessel/ends/end_choice.h"
#include "geometry/vessel/openings/frayed_trunks.h"
#include "geometry/vessel/openings/opening_place.h"

namespace vesselbench {

/// How an opening is made.
enum class OpeningWay {
    Cut,      ///< the vessel is cut at the plane and capped
    KeepCap,  ///< a flat cap exists already: only its name may change
    CapRim,   ///< a flat rim exists already: it is capped as it is
    Rename,   ///< it exists already and is not an end of the plan: it gets a name only
};

/// An opening to be made, or a cap that can be kept.
struct PlannedOpening {
    OpeningPlace place;
    OpeningWay way = OpeningWay::Cut;
    std::optional<Patch> patch;  ///< name and kind, if known; otherwise chosen by size
};

/// What becomes of an end that gets no opening.
enum class ClosingWay {
    FillRim,     ///< its rim is closed as wall
    WallCap,     ///< its cap becomes wall
    RemoveStub,  ///< the branch is removed (remove_branch)
};

struct PlannedClosing {
    Vec3 place = Vec3::Zero();  ///< centre of the rim or cap, or the branch's tip [mm]
    ClosingWay way = ClosingWay::FillRim;
};

enum class EndFate { Closed, Removed, Opened, Kept };

[[nodiscard]] std::string to_string(EndFate fate);  ///< "closed", "removed", "opened", "kept"

/// A vessel end and what was decided about it.
struct EndRecord {
    Vec3 place = Vec3::Zero();  ///< centre of its rim or cap, or its tip [mm]
    double diameter = 0.0;      ///< of the vessel there [mm]
    EndFate fate = EndFate::Closed;
    std::string why;      ///< may be empty: opened at the chosen place
    bool rim = false;     ///< an open border of the surface
    bool border = false;  ///< a cap where an image's border cuts a vessel
    bool shared = false;  ///< removed with the cut of another end, of which it is a part
    bool plain = false;   ///< kept, or opened at the chosen place
    bool asked = false;   ///< closed since the caller wants it so
    bool wanted = false;  ///< open since the caller wants it so
    bool tried = false;   ///< closed since it could not be cut
    bool stub = false;    ///< it has no centerline yet: one is made when it is opened
    std::optional<EndVerdict> verdict = std::nullopt;  ///< none: it was not judged
    int number = 0;  ///< by falling share of the flow, from 1; 0: it has none
    std::optional<std::size_t> opening = std::nullopt;  ///< of the plan

    /// Its share of the flow [-]; 0: it was not judged.
    [[nodiscard]] double share() const { return verdict ? verdict->share : 0.0; }
};

struct OpeningPlan {
    std::vector<PlannedOpening> openings;
    std::vector<PlannedClosing> closings;
    std::vector<EndRecord> ends;       ///< every end found, worst first
    std::vector<Diagnostic> warnings;  ///< about the places of openings: bends, doubtful axes
    std::vector<std::size_t> inlets;   ///< the openings that are inlets; empty: chosen by width
    bool gathers = false;              ///< as asked for (OpeningPlanOptions)
    bool inlet_doubtful = false;       ///< another end may be the trunk's as well
};

/// A place where a cut was tried without success.
struct FailedCut {
    Vec3 tip = Vec3::Zero();  ///< [mm]
    Vec3 place = Vec3::Zero();
    Diagnostic why;
    bool lost = false;  ///< a vessel went with it: so it would from farther inside
};

struct OpeningPlanOptions {
    std::optional<Vec3> tip;         ///< near the one branch to open [mm]; none: all vessel ends
    std::optional<double> distance;  ///< from the tip [mm]; none: chosen automatically
    std::optional<double> radii;     ///< the same in radii of the tip's vessel
    /// Every end is cut perpendicular to its vessel at its chosen place; the first one that cannot
    /// be ends the plan with its failure.
    bool strict = false;
    /// Patches of kind Cut are where an image ends, which nobody meant to be an opening's plane:
    /// only perpendicular ones are kept.
    bool border_cuts = false;
    /// Ends that are closed stay as they are, except those named in `open` or `inlets`.
    bool leave_closed = false;
    /// Of ends that may be openings or not, the likelier choice is made (check_flow).
    bool accept_doubts = false;
    /// The blood gathers, as in a vein: it enters at all ends but the trunk's, unless `inlets` or
    /// the surface's patches name those where it does.
    bool gathers = false;
    /// That the surface was made from.
    std::optional<ImageBox> image;
    Positions inlets;  ///< near the ends that are inlets: they have to be opened [mm]
    Positions open;    ///< near ends that have to be opened, though they may look closed [mm]
    Positions closed;  ///< near the ends that stay closed [mm]
    std::vector<FailedCut> failed;  ///< places to be avoided
    std::vector<Stub> stubs;        ///< without a line: they stay closed (lines_to_ends)
};

/// The tip that a point means.
/// \param point at most 4 radii from it [mm]
/// \return node of the graph
/// \throw AlgorithmFailure if there is none; the text names the nearest one
[[nodiscard]] std::size_t tip_to_open(const CenterlineGraph& graph, const Vec3& point);

/// Decides what becomes of the vessel ends by their profiles and odds (choose_ends). Of those that
/// are to be open, a flat rim or a flat cap is kept as it is; the others are cut at the chosen
/// place (choose_opening_place), the largest share of the flow first; else at the nearest place
/// with a whole section; else the branch is removed if it is a stub, shorter than its parent is
/// wide; else it is closed as wall. A trunk that frays is one end (without_frays), unless `tip` is
/// given.
/// \throw AlgorithmFailure if there is no end, no branch has its tip near `tip`, the end at `tip`
/// or one of `inlets` or `open` cannot be opened; Cancelled if the user cancels
[[nodiscard]] OpeningPlan plan_openings(const Surface& surface, const CenterlineGraph& graph,
                                        const OpeningPlanOptions& options = {},
                                        const Progress& progress = {});

/// The lines by which a plan is made: without frays, or with `tip` all of them, since a single end
/// is not judged beside others.
[[nodiscard]] LinesWithoutFrays planning_lines(const Surface& surface, const CenterlineGraph& graph,
                                               const OpeningPlanOptions& options);

/// Places of blind branches without a line that are to be opened [mm].
/// \param options with the `stubs` of the lines
[[nodiscard]] Positions stubs_to_open(const Surface& surface, const CenterlineGraph& graph,
                                      const OpeningPlanOptions& options,
                                      const Progress& progress = {});

/// The same by planning_lines() that were made already, for several plans of a surface.
[[nodiscard]] OpeningPlan plan_openings(const Surface& surface, const LinesWithoutFrays& lines,
                                        const OpeningPlanOptions& options,
                                        const Progress& progress = {});

}  // namespace vesselbench
