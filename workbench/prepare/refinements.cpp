#include "workbench/prepare/refinements.h"

#include <algorithm>
#include <sstream>
#include <vector>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/printable.h"
#include "workbench/operations/table.h"

namespace vesselbench {

namespace {

/// The operation that makes edges of a length around a place.
const Operation& refining_operation() {
    const auto takes = [](const Operation& row, const char* name) {
        return std::ranges::find(row.parameters, name, &Parameter::name) != row.parameters.end();
    };
    return *std::ranges::find_if(operation_table(), [&](const Operation& row) {
        return takes(row, "at") && takes(row, "within") && takes(row, "edge");
    });
}

std::vector<std::string> parts_between_colons(const std::string& text) {
    std::vector<std::string> parts;
    std::istringstream stream(text);
    for (std::string part; std::getline(stream, part, ':');) parts.push_back(part);
    return parts;
}

}  // namespace

Recipe refinements(std::span<const std::string> texts) {
    Recipe entries;
    for (const std::string& text : texts) {
        const std::vector<std::string> parts = parts_between_colons(text);
        if (parts.size() != 3)
            throw UsageError("--refine '" + printable(text) +
                             "': give x,y,z:radius:edge in mm, such as 3,1.5,-20:4:0.1");
        GivenArguments given(refining_operation());
        given.set("at", parts[0]);
        given.set("within", parts[1]);
        given.set("edge", parts[2]);
        entries.push_back({.given = std::move(given)});
    }
    return entries;
}

void add_entries(Recipe& recipe, const Recipe& entries) {
    for (const RecipeEntry& entry : entries)
        recipe.insert(
            std::ranges::find_if(
                recipe, [&](const RecipeEntry& other) { return step_of(other) > step_of(entry); }),
            entry);
}

}  // namespace vesselbench
