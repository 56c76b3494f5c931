#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// What would solve a problem: an operation and its arguments, as the command line has them.
struct Remedy {
    std::string operation;
    std::map<std::string, std::string> arguments;
};

/// What is wrong, as a value: callers word it, point at it, and offer its remedies.
struct Diagnostic {
    std::string code;                       ///< "end-in-doubt"
    std::optional<Vec3> place;              ///< [mm]
    std::map<std::string, double> figures;  ///< "flow_share": 0.3
    std::vector<Remedy> remedies;           ///< each was tried; the first is the best
};

/// A failure with its diagnostics.
class DiagnosedFailure : public AlgorithmFailure {
public:
    DiagnosedFailure(const std::string& text, std::vector<Diagnostic> diagnostics)
        : AlgorithmFailure(text), diagnostics_(std::move(diagnostics)) {}

    [[nodiscard]] const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }

private:
    std::vector<Diagnostic> diagnostics_;
};

}  // namespace vesselbench
