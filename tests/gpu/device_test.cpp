#include "gpu/device.h"

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "gpu/compute.h"
#include "gpu/shader_source.h"
#include "tests/gpu/device_support.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;

namespace {

using Texts = std::map<std::string, std::string>;

}  // namespace

SCENARIO("An insufficient driver is reported with what is missing", "[gpu][device]") {
    DeviceLimits limits{.major = 4,
                        .minor = 3,
                        .renderer = "some device",
                        .largest_storage_block = 1 << 27,
                        .largest_group_count = 65535,
                        .storage_blocks = 8};
    CHECK_NOTHROW(require_compute(limits));
    CHECK_FALSE(is_software(limits));
    limits.renderer = "llvmpipe (LLVM 15.0.6, 256 bits)";
    CHECK(is_software(limits));
    limits.minor = 2;
    CHECK_THROWS_WITH(require_compute(limits), Contains("OpenGL 4.2") && Contains("4.3"));
    limits = {.major = 4, .minor = 6, .largest_group_count = 65535, .storage_blocks = 4};
    CHECK_THROWS_WITH(require_compute(limits), Contains("4 storage buffers"));
}

SCENARIO("Included texts appear in a shader once, and messages name their lines", "[gpu][device]") {
    const Texts texts = {
        {"a.comp", "#version 430 core\n#include \"b.glsl\"\n#include \"b.glsl\"\nlast\n"},
        {"b.glsl", "one\ntwo\n"}};
    const ShaderSource source = assemble_shader(texts, "a.comp");
    CHECK(source.text == "#version 430 core\n#line 1 1\none\ntwo\n#line 3 0\n#line 4 0\nlast\n");
    CHECK(explained_log(texts, source, "1:2(7): error: no two\n") ==
          "b.glsl:2: error: no two\n    two\n");
    CHECK(explained_log(texts, source, "0(4) : error C0000: no last\n") ==
          "a.comp:4: error C0000: no last\n    last\n");
    CHECK(explained_log(texts, source, "ERROR: 1:1: no one\n") == "b.glsl:1: no one\n    one\n");
    CHECK(explained_log(texts, source, "something else\n") == "something else\n");
    CHECK_THROWS_AS(assemble_shader(texts, "c.comp"), GpuUnavailable);
    CHECK(
        assemble_shader({{"a.comp", "#version 430 core\n#include \"b.glsl\"\n#again \"b.glsl\"\n"},
                         {"b.glsl", "one\n"}},
                        "a.comp")
            .text == "#version 430 core\n#line 1 1\none\n#line 3 0\n#line 1 2\none\n#line 4 0\n");
}

SCENARIO("A shader that does not compile is reported by file and line", "[gpu][device]") {
    auto test = test_device();
    if (!test) return;
    test->reports.reset();
    const Texts texts = {{"wrong.comp",
                          "#version 430 core\nlayout(local_size_x = 1) in;\n#include "
                          "\"part.glsl\"\nvoid main() {}\n"},
                         {"part.glsl", "float f() {\n    return no_such_thing;\n}\n"}};
    test->device.shaders = &texts;
    CHECK_THROWS_WITH(make_compute_program(test->device, "wrong"),
                      Contains("wrong.comp does not compile") && Contains("part.glsl:2") &&
                          Contains("return no_such_thing"));
}

SCENARIO("Data that does not fit the device is reported with its size", "[gpu][device]") {
    auto test = test_device();
    if (!test) return;
    test->device.limits.largest_storage_block = 1000;
    CHECK_THROWS_WITH(make_storage(test->device, 1001, "positions"),
                      Contains("positions takes 1001 bytes") && Contains("1000"));
    test->device.limits.largest_storage_block = std::size_t{1} << 60;
    test->reports.reset();
    CHECK_THROWS_WITH(make_storage(test->device, std::size_t{1} << 52, "positions"),
                      Contains("out of memory for positions"));
}

SCENARIO("Storage keeps its values, and the device's time is measured", "[gpu][device]") {
    const auto test = test_device();
    if (!test) return;
    const std::vector<float> values = {1.0F, 2.5F, -3.0F};
    const Buffer buffer = make_storage(test->device, std::span<const float>(values), "values");
    const Buffer copy = make_storage(test->device, 3 * sizeof(float), "copy");
    const DeviceTimer timer;
    timer.start();
    copy_storage(test->device, buffer, copy, 3 * sizeof(float));
    timer.stop();
    CHECK(read_storage<float>(test->device, copy, 3) == values);
    CHECK(timer.milliseconds() >= 0.0);
}

SCENARIO("What is asked of a device is counted", "[gpu][device]") {
    const auto test = test_device();
    if (!test) return;
    const DeviceCounts before = *test->device.counts;
    const std::vector<float> values(100, 1.0F);
    const Buffer from = make_storage(test->device, std::span<const float>(values), "from");
    const Buffer to = make_storage(test->device, 400, "to");
    copy_storage(test->device, from, to, 400);
    CHECK(read_storage<float>(test->device, to, 100) == values);
    const DeviceCounts counts = since(before, *test->device.counts);
    CHECK(counts.allocations == 3);  // one to read through
    CHECK(counts.uploaded == 400);
    CHECK(counts.copied == 800);
    CHECK(counts.reads == 1);
    CHECK(counts.read_back == 400);
    CHECK(counts.dispatches == 0);
    CHECK_THAT(text_of(counts), Contains("0 dispatches") && Contains("800 copied"));
}
