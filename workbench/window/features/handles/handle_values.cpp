#include "workbench/window/features/handles/handle_values.h"

#include "workbench/case/argument_texts.h"

namespace vesselbench {

namespace {

constexpr double kNormalSteps = 1e4;  ///< so that typed directions stay short

}  // namespace

FieldText point_text(const std::string& name, const Vec3& point) {
    return {name, to_text(Value(rounded_place(point)))};
}

FieldText direction_text(const std::string& name, const Vec3& direction) {
    const Vec3 rounded =
        (direction.normalized() * kNormalSteps).array().round() / kNormalSteps + 0.0;
    return {name, to_text(Value(rounded))};
}

}  // namespace vesselbench
