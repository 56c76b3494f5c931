#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "workbench/batch/case_process.h"

namespace vesselbench {

/// Why a case has no model.
struct CaseFailure {
    std::string code;  ///< of its diagnostic, or "bad-input", "wrong-usage", "failed", "crashed",
                       ///< "killed", "time-limit", "memory-limit"
    std::string text;
    std::vector<std::string> remedies;  ///< "clip-opening.accept_doubts=true"; the best one first
};

/// What a batch keeps of a case that it has finished, in the case's folder.
struct CaseRecord {
    std::string key;               ///< case_key() of what was run
    nlohmann::ordered_json files;  ///< FileDigests::json()
    std::optional<CaseFailure> failure;
    CaseLimits limits;
    double seconds = 0.0, peak_mib = 0.0;  ///< as CaseRun
    std::size_t input_bytes = 0;
};

/// True if a batch has left its file in a case's folder, also if that is damaged.
[[nodiscard]] bool has_record(const std::filesystem::path& folder);

/// None: the case is not finished, or its record cannot be read.
[[nodiscard]] std::optional<CaseRecord> read_record(const std::filesystem::path& folder);

/// Written completely or not at all: where it is, the case is finished.
/// \throw IoError
void write_record(const std::filesystem::path& folder, const CaseRecord& record);

/// Why a run of `prepare --json` has failed; none: it has not.
[[nodiscard]] std::optional<CaseFailure> failure_of(const CaseRun& run, const CaseLimits& limits);

}  // namespace vesselbench
