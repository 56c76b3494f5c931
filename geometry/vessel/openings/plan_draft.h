#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "geometry/vessel/openings/openings.h"
#include "geometry/vessel/openings/surface_ends.h"

namespace vesselbench {

/// A plan in the making: a surface's ends, and what was decided about each so far. Not thread-safe.
class PlanDraft {
public:
    /// Keeps references to all arguments but `progress`.
    /// \throw Cancelled if the user cancels
    PlanDraft(const Surface& surface, const LinesWithoutFrays& lines,
              const OpeningPlanOptions& options, const Progress& progress);

    [[nodiscard]] const Surface& surface() const { return surface_; }

    [[nodiscard]] const CenterlineGraph& graph() const { return lines_.graph; }

    [[nodiscard]] const OpeningPlanOptions& options() const { return options_; }

    [[nodiscard]] const std::vector<SurfaceEnd>& ends() const { return ends_; }

    /// The ends without a centerline; they are reported only.
    [[nodiscard]] std::vector<EndRecord>& unlined() { return unlined_; }

    [[nodiscard]] EndRecord& record(std::size_t e) { return records_[e]; }

    [[nodiscard]] bool is_decided(std::size_t e) const { return decided_[e]; }

    [[nodiscard]] bool is_open(std::size_t e) const { return made_[e].has_value(); }

    [[nodiscard]] double decided_share() const;  ///< of all ends [-]

    /// True for a rim, or an image's border, that a vessel passes: none ends there.
    [[nodiscard]] bool in_side(std::size_t e) const { return in_side_[e]; }

    /// A side at an image's border is no end; a rim of a surface may be one if the caller says so.
    [[nodiscard]] bool stays_side(std::size_t e) const;

    /// The place of the cuts was given.
    [[nodiscard]] bool is_fixed() const { return options_.distance || options_.radii; }

    /// The threads in which an end frays; null: it does not.
    [[nodiscard]] const FrayedTrunk* frays(std::size_t e) const;

    /// The end of its centerline, else its centre [mm].
    [[nodiscard]] Vec3 tip_place(std::size_t e) const;

    /// Diameter of the widest other end [mm]; 0: there is none.
    [[nodiscard]] double widest_beside(std::size_t e) const;

    [[nodiscard]] bool is_inlet(std::size_t e) const;
    [[nodiscard]] bool is_wanted(std::size_t e) const;  ///< named by the caller: it has to be open

    void name_inlet(std::size_t e) { inlets_.push_back(e); }

    void want(std::size_t e) { wanted_.push_back(e); }

    void open(std::size_t e, const OpeningPlace& place, OpeningWay way, const std::string& why);
    void close(std::size_t e, const std::string& why);

    /// Closes an end that may be one: the reason says how to open it nevertheless.
    void close_offering(std::size_t e, const std::string& why);

    /// Removes the branch of a stub, which cannot be cut for the reason in its record.
    void remove_stub(std::size_t e);

    /// Removes an end, unless it is decided, with the cut of the one of which it is a part.
    void take_along(std::size_t e, std::size_t cut);

    /// Drops all ends but one; only for a plan of a single end.
    void keep_only(std::size_t e);

    /// The plan; the draft is used up.
    [[nodiscard]] OpeningPlan finished();

private:
    void add_threads();

    const Surface& surface_;
    const LinesWithoutFrays& lines_;
    const OpeningPlanOptions& options_;
    std::vector<SurfaceEnd> ends_;
    std::vector<std::optional<PlannedOpening>> made_;  ///< by end
    std::vector<EndRecord> records_;                   ///< by end
    std::vector<bool> decided_;                        ///< by end
    std::vector<bool> in_side_;                        ///< by end
    std::vector<EndRecord> unlined_;
    std::vector<std::size_t> inlets_;  ///< ends that were named
    std::vector<std::size_t> wanted_;  ///< ends that shall be opened
    OpeningPlan plan_;
};

}  // namespace vesselbench
