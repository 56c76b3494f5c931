#include "workbench/window/view/edit_anchors.h"

#include <algorithm>

#include "workbench/window/case/edit_places.h"
#include "workbench/window/case/readable.h"

namespace vesselbench {

std::vector<NamedPlace> edit_anchors(const Snapshot& snapshot, const std::string& variant) {
    std::vector<NamedPlace> anchors;
    for (const LogEntry& entry : snapshot.log) {
        if (!is_part_of(entry.edit.place, variant)) continue;
        const std::string name =
            std::to_string(entry.edit.edit.id) + "  " + readable(entry.edit.operation);
        for (const Vec3& point : places_of_edit(entry)) {
            const NamedPlace anchor{.point = point, .name = name};
            if (std::ranges::count(anchors, anchor) == 0) anchors.push_back(anchor);
        }
    }
    return anchors;
}

}  // namespace vesselbench
