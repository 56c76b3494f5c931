#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "geometry/kernel/diagnostic.h"
#include "workbench/project/record_check.h"
#include "workbench/review/signature.h"
#include "workbench/worker/run_operation.h"

namespace vesselbench {

struct AuditOptions {
    std::filesystem::path project;
    std::vector<std::string> against;  ///< witnesses_in(), which saw earlier heads
    std::filesystem::path signers;     ///< as signature_of(); empty: none are known
    bool replay = false;               ///< runs every edit of the current state again
    OperationLookup find;              ///< required
    WorkerOptions worker = {};
};

/// A project's record, verified as far as it can be.
struct Audit {
    std::string project;                  ///< the file's name without its folder
    RecordCheck record;                   ///< its findings are among `findings`
    std::vector<Diagnostic> findings;     ///< empty: everything that can be verified is
    std::vector<std::string> verified;    ///< what was verified, in words
    std::vector<std::string> unverified;  ///< what cannot be, and why
    /// How many files of verdicts in the project are signed, and how well.
    std::map<SignatureState, std::size_t> signatures;
    nlohmann::ordered_json statement;  ///< statement_of(); null: the project cannot be read
};

/// Verifies a project against its record, beside whoever writes it, and leaves it as it is.
/// \throw IoError, InvalidInput if the project cannot be read, or a file of verdicts is none; as
/// signature_of()
[[nodiscard]] Audit audit(const AuditOptions& options, const Progress& progress = {});

}  // namespace vesselbench
