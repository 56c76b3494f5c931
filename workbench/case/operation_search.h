#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/kernel/surface.h"

namespace vesselbench {

/// The values of one parameter that a search goes through; its unit is in the operation's row.
struct SearchedParameter {
    std::string name;
    std::vector<double> values;  ///< ascending
    int coarse = 1;              ///< the first look takes every so many-th value, and the last
    std::optional<double> idle = std::nullopt;  ///< with which nothing changes, whatever the others
};

/// A search leaves values out that make more triangles than this: it must end.
constexpr double kMostSearchedTriangles = 4e6;

/// How the parameters of an operation are searched for a good surface (thesis 6.5).
struct OperationSearch {
    enum class By {
        Nothing,  ///< they cannot be searched
        Filter,   ///< iterations of the filter that its arguments choose, on any device
        Runs      ///< whole runs of the operation without its figures
    };

    By by = By::Nothing;
    /// Of By::Runs: what is searched on a surface. \param all parameters, for graphs
    std::vector<SearchedParameter> (*parameters)(const Surface& surface, bool all) = nullptr;
    std::vector<std::string> rivals = {};  ///< parameters that stand in for those searched
    bool counts_triangles = false;         ///< fewer triangles are what the operation is for
    bool strong_is_first = false;  ///< the smallest value of the first parameter changes most
};

}  // namespace vesselbench
