#pragma once

#include <span>
#include <string>
#include <vector>

#include "geometry/kernel/diagnostic.h"
#include "geometry/kernel/vec3.h"
#include "workbench/case/listed_finding.h"
#include "workbench/findings/reading.h"

namespace vesselbench {

/// Something of a model that may be an artefact of its image or its segmentation. Whether it is
/// one, or a pathology, an expert decides.
struct Finding {
    std::string kind;           ///< name of its detector
    Vec3 place = Vec3::Zero();  ///< where it is worst [mm]
    double size = 0.0;          ///< radius of the sphere around it that holds it, about [mm]
    /// Probability that the named irregularity is there, and is none of a sound vessel's [-]: as
    /// docs/science/findings.md calibrates it.
    double certainty = 0.0;
    /// What was measured, in words and figures; its first remedy, if it has one, is the operation
    /// that treats it, with arguments.
    Diagnostic evidence;
    /// What it may be, likeliest first: where anatomy is among it, the finding is a question, and
    /// nothing treats it before somebody says that it is none. Empty: it is no question.
    std::vector<Reading> readings = {};

    [[nodiscard]] bool asks() const { return !readings.empty(); }

    /// "bump@12.3,4.5,6.7": kind and place, which edits elsewhere leave as they are.
    [[nodiscard]] std::string id() const;

    /// Null: no operation treats it.
    [[nodiscard]] const Remedy* treatment() const;
};

/// How many findings are listed (kListed): the first ones. \param findings those before the others
[[nodiscard]] std::size_t listed_count(std::span<const Finding> findings);

/// What an id says.
struct FindingId {
    std::string kind;
    Vec3 place = Vec3::Zero();  ///< [mm], rounded

    /// How far a place is from the id's [mm]; infinite: the id is of another kind, or the place is
    /// farther than half of this size.
    [[nodiscard]] double distance(const std::string& of_kind, const Vec3& from, double size) const;
};

/// \throw UsageError if it is no id
[[nodiscard]] FindingId finding_id_from(const std::string& id);

/// The finding that an id means: of its kind, and no farther from its place than half the finding's
/// size; the nearest of several. Null: none of them.
/// \throw UsageError if it is no id
[[nodiscard]] const Finding* finding_of_id(std::span<const Finding> findings,
                                           const std::string& id);

/// A kind that was not looked for.
struct NotSearched {
    std::string kind;
    std::string reason;  ///< in words
};

struct FindingSearch {
    std::vector<Finding> findings;          ///< the worst first
    std::vector<NotSearched> not_searched;  ///< in the order of the registry
};

/// A logistic curve of what was measured: 0.5 at `even`, 0.8 at `sure`, never nearer to 0 or 1 than
/// 0.02. `sure` may be the smaller one.
[[nodiscard]] double certainty_of(double measured, double even, double sure);

}  // namespace vesselbench
