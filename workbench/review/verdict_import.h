#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "geometry/kernel/progress.h"
#include "workbench/review/review.h"
#include "workbench/review/signature.h"
#include "workbench/review/verdicts.h"
#include "workbench/session/session.h"

namespace vesselbench {

/// What became of a file of verdicts.
struct ImportedVerdicts {
    VerdictFile verdicts;
    Signature signature;
    bool known = false;        ///< the same verdicts were entered before
    std::size_t outdated = 0;  ///< verdicts on what is another edit or result now
};

/// "3 verdicts and one on the whole model of A. Kern, signed by kern@clinic.example, 1 of them on
/// what has changed since"
[[nodiscard]] std::string imported_words(const ImportedVerdicts& imported);

/// Enters a reviewer's verdicts into the project, once, with the signature beside the file if there
/// is one. Signed ones are entered beside the same verdicts without a signature.
/// \param signers whose signature is required, see signature_of(); empty: none is, and one beside
/// the file may be by any key
/// \throw InvalidInput that names the file and the field, also by check_before_entering(), or if
/// the signature does not verify or is missing; IoError; as signature_of()
ImportedVerdicts import_verdicts(Session& session, const std::filesystem::path& file,
                                 const std::filesystem::path& signers = {},
                                 const Progress& progress = {});

/// Who reviews.
struct Reviewer {
    std::string name, role;
};

/// Enters what somebody who reviews in the program says of an edit, with the time of the call and
/// without a signature.
/// \param verdict its hash is that of the edit the reviewer saw
/// \throw as import_verdicts(): a rejection without a reason, a reviewer without a name
ImportedVerdicts enter_verdict(Session& session, const Reviewer& reviewer, EditVerdict verdict);

/// The same of the whole model.
/// \param seen its edits as the reviewer saw them: the verdict holds while they are the same
ImportedVerdicts enter_overall(Session& session, const Reviewer& reviewer, const Review& seen,
                               Verdict verdict, const std::string& comment);

}  // namespace vesselbench
