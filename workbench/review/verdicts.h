#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/kernel/vec3.h"
#include "workbench/case/history.h"

namespace vesselbench {

enum class Verdict : std::uint8_t { None, Accept, Reject, Unsure };

/// "none", "accept", "reject", "unsure"
[[nodiscard]] std::string to_string(Verdict verdict);

/// A remark at a place of the model.
struct Pin {
    Vec3 place = Vec3::Zero();  ///< [mm]
    std::string text;
};

/// A distance that a reviewer measured.
struct ReviewedDistance {
    Vec3 from = Vec3::Zero(), to = Vec3::Zero();  ///< [mm]
    double length = 0.0;                          ///< [mm]
    std::string text;
};

/// What a reviewer says of one edit.
struct EditVerdict {
    EditRef edit;
    std::string hash;  ///< edit_hash() of what was reviewed
    Verdict verdict = Verdict::None;
    std::string comment;  ///< of a rejection: its reason
    std::string time;     ///< UTC; empty: when the file was written
    std::vector<Pin> pins;
    std::vector<ReviewedDistance> distances;
};

/// True of an edit that is listed only because its reviewer saw it, for a verdict on the whole.
[[nodiscard]] bool says_nothing(const EditVerdict& verdict);

/// A file of verdicts, as the review page saves it (docs/user/review.md).
struct VerdictFile {
    std::string program;
    std::string project, project_name;  ///< its lasting id; its name, for people
    std::string chain_head;             ///< of the record that the page was made from
    std::string reviewer, role;
    std::string written;  ///< UTC
    Verdict overall = Verdict::None;
    std::string overall_comment;
    std::vector<EditVerdict> edits;

    /// Number of edits of which it says something.
    [[nodiscard]] std::size_t said() const;
};

/// [bytes] of a file of verdicts.
constexpr std::size_t kLargestVerdictFile = std::size_t{16} << 20;

/// Reads verdicts of any origin. Fields that are not known are left out.
/// \param name of the text in error texts
/// \throw InvalidInput that names the file and the field
[[nodiscard]] VerdictFile verdicts_from_text(std::string_view text, const std::string& name);

/// The same for a file. \throw IoError if it cannot be read
[[nodiscard]] VerdictFile verdicts_from_file(const std::filesystem::path& file);

/// The bytes of a file of verdicts, unread.
/// \throw InvalidInput if it is larger than kLargestVerdictFile; IoError if it cannot be read
[[nodiscard]] std::string verdict_text_in(const std::filesystem::path& file);

/// The verdicts as JSON with sorted keys and without blanks: the same verdicts have the same text.
[[nodiscard]] std::string text_of(const VerdictFile& verdicts);

}  // namespace vesselbench
