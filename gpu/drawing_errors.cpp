#include "gpu/drawing_errors.h"

#include <epoxy/gl.h>

#include "geometry/kernel/errors.h"

namespace vesselbench {

void forget_drawing_errors() {
    constexpr int kMost = 8;  // a lost context reports its own error forever
    for (int i = 0; i < kMost && drawing_has_failed(); ++i) continue;
}

bool drawing_has_failed() {
    return glGetError() != GL_NO_ERROR;
}

void require_drawn(const std::string& what) {
    const unsigned error = glGetError();
    if (error == GL_NO_ERROR) return;
    if (error == GL_OUT_OF_MEMORY) throw GpuUnavailable("the device is out of memory for " + what);
    throw GpuUnavailable("the driver refused " + what + " (OpenGL error " + std::to_string(error) +
                         ")");
}

}  // namespace vesselbench
