#pragma once

#include <exception>
#include <utility>
#include <vector>

#include "geometry/kernel/diagnostic.h"
#include "geometry/kernel/errors.h"

namespace vesselbench {

/// An error that knows what is wrong, whatever its class.
class Diagnosed {
public:
    explicit Diagnosed(std::vector<Diagnostic> diagnostics);
    virtual ~Diagnosed() = default;

    /// At least one; the first one is the error's text.
    [[nodiscard]] const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }

private:
    std::vector<Diagnostic> diagnostics_;
};

/// An error of one of the classes in errors.h, with its diagnostics. Its own text is that of the
/// first diagnostic, as text_of() words it.
template <class Error>
class DiagnosedError : public Error, public Diagnosed {
public:
    /// \param diagnostics at least one; they become errors
    explicit DiagnosedError(std::vector<Diagnostic> diagnostics);

    explicit DiagnosedError(Diagnostic diagnostic)
        : DiagnosedError(std::vector<Diagnostic>{std::move(diagnostic)}) {}
};

using DiagnosedFailure = DiagnosedError<AlgorithmFailure>;
using DiagnosedInput = DiagnosedError<InvalidInput>;
using DiagnosedUsage = DiagnosedError<UsageError>;

/// What an error knows; of an error without diagnostics its text alone.
[[nodiscard]] std::vector<Diagnostic> diagnostics_of(const std::exception& error);

extern template class DiagnosedError<AlgorithmFailure>;
extern template class DiagnosedError<InvalidInput>;
extern template class DiagnosedError<UsageError>;

}  // namespace vesselbench
