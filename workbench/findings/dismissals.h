#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "workbench/findings/finding.h"

namespace vesselbench {

/// That someone judged a finding as no artefact, and why.
struct Dismissal {
    std::string kind;           ///< of the finding
    Vec3 place = Vec3::Zero();  ///< of the finding when it was dismissed [mm]
    double size = 0.0;          ///< of the finding then [mm]
    std::string reason;         ///< in their own words
    std::string author;
    std::string time;  ///< UTC

    /// As Finding::id().
    [[nodiscard]] std::string id() const;

    bool operator==(const Dismissal&) const = default;
};

/// [bytes] of a reason.
inline constexpr std::size_t kLongestReason = 2000;

/// True if the dismissal was of this finding: the same kind, within half of the smaller size, and
/// neither size more than half as large again as the other. What has grown since is another one.
[[nodiscard]] bool is_of(const Dismissal& dismissal, const Finding& finding);

/// A dismissal and the finding it hides; none: the finding is gone, or has changed.
struct DismissedFinding {
    Dismissal dismissal;
    std::optional<Finding> finding;
};

/// Findings with what was said about them. A dismissal hides one finding: where several are near,
/// each the one nearest to it.
struct JudgedFindings {
    std::vector<Finding> open;                ///< not dismissed, as find_findings() orders them
    std::vector<DismissedFinding> dismissed;  ///< in the order of the dismissals
    std::vector<NotSearched> not_searched;
};

[[nodiscard]] JudgedFindings judged(FindingSearch search, const std::vector<Dismissal>& dismissals);

/// The dismissals in a project file, in the order they were made; none if it has none. They are of
/// the project, not of a state: undo does not change them.
/// \throw IoError, InvalidInput if they cannot be read
[[nodiscard]] std::vector<Dismissal> stored_dismissals(const std::filesystem::path& project);

/// Enters a dismissal into the project and its record, in the name of the user; the one that hides
/// this finding already is replaced. A session of this process may have the project open.
/// \param search what was found, `finding` among it
/// \throw UsageError if the reason is blank, too long or not UTF-8; IoError if the project cannot be
/// written
void dismiss(const std::filesystem::path& project, const FindingSearch& search,
             const Finding& finding, const std::string& reason);

/// Takes back the dismissal that an id means, whether or not its finding is still there, and enters
/// that into the record.
/// \return the dismissal; none: nothing was dismissed there
/// \throw UsageError if it is no id; IoError if the project cannot be written
std::optional<Dismissal> restore(const std::filesystem::path& project, const std::string& id);

}  // namespace vesselbench
