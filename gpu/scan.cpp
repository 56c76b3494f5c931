#include "gpu/scan.h"

#include <cstdint>

#include <epoxy/gl.h>

namespace vesselbench {

namespace {

constexpr std::size_t kEach = 4;  // numbers per invocation (gpu/shaders/scan.comp)

}  // namespace

void add_up(const DeviceSurface& surface, const Buffer& numbers, std::size_t count) {
    const Device& device = surface.device();
    const std::size_t invocations = (count + kEach - 1) / kEach, groups = group_count(invocations);
    const Buffer sums = make_storage(device, groups * sizeof(std::uint32_t), "sums of groups");
    const Program& program = surface.program("scan");
    const auto pass = [&](bool of_groups) {
        bind_storage({&numbers, &sums});
        glUseProgram(program.id());
        glUniform1ui(1, static_cast<unsigned>(count));
        glUniform1i(2, of_groups ? 1 : 0);
        dispatch(device, program, invocations);
    };
    pass(false);
    if (groups <= 1) return;
    add_up(surface, sums, groups);
    pass(true);
}

}  // namespace vesselbench
