#pragma once

#include <functional>
#include <string>

#include "geometry/kernel/diagnostic.h"

namespace vesselbench {

/// How a remedy is worded for those who read it.
using RemedyWords = std::function<std::string(const Diagnostic&, const Remedy&)>;

/// "remesh edge=0.2"; of the diagnostic's own operation the arguments alone.
[[nodiscard]] std::string plain_remedy(const Diagnostic& diagnostic, const Remedy& remedy);

/// The diagnostic as a sentence. Of a code that the catalogue lacks: the code, its words and its
/// figures.
[[nodiscard]] std::string text_of(const Diagnostic& diagnostic,
                                  const RemedyWords& remedy_words = plain_remedy);

/// A catalogue's text with a diagnostic's values, as text_of() does.
/// \throw std::out_of_range if a value outside brackets is not known
[[nodiscard]] std::string filled(const char* text, const Diagnostic& diagnostic,
                                 const RemedyWords& remedy_words = plain_remedy);

}  // namespace vesselbench
