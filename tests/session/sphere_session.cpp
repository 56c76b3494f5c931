#include "tests/session/sphere_session.h"

#include <algorithm>

#include "tests/session/small_operations.h"

namespace vesselbench::test {

SessionOptions options() {
    SessionOptions made;
    made.author = "Ada";
    made.find = find_test_operation;
    made.worker = test_worker();
    return made;
}

Session sphere_session() {
    Session session = Session::unsaved(options());
    session.apply("make-sphere", {});
    return session;
}

double top_of(const Scene& scene) {
    double top = -1e9;
    for (const Vec3& p : surface_of(scene).points()) top = std::max(top, p.z());
    return top;
}

}  // namespace vesselbench::test
