#include <atomic>
#include <condition_variable>
#include <cstdlib>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include <catch2/catch.hpp>
#include <epoxy/gl.h>

#include "geometry/kernel/errors.h"
#include "gpu/context.h"
#include "gpu/fence.h"
#include "gpu/gpu_meter.h"
#include "gpu/gpu_smoother.h"
#include "gpu/picture.h"
#include "gpu/picture_view.h"
#include "gpu/render/drawn_device_surface.h"
#include "gpu/render/renderer.h"
#include "gpu/render/target.h"
#include "gpu/render/vertex_buffers.h"
#include "tests/gpu/device_support.h"
#include "tests/support/shapes.h"
#include "tests/support/shuffled.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

PictureOptions small() {
    PictureOptions options;
    options.width = 220;
    options.height = 180;
    return options;
}

/// Draws states of a surface from the buffers they are in, framed as `draw` frames it.
class StateDrawing {
public:
    explicit StateDrawing(std::shared_ptr<const DeviceSurface> surface)
        : surface_(std::move(surface)), drawn_(std::make_shared<DrawnDeviceSurface>(surface_)) {}

    /// \param most value at the end of the colours, if there are values
    Picture picture(const DeviceBuffers& state, const PictureOptions& options, double most = 1.0) {
        drawn_->show(state);
        SurfaceLayer layer{.source = drawn_, .map = ColourMap::Heated, .most = most};
        layer.colouring = state.values != nullptr ? Colouring::Values : Colouring::Base;
        layer.back = options.back;
        RenderTarget target(options.width, options.height);
        target.bind();
        renderer_.draw(view_of(surface_->surface(), options), {.surfaces = {layer}});
        return target.picture();
    }

private:
    std::shared_ptr<const DeviceSurface> surface_;
    std::shared_ptr<DrawnDeviceSurface> drawn_;
    Renderer renderer_;
};

/// Mean difference of two pictures' colours [-], 1 of black and white.
double difference(const Picture& a, const Picture& b) {
    REQUIRE(a.rgb.size() == b.rgb.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < a.rgb.size(); ++i) sum += std::abs(a.rgb[i] - b.rgb[i]);
    return sum / (255.0 * static_cast<double>(a.rgb.size()));
}

}  // namespace

SCENARIO("A smoothed surface is drawn from the device's buffers", "[gpu][drawing]") {
    const auto test = test_device();
    if (!test) return;
    const Surface rough = varied_surfaces().front().surface;
    const auto device = uploaded(*test, rough);
    GpuSmoother smoother(device, {});
    GpuMeter meter(device);
    StateDrawing drawing(device);
    PictureOptions options = small();
    options.frame = std::make_shared<const Surface>(rough);
    const auto picture = [&](const Buffer* values, double most) {
        return drawing.picture({&smoother.shifts(), &meter.normals(), values}, options, most);
    };
    smoother.start(LaplaceParameters{});
    meter.measure_shape(smoother.shifts());
    const Picture before = picture(nullptr, 1.0);
    CHECK(difference(before, draw(rough, options)) < 0.005);
    smoother.run(20);
    meter.measure(smoother.shifts());
    const Picture after = picture(nullptr, 1.0);
    const Surface smooth = rough.with_positions(smoother.positions());
    CHECK(difference(after, draw(smooth, options)) < 0.005);
    CHECK(difference(before, after) > 0.02);
    THEN("colours show a value at each vertex") {
        const auto errors = read_vertices<float>(*device, meter.errors());
        const double most = meter.read().front().largest_error;
        PictureOptions coloured = options;
        for (const float error : errors)
            coloured.vertex_colours.push_back(heated_colour(error / most));
        const Picture by_error = picture(&meter.errors(), most);
        CHECK(difference(by_error, draw(smooth, coloured)) < 0.005);
        CHECK(difference(by_error, after) > 0.02);
    }
    THEN("inner sides show in the colour of inner sides, as draw shows them") {
        Surface inverted = rough;
        std::vector<Triangle> turned;
        for (const auto& [a, b, c] : rough.triangles()) turned.push_back({a, c, b});
        inverted = make_surface(rough.points(), std::move(turned));
        const auto inner = uploaded(*test, inverted);
        GpuMeter inner_meter(inner);
        inner_meter.measure_shape(inner->shifts());
        const Picture found =
            StateDrawing(inner).picture({&inner->shifts(), &inner_meter.normals()}, options);
        CHECK(difference(found, draw(inverted, options)) < 0.005);
        CHECK(difference(found, before) > 0.02);
    }
}

namespace {

/// A state that another thread has made, complete behind the fence.
struct MadeState {
    int iterations = 0;
    GpuSmoother smoother;
    std::unique_ptr<GpuMeter> meter;
    Fence ready;
};

/// Smooths on a thread of its own, in a context that shares with the current one, and hands on the
/// states in buffers of their own.
class SmoothingThread {
public:
    explicit SmoothingThread(const Surface& surface, std::vector<int> iterations) {
        shared_.release();
        thread_ = std::thread([this, surface, iterations = std::move(iterations)] {
            shared_.make_current();
            const DebugOutput reports([](const std::string& text) { FAIL_CHECK(text); });
            make(surface, iterations);
            shared_.release();
            changed_.notify_all();
        });
    }

    ~SmoothingThread() { thread_.join(); }

    SmoothingThread(const SmoothingThread&) = delete;
    SmoothingThread& operator=(const SmoothingThread&) = delete;

    /// The next state; null: there are no more.
    const MadeState* next() {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return ended_ || taken_ < states_.size(); });
        return taken_ < states_.size() ? states_[taken_++].get() : nullptr;
    }

    [[nodiscard]] const std::shared_ptr<const DeviceSurface>& surface() const { return surface_; }

    std::atomic<bool> lost = false;

private:
    void make(const Surface& surface, const std::vector<int>& iterations) {
        try {
            Device device = current_device();
            device.lost = [this] { return lost.load(); };
            surface_ = std::make_shared<const DeviceSurface>(device, surface);
            static_cast<void>(surface_->triangles());  // only this thread uploads
            GpuSmoother smoother(surface_, {});
            smoother.start(LaplaceParameters{});
            for (const int count : iterations) add(smoother, count);
        } catch (const GpuUnavailable&) {
        }
        const std::lock_guard lock(mutex_);
        ended_ = true;
    }

    void add(GpuSmoother& smoother, int count) {
        smoother.run(count - smoother.iterations_done());
        GpuSmoother state = smoother.copy();
        auto meter = std::make_unique<GpuMeter>(surface_);
        meter->measure(state.shifts());
        auto made = std::make_unique<MadeState>(
            MadeState{count, std::move(state), std::move(meter), Fence()});
        const std::lock_guard lock(mutex_);
        states_.push_back(std::move(made));
        changed_.notify_all();
    }

    OffscreenContext shared_{Sharing::WithCurrent, true};
    std::shared_ptr<const DeviceSurface> surface_;
    std::mutex mutex_;  ///< of what follows
    std::condition_variable changed_;
    std::vector<std::unique_ptr<MadeState>> states_;
    std::size_t taken_ = 0;
    bool ended_ = false;
    std::thread thread_;
};

}  // namespace

SCENARIO("What another thread smooths is drawn from its buffers", "[gpu][drawing]") {
    const auto test = test_device();
    if (!test) return;
    std::vector<VertexId> numbers;
    const Surface rough = shuffled(varied_surfaces().front().surface, numbers);
    PictureOptions options = small();
    options.frame = std::make_shared<const Surface>(rough);
    SmoothingThread thread(rough, {1, 5, 20, 25});
    std::optional<StateDrawing> drawing;
    int drawn = 0;
    while (const MadeState* state = thread.next()) {
        if (!drawing) drawing.emplace(thread.surface());
        state->ready.order();
        const Picture found =
            drawing->picture({&state->smoother.shifts(), &state->meter->normals()}, options);
        const Surface smooth =
            rough.with_positions(apply_filter(*rough.topology, rough.points(), LaplaceParameters{},
                                              {.iterations = state->iterations}));
        CHECK(difference(found, draw(smooth, options)) < 0.005);
        drawn += 1;
        if (drawn == 2) thread.lost = true;  // what was handed on is still drawn
    }
    CHECK(drawn >= 2);
}

SCENARIO("What the driver refuses to draw is reported", "[gpu][drawing]") {
    auto test = test_device();
    if (!test) return;
    test->reports.reset();
    const std::vector<float> values(10, 1.0F), more(20, 1.0F);
    const Buffer buffer = make_buffer(bytes_of(values), "values");
    CHECK_NOTHROW(upload_all(buffer, bytes_of(values)));
    CHECK_THROWS_WITH(upload_all(buffer, bytes_of(more)), Catch::Contains("driver refused"));
    const std::vector<std::uint32_t> changed{3, 15};
    CHECK_THROWS_AS(upload_parts(buffer, bytes_of(more), sizeof(float), changed), GpuUnavailable);
    RenderTarget target(16, 16);
    CHECK_NOTHROW(target.picture());
    glEnable(GL_ARRAY_BUFFER);  // no capability
    CHECK_THROWS_WITH(target.picture(), Catch::Contains("a picture"));
    CHECK_NOTHROW(upload_all(buffer, bytes_of(values)));
}
