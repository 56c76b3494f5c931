#include "workbench/suggest/dragged_values.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "workbench/suggest/processing_subject.h"

namespace vesselbench {

Arguments with_nearest_values(const Operation& operation, Arguments given, const SearchSpace& space,
                              bool coarse) {
    for (const SearchParameter& parameter : space.parameters) {
        if (!given.has(parameter.name)) continue;
        const double value = given.real(parameter.name);
        if (value < parameter.values.front() || value > parameter.values.back()) continue;
        std::vector<double> values = chosen_values(parameter, coarse);
        // The operation may not know the value that leaves the surface as it is.
        if (parameter.idle != value) std::erase(values, parameter.idle);
        const double nearest =
            *std::ranges::min_element(values, {}, [&](double v) { return std::abs(v - value); });
        set_values(given, operation, {.parameters = {parameter}, .chooser = {}}, {nearest});
    }
    return given;
}

void set_current_values(SensitivityAnalysis& analysis, const Arguments& given) {
    for (QualityCurve& curve : analysis.curves)
        if (given.has(curve.name)) curve.current = given.real(curve.name);
}

}  // namespace vesselbench
