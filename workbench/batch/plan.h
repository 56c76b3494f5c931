#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "workbench/batch/answers.h"
#include "workbench/batch/batch_case.h"
#include "workbench/batch/case_folder.h"
#include "workbench/batch/case_record.h"

namespace vesselbench {

/// How the cases of a batch are run.
struct BatchOptions {
    BatchFolders folders;
    std::string purpose;
    CaseLimits limits;
    std::size_t jobs = 1;                ///< cases at the same time; 0: as many as a cluster takes
    bool retry = false;                  ///< also those that have failed
    std::filesystem::path answers = {};  ///< a file of new ones; empty: none
};

/// A case and what is known of it.
struct PlannedCase {
    BatchCase what;  ///< with its answers
    std::string key;
    nlohmann::ordered_json files;  ///< FileDigests::json()
    std::string sha256;            ///< of its input; behind a blank that of its mask
    bool outdated = false;         ///< it has answers, but for other files: they are left out
    std::size_t input_bytes = 0;
    std::optional<CaseRecord> record;  ///< of the same key: it is finished
};

/// True if a record is of this case and need not be made again: limits count for what failed by
/// them alone, and with `retry` what failed or lost its report is made again, but for what a person
/// has finished since.
[[nodiscard]] bool is_current(const CaseRecord& record, const PlannedCase& one,
                              const BatchOptions& options);

/// What a result depends on: SHA-256 of the case's arguments, the contents of its files, the
/// purpose, and the program. Where the files and the results lie does not matter.
/// \param program its digest
/// \param answers of any cases
[[nodiscard]] PlannedCase planned(const BatchCase& one, const BatchOptions& options,
                                  const std::string& program, const Answers& answers = {});

/// Those cases, in their order. \throw IoError if the program's file cannot be read
[[nodiscard]] std::vector<PlannedCase> planned(const std::vector<BatchCase>& cases,
                                               const BatchOptions& options,
                                               const Answers& answers = {});

/// True for a case without a model that a person has finished in its project since.
[[nodiscard]] bool is_finished_by_hand(const PlannedCase& one, const BatchFolders& folders);

}  // namespace vesselbench
