#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "geometry/kernel/vec3.h"
#include "workbench/batch/batch_case.h"
#include "workbench/prepare/end_question.h"

namespace vesselbench {

/// The file of answers that a batch keeps in its folder, and that its page saves.
inline constexpr const char* kAnswers = "answers.json";

struct AnsweredEnd {
    Vec3 place = Vec3::Zero();  ///< [mm]
    EndRole role = EndRole::Closed;

    bool operator==(const AnsweredEnd&) const = default;
};

/// What somebody answered to the question of a case.
struct CaseAnswers {
    std::string sha256;  ///< PlannedCase::sha256 of the files that the question was about
    std::vector<AnsweredEnd> ends;

    bool operator==(const CaseAnswers&) const = default;
};

/// By the cases' names.
using Answers = std::map<std::string, CaseAnswers>;

/// Reads a file of answers:
///
///     {"answers": [{"case": name, "sha256": digest,
///                   "ends": [{"place_mm": [x, y, z], "answer": "inlet"|"open"|"closed"}, ...]},
///                   ...]}
///
/// \throw InvalidInput that names the place in it; IoError if it cannot be read
[[nodiscard]] Answers answers_in(const std::filesystem::path& file);

/// The text of such a file.
[[nodiscard]] std::string text_of(const Answers& answers);

/// The case with its answers in place of its own inlet, open and close: as places, since an end's
/// number may change. Doubts are not accepted with them, so that an end which nobody was asked
/// about is neither opened nor closed by an answer about others.
[[nodiscard]] BatchCase answered(BatchCase one, const CaseAnswers& answers);

}  // namespace vesselbench
