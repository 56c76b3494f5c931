#include "geometry/kernel/diagnosed_error.h"

#include "geometry/kernel/diagnostic_text.h"

namespace vesselbench {

Diagnosed::Diagnosed(std::vector<Diagnostic> diagnostics) : diagnostics_(std::move(diagnostics)) {
    for (Diagnostic& diagnostic : diagnostics_) diagnostic.severity = Severity::Error;
}

template <class Error>
DiagnosedError<Error>::DiagnosedError(std::vector<Diagnostic> diagnostics)
    : Error(text_of(diagnostics.at(0))), Diagnosed(std::move(diagnostics)) {}

std::vector<Diagnostic> diagnostics_of(const std::exception& error) {
    if (const auto* diagnosed = dynamic_cast<const Diagnosed*>(&error))
        return diagnosed->diagnostics();
    Diagnostic text = plain_text(error.what());
    text.severity = Severity::Error;
    return {text};
}

template class DiagnosedError<AlgorithmFailure>;
template class DiagnosedError<InvalidInput>;
template class DiagnosedError<UsageError>;

}  // namespace vesselbench
