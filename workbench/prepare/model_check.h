#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

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
    std::vector<LostVessel> lost;
    std::string warning;  ///< why they could not be looked for
};

[[nodiscard]] VesselCheck compared_vessels(const BeforeOpenings& before, const Surface& after,
                                           const Progress& progress = {});

/// Compares the model after an edit with the surface before the variant's ends were opened.
/// \return a warning if the vessels could not be compared; else empty
/// \throw AlgorithmFailure if a vessel misses over more than 3 of its diameters; the text lists
/// them, and names the edit that lost them with the command that mends it
[[nodiscard]] std::string check_vessels(Session& session, const std::string& variant, EditId last,
                                        const Progress& progress);

/// The same for the openings made up to an edit.
/// \throw AlgorithmFailure if the cuts opened a vessel's side; the text names the opening, and the
/// command that mends it
void check_openings(Session& session, const std::string& variant, EditId last);

/// Checks a model that is being made as early as it can be judged: the openings and the vessels
/// once its ends are cut, and the vessels again when its surface is final. No state of the case is
/// checked twice.
class ModelChecks {
public:
    ModelChecks(Session& session, std::string variant)
        : session_(session), variant_(std::move(variant)) {}

    /// \throw AlgorithmFailure as check_openings, check_vessels
    void after(const LogEntry& edit, const Progress& progress);

    /// Before the first edit of the step that makes products of the surface, and at the end.
    /// \throw AlgorithmFailure as check_openings, check_vessels
    void surface_final(const Progress& progress);

    /// Of the last check of the vessels; empty if they could be compared.
    [[nodiscard]] const std::string& warning() const { return warning_; }

private:
    void check_cut(const LogEntry& edit);
    void check_whole(const LogEntry& edit, const Progress& progress);

    Session& session_;
    std::string variant_;
    std::string warning_;
    ResultId cut_ = 0;    ///< whose openings are checked
    ResultId whole_ = 0;  ///< whose vessels are
};

}  // namespace vesselbench
