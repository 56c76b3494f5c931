#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "geometry/kernel/diagnostic.h"
#include "workbench/project/record_check.h"
#include "workbench/review/entered_verdicts.h"

namespace vesselbench {

/// Somebody who saw a record's head, or something that holds it: a file of verdicts, a line of a
/// lab book, an older copy of the project.
struct Witness {
    std::string name;          ///< of the file, for error texts
    std::string who;           ///< "A. Kern", "the witness"
    std::string project;       ///< its lasting id
    std::string project_name;  ///< for people; empty: not known
    std::string head;          ///< first hexadecimal digits of an entry's hash, or all 64
    std::int64_t number = 0;   ///< of that entry; 0: not said
    std::string time;          ///< UTC, when it was seen
    std::string where;         ///< how the record differs from it; empty: not known
};

/// What a lab book keeps of a record, in one line: the project's id, the number of entries, the
/// head's hash and the time.
/// \param time UTC
[[nodiscard]] std::string witness_line(const RecordCheck& record, const std::string& time);

/// The witnesses in a file of verdicts, an older copy of the project, a text with lines as
/// witness_line() gives them, or in such a line itself. Of a head, the first 16 digits do.
/// \param given path, or a line
/// \param record that is compared with a copy
/// \throw InvalidInput if it is none of these, or contradicts itself; IoError
[[nodiscard]] std::vector<Witness> witnesses_in(const std::string& given,
                                                const RecordCheck& record);

/// Those in a project itself: the reviewers whose verdicts were entered.
[[nodiscard]] std::vector<Witness> witnesses_of(const std::vector<EnteredVerdicts>& entered);

/// The number of the record's entry that a witness saw last; 0: it has none.
[[nodiscard]] std::int64_t entry_seen(const Witness& witness, const RecordCheck& record);

/// What is wrong with a record of which not all is as the witnesses saw it: another project, cut
/// off, or rewritten, and where; empty: nothing.
[[nodiscard]] std::vector<Diagnostic> contradictions_of(std::span<const Witness> witnesses,
                                                        const RecordCheck& record);

}  // namespace vesselbench
