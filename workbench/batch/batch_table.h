#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "workbench/batch/plan.h"

namespace vesselbench {

enum class CaseState {
    NotRun,
    Done,
    Failed,
    DoneByHand  ///< it failed, and was finished in its project
};

[[nodiscard]] std::string to_string(CaseState state);

/// A case in the table. It has neither times nor folders: equal cases give equal rows, however
/// often, in which order and in how many processes they were run.
struct TableRow {
    std::string name;
    std::string input;  ///< the name it was given (--name), or its file's without the folder
    CaseState state = CaseState::NotRun;
    std::string review;                      ///< review_state()
    std::vector<std::string> warnings;       ///< with their operations
    std::vector<std::string> warning_codes;  ///< each once
    std::vector<std::string> not_met;        ///< requirements
    std::size_t findings = 0;                ///< of what looks wrong, 50 % certain or more
    nlohmann::ordered_json figures;          ///< by TableFigure::name; null: it has none
    std::optional<CaseFailure> failure;
    std::string thumbnail;  ///< a PNG file's bytes; empty: none
};

/// Failures with one code.
struct FailureGroup {
    std::string code;
    std::vector<std::string> cases;
    std::string text;  ///< of the first case
    std::vector<std::string> remedies;
};

struct BatchTable {
    std::string purpose;
    std::vector<TableRow> rows;          ///< in the order of the manifest
    std::vector<FailureGroup> failures;  ///< the most frequent first, then by code
    std::size_t questions = 0;           ///< cases on the page of questions

    [[nodiscard]] std::size_t count(CaseState state) const;
};

/// Reads what the cases' folders hold: reports, and reviews at this moment.
[[nodiscard]] BatchTable batch_table(const std::vector<PlannedCase>& cases,
                                     const BatchOptions& options);

/// For spreadsheets (RFC 4180). No text begins like a formula.
[[nodiscard]] std::string table_csv(const BatchTable& table);

[[nodiscard]] nlohmann::ordered_json table_json(const BatchTable& table);

}  // namespace vesselbench
