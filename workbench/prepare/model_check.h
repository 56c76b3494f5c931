#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "geometry/kernel/diagnostic.h"
#include "geometry/kernel/progress.h"
#include "geometry/vessel/openings/lost_vessels.h"
#include "workbench/session/session.h"

namespace vesselbench {

/// What a model is compared with.
struct BeforeOpenings {
    Surface surface;  ///< before the first edit that cut ends
    /// What was taken away from then on because the caller said where: by cuts at a given place,
    /// and by removed branches.
    std::vector<Removal> asked;
};

/// Empty if no end was cut. \param last edit of the variant up to which cuts and removals count
[[nodiscard]] std::optional<BeforeOpenings> before_openings(Session& session,
                                                            const std::string& variant,
                                                            EditId last);

/// The vessels that a model misses.
struct VesselCheck {
    CenterlineGraph lines;  ///< of the vessels before; a fray's threads are not missed
    std::vector<LostVessel> lost;
    std::optional<Diagnostic> warning = std::nullopt;  ///< why they could not be looked for
};

[[nodiscard]] VesselCheck compared_vessels(const BeforeOpenings& before, const Surface& after,
                                           const Progress& progress = {});

/// Checks a model that is being made as early as it can be judged: the openings and the vessels
/// once its ends are cut, and the vessels again when its surface is final. No state of the case is
/// checked twice.
class ModelChecks {
public:
    ModelChecks(Session& session, std::string variant)
        : session_(session), variant_(std::move(variant)) {}

    /// Compares an edit that cuts ends with the surface before the variant's ends were opened.
    /// \throw AlgorithmFailure if the cuts opened a vessel's side, or a vessel misses over more
    /// than 3 of its diameters; the text names the opening, or lists the vessels and names the edit
    /// that lost them, with the command that mends it
    void after(const LogEntry& edit, const Progress& progress);

    /// Before the first edit of the step that makes products of the surface, and at the end.
    /// \throw AlgorithmFailure as after()
    void surface_final(const Progress& progress);

    /// Of the last check of the vessels: why they could not be compared, or what is missing of
    /// thin ones.
    [[nodiscard]] const std::optional<Diagnostic>& warning() const { return warning_; }

private:
    void check_cut(const LogEntry& edit, const std::optional<BeforeOpenings>& before);
    void check_whole(const LogEntry& edit, const std::optional<BeforeOpenings>& before,
                     const Progress& progress);

    Session& session_;
    std::string variant_;
    std::optional<Diagnostic> warning_;
    ResultId cut_ = 0;    ///< whose openings are checked
    ResultId whole_ = 0;  ///< whose vessels are
};

}  // namespace vesselbench
