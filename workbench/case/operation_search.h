#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/kernel/surface.h"
#include "workbench/case/arguments.h"
#include "workbench/case/scene.h"

namespace vesselbench {

struct SmoothingSubject;  // workbench/operations/smoothing_subject.h

/// The values of one parameter in a search; its unit is in the operation's row.
struct SearchedParameter {
    std::string name;
    std::vector<double> values;  ///< ascending
    int coarse = 1;              ///< the first pass uses every n-th value, and the last
    std::optional<double> idle = std::nullopt;  ///< value without any effect
    /// Its value if neither the arguments nor the operation's decisions have one, from the surfaces
    /// before and after a run. Null: one of them always has.
    double (*value_if_open)(const Surface& before, const Surface& after) = nullptr;
};

/// A search skips values that make more triangles than this, to bound its time.
constexpr double kMostSearchedTriangles = 4e6;

/// The search of an operation's parameters for a good surface (thesis 6.5): of whole runs without
/// their figures (`parameters`), or of iterations of a filter, on any device (`smoothing`). Without
/// either, the operation is not searched.
struct OperationSearch {
    /// The searched values on a surface. \param all parameters, for graphs
    std::vector<SearchedParameter> (*parameters)(const Surface& surface, bool all) = nullptr;
    std::vector<std::string> rivals = {};  ///< parameters that replace the searched ones
    bool counts_triangles = false;         ///< the operation is meant to reduce the triangles
    bool strong_is_first =
        false;  ///< the smallest value of the first parameter is the strongest change

    /// The filter and its inputs on a scene.
    /// \param given by the user
    /// \param arguments the same with defaults; receives the operation's decisions
    SmoothingSubject (*smoothing)(const Scene& scene, const Arguments& given,
                                  Arguments& arguments) = nullptr;
    std::string filter_parameter = {};  ///< of `smoothing`: selects the filter

    std::string hint = {};  ///< for help texts: what an argument makes of the search; may be empty

    [[nodiscard]] bool possible() const { return parameters != nullptr || smoothing != nullptr; }
};

}  // namespace vesselbench
