#include "smoothing/quality/search_space.h"

#include <algorithm>

namespace vesselbench {

std::vector<double> chosen_values(const SearchParameter& parameter, bool coarse) {
    if (!coarse) return parameter.values;
    std::vector<double> values;
    const auto step = static_cast<std::size_t>(std::max(1, parameter.coarse));
    for (std::size_t i = 0; i < parameter.values.size(); i += step)
        values.push_back(parameter.values[i]);
    if (values.back() != parameter.values.back()) values.push_back(parameter.values.back());
    return values;
}

bool does_nothing(const SearchSpace& space, const ParameterSet& set) {
    for (std::size_t i = 0; i < set.size(); ++i)
        if (space.parameters[i].idle == set[i]) return true;
    return false;
}

}  // namespace vesselbench
