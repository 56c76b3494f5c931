#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// What becomes of an operation or an edit.
enum class RemedyAction {
    Give,        ///< it gets the arguments
    Remove,      ///< the edit is left out
    ChooseAgain  ///< the edit decides again what it decided by itself
};

/// What would solve a problem: an operation and its arguments, by the names of the operations'
/// table.
struct Remedy {
    std::string operation;  ///< empty: the one that the diagnostic is about
    std::map<std::string, std::string> arguments = {};  ///< without a value: choose one
    /// It is an edit of its own that comes first; what was refused is tried again after it.
    bool before = false;
    RemedyAction action = RemedyAction::Give;

    bool operator==(const Remedy&) const = default;
};

enum class Severity { Warning, Error };

/// What is wrong, as a value: callers word it, point at it, and offer its remedies. The catalogue
/// has a text for every code.
struct Diagnostic {
    std::string code;  ///< "end-in-doubt"
    Severity severity = Severity::Warning;
    std::string operation = {};                       ///< that it is about; empty: the one that ran
    std::optional<std::int64_t> edit = std::nullopt;  ///< that it is about, where it is known
    std::optional<Vec3> place = std::nullopt;         ///< [mm]
    std::map<std::string, double> figures = {};       ///< "flow_share": 0.3
    std::map<std::string, std::string> words = {};    ///< names in its text, "opening": "outlet_1"
    std::vector<Remedy> remedies = {};                ///< the first is the best

    bool operator==(const Diagnostic&) const = default;
};

/// The code of a text without one, as old projects have: its words are under the same name.
inline constexpr const char* kPlainText = "text";

[[nodiscard]] inline Diagnostic plain_text(std::string text) {
    return {.code = kPlainText, .words = {{kPlainText, std::move(text)}}};
}

}  // namespace vesselbench
