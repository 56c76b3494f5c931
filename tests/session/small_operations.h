#pragma once

#include "workbench/case/operation.h"
#include "workbench/worker/worker.h"

namespace vesselbench::test {

/// Small operations for testing sessions and workers:
/// - `make-sphere` (source): `radius`, `levels`, `centre`; decides `centre` if it is absent
/// - `load-sphere` (source): reads a radius from the text file `file`
/// - `make-image` (source): an image of `edge`^3 voxels, read from `file` as load-sphere does
/// - `bump` (source to remeshing, usually local-repair): pushes the vertices within `reach` of `at`
///   by `height` along z; decides `height` if it is absent; fails if there is none
/// - `scale` (remeshing): by `factor`
/// - `flatten` (openings): sets z to 0, and one attribute, patches and a volume mesh
/// - `stroke` (local-repair, live): waves of `heights`, which add up; fails at a height of 0
/// - `stubborn` (local-repair): sleeps `seconds` without checking for a cancel
/// - isolated: `far-bump` (as bump), `crash`, `crash-on-file`, `hang`, `greedy`, `refuse`, `act`
[[nodiscard]] const Operation& find_test_operation(const std::string& name);

/// Starts the helper program of these tests as a worker that knows the operations above.
[[nodiscard]] WorkerOptions test_worker();

/// Path of the helper program: `worker`, `edit PROJECT`, `hold PROJECT`.
[[nodiscard]] std::string helper_program();

}  // namespace vesselbench::test
