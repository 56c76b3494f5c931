#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "geometry/vessel/ends/surface_ends.h"
#include "geometry/vessel/openings/openings.h"

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
    [[nodiscard]] std::vector<EndRecord>& stubs() { return stubs_; }

    [[nodiscard]] EndRecord& record(std::size_t e) { return records_[e]; }

    /// By measure and odds (choose_ends).
    [[nodiscard]] const EndVerdict& verdict(std::size_t e) const { return choice_.ends[e]; }

    [[nodiscard]] bool is_decided(std::size_t e) const { return decided_[e]; }

    [[nodiscard]] bool is_open(std::size_t e) const { return made_[e].has_value(); }

    [[nodiscard]] double decided_share() const;  ///< of all ends [-]

    /// An image's border grazes a vessel that passes there: no end, whatever the caller says.
    [[nodiscard]] bool grazes(std::size_t e) const { return grazes_[e]; }

    /// Diameters of the ends' vessels along their courses [mm]; 0: not measured.
    [[nodiscard]] std::vector<double> courses() const;

    /// So much of the flow leaves there that it may not vanish (kLeastShare).
    [[nodiscard]] bool has_share(std::size_t e) const {
        return choice_.ends[e].share > kLeastShare;
    }

    /// The place of the cuts was given.
    [[nodiscard]] bool is_fixed() const { return options_.distance || options_.radii; }

    /// The threads in which an end frays; null: it does not.
    [[nodiscard]] const FrayedTrunk* frays(std::size_t e) const;

    /// The end of its centerline, else its centre [mm].
    [[nodiscard]] Vec3 tip_place(std::size_t e) const;

    [[nodiscard]] bool is_inlet(std::size_t e) const;
    [[nodiscard]] bool is_wanted(std::size_t e) const;  ///< named by the caller: it has to be open

    void name_inlet(std::size_t e) { inlets_.push_back(e); }

    void want(std::size_t e) { wanted_.push_back(e); }

    void open(std::size_t e, const OpeningPlace& place, OpeningWay way, const std::string& why);
    void close(std::size_t e, const std::string& why);

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
    void choose_inlets();
    void take_trunk();
    [[nodiscard]] std::optional<std::size_t> trunk() const;
    [[nodiscard]] std::vector<bool> named_outlets() const;
    void number_ends();

    const Surface& surface_;
    const LinesWithoutFrays& lines_;
    const OpeningPlanOptions& options_;
    std::vector<SurfaceEnd> ends_;
    std::vector<std::optional<PlannedOpening>> made_;  ///< by end
    std::vector<EndRecord> records_;                   ///< by end
    std::vector<bool> decided_;                        ///< by end
    EndChoice choice_;
    std::vector<bool> grazes_;  ///< by end
    std::vector<EndRecord> stubs_;
    std::vector<std::size_t> inlets_;  ///< ends that were named
    std::vector<std::size_t> wanted_;  ///< ends that shall be opened
    OpeningPlan plan_;
};

}  // namespace vesselbench
