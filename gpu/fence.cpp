#include "gpu/fence.h"

#include <epoxy/gl.h>

namespace vesselbench {

namespace {

GLsync sync_of(void* sync) {
    return static_cast<GLsync>(sync);
}

}  // namespace

Fence::Fence() : sync_(glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0)) {
    glFlush();  // or another context would wait for ever
}

Fence::~Fence() {
    if (sync_ != nullptr) glDeleteSync(sync_of(sync_));
}

void Fence::order() const {
    glWaitSync(sync_of(sync_), 0, GL_TIMEOUT_IGNORED);
}

bool Fence::reached() const {
    const GLenum state = glClientWaitSync(sync_of(sync_), 0, 0);
    return state == GL_ALREADY_SIGNALED || state == GL_CONDITION_SATISFIED;
}

}  // namespace vesselbench
