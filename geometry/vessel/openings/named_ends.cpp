#include "geometry/vessel/openings/named_ends.h"

#include <algorithm>
#include <limits>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

/// A point this far from an end without a centerline does not mean it [diameters].
constexpr double kStubReach = 1.5;

std::size_t end_meant(const std::vector<SurfaceEnd>& ends, const Vec3& point,
                      const std::string& parameter) {
    if (const auto end = end_near(ends, point)) return *end;
    const auto nearest = std::ranges::min_element(
        ends, {}, [&](const SurfaceEnd& e) { return (e.centre - point).norm(); });
    throw DiagnosedFailure({.code = "no-end-near",
                            .operation = "clip-opening",
                            .place = nearest->centre,
                            .words = {{"meant", parameter == "inlet" ? "the inlet" : "an opening"},
                                      {"given", place_text(point)}}});
}

void name_inlets(PlanDraft& draft) {
    for (const Vec3& point : draft.options().inlets) {
        const std::size_t end = end_meant(draft.ends(), point, "inlet");
        if (draft.is_inlet(end))
            throw DiagnosedFailure({.code = "one-end-twice",
                                    .operation = "clip-opening",
                                    .place = draft.ends()[end].centre});
        draft.name_inlet(end);
    }
}

/// The end without a line that a point means: it is near, and nearer than all others.
EndRecord* stub_near(PlanDraft& draft, const Vec3& point) {
    const auto end = end_near(draft.ends(), point);
    double least =
        end ? (draft.ends()[*end].centre - point).norm() : std::numeric_limits<double>::infinity();
    EndRecord* found = nullptr;
    for (EndRecord& record : draft.stubs())
        if (const double d = (record.place - point).norm();
            d < least && d <= kStubReach * record.diameter) {
            least = d;
            found = &record;
        }
    return found;
}

void leave_closed(PlanDraft& draft) {
    for (const Vec3& point : draft.options().closed) {
        if (EndRecord* stub = stub_near(draft, point)) {
            stub->asked = true;
            stub->why = "left closed as asked";
            continue;
        }
        const auto end = end_near(draft.ends(), point);
        if (!end)
            throw DiagnosedFailure(
                {.code = "no-end-to-close", .operation = "clip-opening", .place = point});
        draft.record(*end).asked = true;
        draft.close(*end, "left closed as asked");
    }
}

}  // namespace

void decide_named_ends(PlanDraft& draft) {
    name_inlets(draft);
    for (const Vec3& point : draft.options().open)
        draft.want(end_meant(draft.ends(), point, "open"));
    for (std::size_t e = 0; e < draft.ends().size(); ++e)
        draft.record(e).wanted = draft.is_wanted(e);
    leave_closed(draft);
}

}  // namespace vesselbench
