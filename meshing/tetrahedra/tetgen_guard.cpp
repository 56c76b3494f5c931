#include "meshing/tetrahedra/tetgen_guard.h"

// TetGen 1.5 reports every error through the weak function terminatetetgen(), which frees the mesh
// and then throws, so that unwinding frees it a second time (SIGSEGV). This strong definition
// replaces it at link time and only throws; the mesh's own destructor frees the memory once. The
// file must not include tetgen.h, which defines the function inline. tetgen_run.cpp refers to it,
// so that the linker pulls it out of the static library.
class tetgenmesh;

// NOLINTNEXTLINE(readability-identifier-naming): the name is TetGen's.
__attribute__((visibility("default"))) void terminatetetgen(tetgenmesh* /*mesh*/, int code) {
    throw code;
}

namespace vesselbench {

bool tetgen_guard_is_linked() {
    return true;
}

}  // namespace vesselbench
