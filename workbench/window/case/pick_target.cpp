#include "workbench/window/case/pick_target.h"

namespace vesselbench {

bool is_in_slices(PickTarget target) {
    return target == PickTarget::Voxel || target == PickTarget::Labels;
}

std::optional<PickTarget> pick_target(const Parameter& parameter) {
    switch (parameter.meaning) {
        case Meaning::Place:
            return PickTarget::Surface;
        case Meaning::Tip:
        case Meaning::Branch:
            return parameter.type == ParameterType::List ? PickTarget::Ends : PickTarget::Tip;
        case Meaning::Inlet:
            return PickTarget::Opening;
        case Meaning::Seed:
            return PickTarget::Voxel;
        case Meaning::Box:
            return PickTarget::Corners;
        case Meaning::Labels:
            return PickTarget::Labels;
        default:
            return std::nullopt;
    }
}

std::string pick_instruction(PickTarget target) {
    switch (target) {
        case PickTarget::Surface:
            return "Click a place on the surface";
        case PickTarget::Tip:
            return "Click a vessel end or a dome";
        case PickTarget::Opening:
            return "Click an opening; one that is chosen is removed";
        case PickTarget::Ends:
            return "Click a vessel end or a dome; one that is chosen is removed";
        case PickTarget::Corners:
            return "Click two opposite corners";
        case PickTarget::Voxel:
            return "Click a place in a slice";
        case PickTarget::Labels:
            return "Click labels in a slice, again to remove them";
    }
    return "";
}

}  // namespace vesselbench
