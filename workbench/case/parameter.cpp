#include "workbench/case/parameter.h"

#include <algorithm>

namespace vesselbench {

std::string to_string(const Condition& condition) {
    std::string text = condition.parameter + (condition.values.empty() ? "" : "=");
    for (std::size_t i = 0; i < condition.values.size(); ++i)
        text += (i > 0 ? " or " : "") + condition.values[i];
    return text;
}

bool holds(const Condition& condition, const Parameter& parameter, const std::string& text) {
    if (!condition.values.empty()) return std::ranges::count(condition.values, text) > 0;
    return !text.empty() && !(parameter.default_value && text == to_text(*parameter.default_value));
}

}  // namespace vesselbench
