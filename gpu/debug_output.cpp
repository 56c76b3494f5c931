#include "gpu/debug_output.h"

#include <cstdlib>
#include <string_view>
#include <utility>

#include <epoxy/gl.h>

namespace vesselbench {

namespace {

void GLAPIENTRY pass_on(GLenum, GLenum type, GLuint, GLenum severity, GLsizei, const GLchar* text,
                        const void* report) {
    if (type == GL_DEBUG_TYPE_ERROR || severity == GL_DEBUG_SEVERITY_HIGH)
        (*static_cast<const DebugReport*>(report))(text);
}

}  // namespace

DebugOutput::DebugOutput(DebugReport report) : report_(std::move(report)) {
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(pass_on, &report_);
}

DebugOutput::~DebugOutput() {
    glDebugMessageCallback(nullptr, nullptr);
}

bool wants_debug_output() {
#ifdef NDEBUG
    const char* asked = std::getenv("VESSELBENCH_GL_DEBUG");
    return asked != nullptr && std::string_view(asked) == "1";
#else
    return true;
#endif
}

}  // namespace vesselbench
