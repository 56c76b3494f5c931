#include "workbench/window/model/edit_anchors.h"

#include <algorithm>

#include "workbench/operations/table.h"
#include "workbench/window/model/pick_target.h"
#include "workbench/window/model/readable.h"

namespace vesselbench {

namespace {

/// The arguments of an edit, those that it decided by itself too.
Arguments arguments_of(const LogEntry& entry) {
    Arguments all = entry.edit.given;
    if (!entry.result) return all;
    for (const auto& [name, value] : entry.result->resolved.values())
        if (!all.has(name)) all.set(name, value);
    return all;
}

const Operation* operation_of(const LogEntry& entry) {
    const auto table = operation_table();
    const auto found = std::ranges::find(table, entry.edit.operation, &Operation::name);
    return found == table.end() ? nullptr : &*found;
}

}  // namespace

std::vector<NamedPlace> edit_anchors(const Snapshot& snapshot, const std::string& variant) {
    std::vector<NamedPlace> anchors;
    for (const LogEntry& entry : snapshot.log) {
        const std::string& own = entry.edit.place.variant;
        const Operation* operation = operation_of(entry);
        if (operation == nullptr || (!own.empty() && own != variant)) continue;
        const std::string name =
            std::to_string(entry.edit.edit.id) + "  " + readable(operation->name);
        const Arguments arguments = arguments_of(entry);
        for (const Parameter& parameter : operation->parameters) {
            if (!arguments.has(parameter.name) || !pick_target(parameter)) continue;
            const Value& value = arguments.values().at(parameter.name);
            const auto* point = std::get_if<Vec3>(&value);
            const auto same = [&](const NamedPlace& place) {
                return point != nullptr && place.point == *point && place.name == name;
            };
            if (point != nullptr && std::ranges::none_of(anchors, same))
                anchors.push_back({.point = *point, .name = name});
        }
    }
    return anchors;
}

}  // namespace vesselbench
