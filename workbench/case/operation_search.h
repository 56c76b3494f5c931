#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/kernel/surface.h"

namespace vesselbench {

/// The values of one parameter in a search; its unit is in the operation's row.
struct SearchedParameter {
    std::string name;
    std::vector<double> values;  ///< ascending
    int coarse = 1;              ///< the first pass uses every n-th value, and the last
    std::optional<double> idle = std::nullopt;  ///< value without any effect
};

/// A search skips values that make more triangles than this, to bound its time.
constexpr double kMostSearchedTriangles = 4e6;

/// The search of an operation's parameters for a good surface (thesis 6.5).
struct OperationSearch {
    enum class By {
        Nothing,  ///< they cannot be searched
        Filter,   ///< iterations of the filter selected by its arguments, on any device
        Runs      ///< whole runs of the operation without its figures
    };

    By by = By::Nothing;
    /// For By::Runs: the searched values on a surface. \param all parameters, for graphs
    std::vector<SearchedParameter> (*parameters)(const Surface& surface, bool all) = nullptr;
    std::vector<std::string> rivals = {};  ///< parameters that replace the searched ones
    bool counts_triangles = false;         ///< the operation is meant to reduce the triangles
    bool strong_is_first =
        false;  ///< the smallest value of the first parameter is the strongest change
};

}  // namespace vesselbench
