#include "gpu/render/pick.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include <epoxy/gl.h>

#include "geometry/kernel/errors.h"
#include "gpu/drawing_errors.h"
#include "gpu/objects.h"

namespace vesselbench {

namespace {

constexpr int kLargestRadius = 4;  // [pixels]
constexpr int kSide = 2 * kLargestRadius + 1;
constexpr std::size_t kPixels = kSide * kSide;

/// A pixel of Renderer::draw_ids.
struct Found {
    std::uint32_t layer = 0, element = 0, depth = 0, kind = 0;
};

using FoundPixels = std::array<Found, kPixels>;

/// A search that was started.
struct Search {
    SceneView view;
    PixelRectangle region;
    int x = 0, y = 0;
};

/// The searched pixels that are in the view.
PixelRectangle region_around(const PixelRectangle& all, int x, int y, int radius) {
    const int left = std::max(x - radius, all.x),
              right = std::min(x + radius + 1, all.x + all.width);
    const int low = std::max(y - radius, all.y),
              high = std::min(y + radius + 1, all.y + all.height);
    return {left, low, right - left, high - low};
}

Vec3 place_of(const Search& search, int x, int y, double depth) {
    const PixelRectangle& all = search.view.rectangle;
    const Vec3 seen(2.0 * (x - all.x + 0.5) / all.width - 1.0,
                    2.0 * (y - all.y + 0.5) / all.height - 1.0, depth);
    return unproject(search.view.camera, all.aspect(), seen);
}

/// Points win over lines, these over slices and surfaces; then the nearest pixel.
Picked best_of(const Search& search, const FoundPixels& pixels) {
    std::pair<int, int> best{0, 0};
    Picked picked;
    for (int y = 0; y < search.region.height; ++y)
        for (int x = 0; x < search.region.width; ++x) {
            const Found& found = pixels[static_cast<std::size_t>(y * search.region.width + x)];
            if (found.layer == 0) continue;
            const int px = search.region.x + x, py = search.region.y + y;
            const int across = px - search.x, up = py - search.y;
            constexpr auto kThin = static_cast<std::uint32_t>(PickKind::Line);
            const std::pair<int, int> rank{found.kind >= kThin ? static_cast<int>(found.kind) : 1,
                                           -(across * across + up * up)};
            if (picked.layer != 0 && rank <= best) continue;
            best = rank;
            picked = {found.layer, found.element,
                      place_of(search, px, py, std::bit_cast<float>(found.depth))};
        }
    return picked;
}

Buffer make_readback() {
    unsigned id = 0;
    glGenBuffers(1, &id);
    Buffer buffer(id);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, id);
    glBufferData(GL_PIXEL_PACK_BUFFER, sizeof(FoundPixels), nullptr, GL_STREAM_READ);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    return buffer;
}

}  // namespace

struct Picker::Impl {
    Renderer& renderer;
    Framebuffer frame;
    Renderbuffer ids, depth;
    Buffer readback = make_readback();
    GLsync fence = nullptr;
    Search search;

    explicit Impl(Renderer& drawing) : renderer(drawing) {
        int before = 0;
        glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &before);
        unsigned id = 0;
        glGenFramebuffers(1, &id);
        frame = Framebuffer(id);
        glBindFramebuffer(GL_FRAMEBUFFER, id);
        ids = make_renderbuffer(GL_RGBA32UI, kSide, kSide, 0);
        depth = make_renderbuffer(GL_DEPTH_COMPONENT24, kSide, kSide, 0);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, ids.id());
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth.id());
        const bool complete = glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
        glBindFramebuffer(GL_FRAMEBUFFER, static_cast<unsigned>(before));
        if (!complete) throw GpuUnavailable("the device offers no framebuffer of integers");
    }

    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    ~Impl() { forget(); }

    void forget() {
        if (fence != nullptr) glDeleteSync(std::exchange(fence, nullptr));
    }

    void start(const Layers& layers) {
        int before = 0;
        glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &before);
        glBindFramebuffer(GL_FRAMEBUFFER, frame.id());
        const PixelRectangle& region = search.region;
        if (region.width > 0 && region.height > 0) {
            renderer.draw_ids(search.view, layers, region);
            glBindBuffer(GL_PIXEL_PACK_BUFFER, readback.id());
            glPixelStorei(GL_PACK_ALIGNMENT, 4);
            glReadPixels(0, 0, region.width, region.height, GL_RGBA_INTEGER, GL_UNSIGNED_INT,
                         nullptr);
            glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
        }
        fence = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
        glFlush();
        glBindFramebuffer(GL_FRAMEBUFFER, static_cast<unsigned>(before));
    }

    /// None: it takes longer.
    [[nodiscard]] std::optional<Picked> result_within(GLuint64 nanoseconds) {
        const unsigned state = glClientWaitSync(fence, GL_SYNC_FLUSH_COMMANDS_BIT, nanoseconds);
        if (state == GL_TIMEOUT_EXPIRED) return std::nullopt;
        forget();
        return state == GL_WAIT_FAILED ? Picked{} : read();
    }

    [[nodiscard]] Picked read() const {
        forget_drawing_errors();
        FoundPixels pixels{};
        glBindBuffer(GL_PIXEL_PACK_BUFFER, readback.id());
        glGetBufferSubData(GL_PIXEL_PACK_BUFFER, 0, sizeof pixels, pixels.data());
        glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
        return drawing_has_failed() ? Picked{} : best_of(search, pixels);
    }
};

Picker::Picker(Renderer& renderer) : impl_(std::make_unique<Impl>(renderer)) {}

Picker::~Picker() = default;
Picker::Picker(Picker&&) noexcept = default;
Picker& Picker::operator=(Picker&&) noexcept = default;

void Picker::request(const SceneView& view, const Layers& layers, int x, int y, int radius) {
    impl_->forget();
    impl_->search = {
        view, region_around(view.rectangle, x, y, std::clamp(radius, 0, kLargestRadius)), x, y};
    impl_->start(layers);
}

void Picker::forget() {
    impl_->forget();
}

bool Picker::pending() const {
    return impl_->fence != nullptr;
}

std::optional<Picked> Picker::result() {
    return pending() ? impl_->result_within(0) : std::nullopt;
}

Picked Picker::pick(const SceneView& view, const Layers& layers, int x, int y, int radius) {
    request(view, layers, x, y, radius);
    std::optional<Picked> found;
    while (!found) found = impl_->result_within(1'000'000'000);
    return *found;
}

}  // namespace vesselbench
