#pragma once

#include "workbench/session/session.h"

namespace vesselbench::test {

/// Top of make-sphere's default sphere [mm].
inline const Vec3 kTop(1.0, 2.0, 10.0 + 1.0 / 3.0);

/// The author Ada, the small operations, and the worker that knows them.
[[nodiscard]] SessionOptions options();

/// A session without a file, whose only edit is the default sphere.
[[nodiscard]] Session sphere_session();

/// Largest z of the scene's surface [mm].
[[nodiscard]] double top_of(const Scene& scene);

}  // namespace vesselbench::test
