#pragma once

#include <string>
#include <vector>

namespace vesselbench {

/// The command line's options of a search for an operation's parameters.
struct SubjectOptions {
    std::string source;     ///< a project or a surface file
    std::string units;      ///< of a surface file; empty: mm
    std::string operation;  ///< empty: the first of searched_operations()
    std::string variant;    ///< of a project, for operations of steps 4-8; empty: variant_meant()
    std::string filter;     ///< for operations with filters; empty: as they decide
    std::vector<std::string> arguments;  ///< "parameter=value" of the operation, which are kept
};

}  // namespace vesselbench
