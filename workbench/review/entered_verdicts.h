#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "workbench/project/chain.h"
#include "workbench/project/project.h"
#include "workbench/review/signature.h"
#include "workbench/review/verdicts.h"

namespace vesselbench {

/// A file of verdicts that was entered into a project.
struct EnteredVerdicts {
    VerdictFile verdicts;
    Signature signature;
    std::string key;  ///< signing_key() of the signature; empty: not signed
};

/// What was entered into a project, in that order.
/// \param signers as signature_of()
/// \throw InvalidInput if stored verdicts are damaged; also as signature_of()
[[nodiscard]] std::vector<EnteredVerdicts> entered_verdicts(
    const ProjectFile& project, const std::filesystem::path& signers = {},
    const Progress& progress = {});

/// The same for who has read the record already. \param record its entries
[[nodiscard]] std::vector<EnteredVerdicts> entered_verdicts(
    const ProjectFile& project, std::span<const ChainEntry> record,
    const std::filesystem::path& signers = {}, const Progress& progress = {});

/// What counts where signatures are required: verdicts whose signature verifies, and rejections
/// always. Anyone can write an unsigned verdict in another's name: it may stop a model, but neither
/// let it pass nor take a rejection back.
[[nodiscard]] std::vector<EnteredVerdicts> signed_or_rejecting(
    std::vector<EnteredVerdicts> entered);

}  // namespace vesselbench
