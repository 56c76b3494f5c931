#include "workbench/case/former_arguments.h"

#include <string>

#include "workbench/case/operation.h"

namespace vesselbench {

namespace {

/// A parameter whose default decides otherwise than its operation did before there was one. Every
/// run stores it, so that only older edits lack it.
struct Former {
    const char* operation;
    const char* parameter;
    const char* value;
    const char* beside;  ///< a parameter without which it has no effect
};

constexpr Former kFormer[] = {
    // Coordinates were taken as LPS, whatever the file stated.
    {"load-surface", "space", "lps", "file"},
    {"load-neighbour", "space", "lps", "file"},
};

}  // namespace

Arguments with_former_arguments(const Operation& operation, Arguments resolved) {
    for (const Former& former : kFormer)
        if (operation.name == former.operation && !resolved.has(former.parameter) &&
            resolved.has(former.beside))
            resolved.set(former.parameter, std::string(former.value));
    return resolved;
}

}  // namespace vesselbench
