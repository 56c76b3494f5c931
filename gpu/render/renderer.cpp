#include "gpu/render/renderer.h"

#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <string>
#include <vector>

#include <epoxy/gl.h>

#include "gpu/render/frame.h"
#include "gpu/render/programs.h"
#include "gpu/render/vertex_buffers.h"

namespace vesselbench {

namespace {

constexpr int kScaleSteps = 256;             // gpu/shaders/surface.frag
constexpr std::size_t kPatchColours = 1024;  // gpu/shaders/surface.vert
constexpr std::size_t kLabelColours = 12;    // gpu/shaders/slice.frag
constexpr double kEdgePull = 8e-4;           // of lines over their own triangles, by the radius [-]

void enable(unsigned what, bool on) {
    if (on)
        glEnable(what);
    else
        glDisable(what);
}

/// Attributes that a source need not have.
void set_missing_attributes() {
    glVertexAttrib3f(1, 0.0F, 0.0F, 0.0F);
    glVertexAttrib1f(3, 0.0F);
    glVertexAttribI1ui(4, 0);
    glVertexAttrib4f(5, 1.0F, 1.0F, 1.0F, 1.0F);
}

bool is_opaque(const SurfaceLayer& layer) {
    return layer.opacity >= 1.0 && layer.edges != Edges::Only;
}

bool shows_values(const SurfaceLayer& layer) {
    return layer.colouring == Colouring::Values && layer.source->has_values();
}

/// Whether inner sides cannot be seen, so that half of the triangles need not be drawn.
bool hides_inner_side(const Frame& frame, const SurfaceLayer& layer) {
    if (!layer.source->is_solid() || (layer.clipped && frame.view.clip)) return false;
    const Sphere bounds = layer.source->bounds();
    const ViewCamera& camera = frame.view.camera;
    return !camera.perspective || (eye_of(camera) - bounds.centre).norm() > 1.01 * bounds.radius;
}

int highlighted_label(const SurfaceLayer& layer) {
    if (layer.highlighted) return -2;
    return layer.highlighted_patch ? static_cast<int>(*layer.highlighted_patch) : -1;
}

Colouring colouring_of(const SurfaceLayer& layer) {
    const bool missing = (layer.colouring == Colouring::Vertices && !layer.source->has_colours()) ||
                         (layer.colouring == Colouring::Values && !layer.source->has_values());
    return missing ? Colouring::Base : layer.colouring;
}

/// As it is written into a picture.
Eigen::Vector4d edge_colour_of(const SurfaceLayer& layer) {
    const PixelColour colour = pixel_colour(layer.edge_colour);
    const double own = layer.edges == Edges::Only ? layer.opacity : 1.0;
    return {colour[0] / 255.0, colour[1] / 255.0, colour[2] / 255.0, layer.edge_opacity * own};
}

/// Whether triangles are so small on the screen that lighting their vertices is enough. Software
/// renderers spend most of their time on the pixels of small triangles, of which each is computed
/// several times.
bool is_dense(const Frame& frame, const SurfaceLayer& layer) {
    constexpr double kFewPixels = 12.0;
    const Sphere bounds = layer.source->bounds();
    const double pixel = pixel_size(frame.view.camera, frame.view.rectangle.height, bounds.centre);
    if (!(pixel > 0.0)) return false;
    const double radius = bounds.radius / pixel;
    return 3.0 * radius * radius < kFewPixels * static_cast<double>(layer.source->triangle_count());
}

std::string defines_of(const Frame& frame, const SurfaceLayer& layer) {
    const bool corners = layer.source->has_corners();
    std::string text;
    if (layer.edges != Edges::Off && corners) text += "#define EDGES\n";
    if (layer.edges == Edges::Only && corners) text += "#define ONLY_EDGES\n";
    if (layer.flat)
        text += "#define FLAT\n";
    else if (is_dense(frame, layer))
        text += "#define DENSE\n";
    if (shows_values(layer)) text += "#define VALUES\n";
    if (layer.opacity < 1.0 && layer.edges != Edges::Only) text += "#define GLASS\n";
    return text;
}

void set_surface(const Uniforms& uniforms, const SurfaceLayer& layer) {
    uniforms.set("base_colour", layer.base);
    uniforms.set("colouring", static_cast<int>(colouring_of(layer)));
    uniforms.set("highlighted_patch", highlighted_label(layer));
    uniforms.set("back_colour", layer.back);
    uniforms.set("back_as_front", layer.back_as_front ? 1 : 0);
    uniforms.set("opacity", layer.opacity);
    uniforms.set("edge_width", layer.edge_width);
    uniforms.set("edge_colour", edge_colour_of(layer));
    uniforms.set("range", Eigen::Vector2d(layer.least, layer.most));
    uniforms.set("no_value", layer.no_value);
}

/// As they are written into a picture.
const std::array<Colour, kLabelColours>& label_colours() {
    static const auto colours = [] {
        std::array<Colour, kLabelColours> all;
        for (std::size_t i = 0; i < all.size(); ++i) {
            const PixelColour colour = pixel_colour(category_colour(i));
            all[i] = Colour(colour[0], colour[1], colour[2]) / 255.0F;
        }
        return all;
    }();
    return colours;
}

std::vector<Eigen::Vector4f> padded(const std::vector<Colour>& colours, std::size_t count,
                                    const Colour& rest) {
    std::vector<Eigen::Vector4f> all(count);
    for (std::size_t i = 0; i < count; ++i)
        all[i] << (i < colours.size() ? colours[i] : rest), 1.0F;
    return all;
}

void draw_triangles(const SurfaceLayer& layer) {
    const std::size_t count = layer.source->bind_triangles(layer.detail);
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * count), GL_UNSIGNED_INT, nullptr);
}

void draw_strips(std::size_t instances) {
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(instances));
}

void set_defaults() {
    for (const unsigned what : {GL_BLEND, GL_CULL_FACE, GL_DEPTH_TEST, GL_STENCIL_TEST,
                                GL_SCISSOR_TEST, GL_CLIP_DISTANCE0})
        glDisable(what);
    glDepthFunc(GL_LESS);
    glDepthMask(GL_TRUE);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    glFrontFace(GL_CCW);
}

}  // namespace

struct Renderer::Impl {
    ProgramSet programs;
    VertexArray nothing = make_vertex_array();
    std::map<ColourMap, Buffer> maps;
    Buffer patches = make_buffer(bytes_of(padded({}, kPatchColours, kWallColour)), "patch colours");

    void begin(const Frame& frame) const {
        set_defaults();
        glViewport(frame.region.x, frame.region.y, frame.region.width, frame.region.height);
        glScissor(frame.region.x, frame.region.y, frame.region.width, frame.region.height);
        glEnable(GL_SCISSOR_TEST);
        set_missing_attributes();
    }

    static void end() {
        set_defaults();
        glBindVertexArray(0);
        glUseProgram(0);
    }

    void clear(const SceneView& view) {
        glClearStencil(0);
        glClearDepth(1.0);
        if (view.background) {
            const PixelColour colour = pixel_colour(view.background->below);
            const auto part = [&](std::size_t i) { return static_cast<float>(colour[i]) / 255.0F; };
            glClearColor(part(0), part(1), part(2), 1.0F);
            glClear(GL_COLOR_BUFFER_BIT);
        }
        glClear(GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
        if (view.background && view.background->above != view.background->below)
            draw_gradient(*view.background);
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_LEQUAL);
    }

    void draw_gradient(const Background& background) {
        const Uniforms uniforms = programs.use("background", "background");
        uniforms.set("colour_above", background.above);
        uniforms.set("colour_below", background.below);
        glBindVertexArray(nothing.id());
        glDrawArrays(GL_TRIANGLES, 0, 3);
    }

    void bind_colours(const SurfaceLayer& layer) {
        if (shows_values(layer)) {
            auto map = maps.find(layer.map);
            if (map == maps.end()) {
                const auto steps = padded(colour_steps(layer.map, kScaleSteps), kScaleSteps, {});
                map = maps.emplace(layer.map, make_buffer(bytes_of(steps), "colour map")).first;
            }
            glBindBufferBase(GL_UNIFORM_BUFFER, 0, map->second.id());
        }
        glBindBufferBase(GL_UNIFORM_BUFFER, 1, patches.id());
        if (layer.colouring != Colouring::Patches) return;
        const auto colours = padded(layer.patch_colours, kPatchColours, layer.base);
        glBindBuffer(GL_UNIFORM_BUFFER, patches.id());
        glBufferSubData(GL_UNIFORM_BUFFER, 0, static_cast<GLsizeiptr>(bytes_of(colours).size()),
                        colours.data());
    }

    void use_surface(const Frame& frame, const SurfaceLayer& layer) {
        const Uniforms uniforms = programs.use("surface", "surface", defines_of(frame, layer));
        set_frame(uniforms, frame, {layer.source->bounds().centre, layer.pull, layer.clipped});
        set_surface(uniforms, layer);
        bind_colours(layer);
    }

    void draw_surface(const Frame& frame, const SurfaceLayer& layer) {
        use_surface(frame, layer);
        enable(GL_CULL_FACE, hides_inner_side(frame, layer));
        draw_triangles(layer);
        glDisable(GL_CULL_FACE);
        if (layer.edges == Edges::Over) draw_edge_lines(frame, layer);
    }

    /// Edges as lines, where the pass that fills triangles cannot draw them.
    void draw_edge_lines(const Frame& frame, const SurfaceLayer& layer) {
        if (layer.source->has_corners()) return;
        const Uniforms uniforms = programs.use("surface", "edges");
        const Sphere bounds = layer.source->bounds();
        set_frame(uniforms, frame,
                  {bounds.centre, layer.pull + kEdgePull * bounds.radius, layer.clipped});
        set_surface(uniforms, layer);
        glEnable(GL_BLEND);
        const std::size_t count = layer.source->bind_edges();
        glDrawElements(GL_LINES, static_cast<GLsizei>(2 * count), GL_UNSIGNED_INT, nullptr);
        glDisable(GL_BLEND);
    }

    void draw_edges_alone(const Frame& frame, const SurfaceLayer& layer) {
        if (!layer.source->has_corners()) return draw_edge_lines(frame, layer);
        use_surface(frame, layer);
        glEnable(GL_BLEND);
        draw_triangles(layer);
    }

    /// Back faces, then front faces.
    void draw_both_sides(const Frame& frame, const SurfaceLayer& layer) {
        use_surface(frame, layer);
        glEnable(GL_BLEND);
        glEnable(GL_CULL_FACE);
        for (const unsigned culled : {GL_FRONT, GL_BACK}) {
            glCullFace(culled);
            draw_triangles(layer);
        }
        glDisable(GL_CULL_FACE);
        if (layer.edges == Edges::Over) draw_edge_lines(frame, layer);
    }

    /// Blended, so that nothing in it hides anything.
    void draw_transparent(const Frame& frame, const SurfaceLayer& layer) {
        glDepthMask(GL_FALSE);
        if (layer.edges == Edges::Only)
            draw_edges_alone(frame, layer);
        else
            draw_both_sides(frame, layer);
        glDisable(GL_BLEND);
        glDepthMask(GL_TRUE);
    }

    /// Fills the section of a solid by the clip plane: where more back faces than front faces, or
    /// fewer, remain along a line of sight, the plane is inside.
    void draw_section(const Frame& frame, const SurfaceLayer& layer) {
        if (!layer.section || !layer.clipped || !frame.view.clip) return;
        count_faces(frame, layer);
        const Uniforms uniforms = programs.use("section", "section");
        const Sphere bounds = layer.source->bounds();
        set_frame(uniforms, frame, {bounds.centre, layer.pull});
        uniforms.set("section_colour", *layer.section);
        const auto corners = plane_corners(*frame.view.clip, bounds);
        uniforms.set("corners", std::span(corners));
        glStencilFunc(GL_NOTEQUAL, 0, 0xFF);
        glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
        glBindVertexArray(nothing.id());
        glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
        glClear(GL_STENCIL_BUFFER_BIT);
        glDisable(GL_STENCIL_TEST);
    }

    void count_faces(const Frame& frame, const SurfaceLayer& layer) {
        const Uniforms uniforms = programs.use("surface", "stencil");
        set_frame(uniforms, frame, {.centre = layer.source->bounds().centre, .clipped = true});
        glEnable(GL_STENCIL_TEST);
        glStencilFunc(GL_ALWAYS, 0, 0xFF);
        glStencilOpSeparate(GL_FRONT, GL_KEEP, GL_KEEP, GL_DECR_WRAP);
        glStencilOpSeparate(GL_BACK, GL_KEEP, GL_KEEP, GL_INCR_WRAP);
        glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
        glDepthMask(GL_FALSE);
        glDisable(GL_DEPTH_TEST);
        glEnable(GL_DEPTH_CLAMP);  // faces before the near plane count
        draw_triangles(layer);
        glDisable(GL_DEPTH_CLAMP);
        glEnable(GL_DEPTH_TEST);
        glDepthMask(GL_TRUE);
        glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    }

    void draw_slice(const Frame& frame, const SliceLayer& layer) {
        const Uniforms uniforms = programs.use("slice", "slice");
        set_frame(uniforms, frame, {layer.slice->bounds().centre});
        uniforms.set("window_level", Eigen::Vector2d(std::max(layer.window, 1e-12), layer.level));
        uniforms.set("opacity", layer.opacity);
        uniforms.set("scalars", 0);
        uniforms.set("labels", layer.labels ? 1 : 0);
        if (layer.labels) uniforms.set("label_colours", std::span(label_colours()));
        enable(GL_BLEND, layer.opacity < 1.0);
        layer.slice->bind(layer.smooth && !layer.labels);
        glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
        glBindTexture(GL_TEXTURE_2D, 0);
        glDisable(GL_BLEND);
    }

    /// What is hidden, paler, then what is not.
    template <class Draw>
    void draw_marks(const Uniforms& uniforms, double opacity, double hidden, const Draw& draw) {
        if (hidden > 0.0) {
            uniforms.set("opacity", opacity * hidden);
            glEnable(GL_BLEND);
            glDepthMask(GL_FALSE);
            glDepthFunc(GL_GREATER);
            draw();
        }
        uniforms.set("opacity", opacity);
        enable(GL_BLEND, opacity < 1.0);
        glDepthMask(GL_TRUE);
        glDepthFunc(GL_LEQUAL);
        draw();
        glDisable(GL_BLEND);
    }

    void draw_lines(const Frame& frame, const LinesLayer& layer) {
        const Uniforms uniforms = programs.use("polyline", "polyline");
        set_lines(uniforms, frame, layer, 0.5 * layer.width);
        draw_marks(uniforms, layer.opacity, layer.hidden_opacity,
                   [&] { draw_strips(layer.lines->segment_count()); });
    }

    static void set_lines(const Uniforms& uniforms, const Frame& frame, const LinesLayer& layer,
                          double half_width) {
        set_frame(uniforms, frame, {layer.lines->bounds().centre, layer.pull, layer.clipped});
        uniforms.set("half_width", half_width);
        uniforms.set("highlighted", layer.highlighted ? static_cast<int>(*layer.highlighted) : -1);
        layer.lines->bind();
    }

    void draw_points(const Frame& frame, const PointsLayer& layer) {
        const Uniforms uniforms = programs.use("points", "points");
        set_points(uniforms, frame, layer);
        draw_marks(uniforms, layer.opacity, layer.hidden_opacity,
                   [&] { draw_strips(layer.points->count()); });
    }

    static void set_points(const Uniforms& uniforms, const Frame& frame, const PointsLayer& layer) {
        const Vec3 centre = layer.points->bounds().centre;
        set_frame(uniforms, frame, {centre, mark_pull(frame.view, centre)});
        uniforms.set("highlighted", layer.highlighted ? static_cast<int>(*layer.highlighted) : -1);
        layer.points->bind();
    }

    void draw(const Frame& frame, const Layers& layers) {
        const auto slices = [&](bool opaque) {
            for (const SliceLayer& layer : layers.slices)
                if ((layer.opacity >= 1.0) == opaque) draw_slice(frame, layer);
        };
        slices(true);
        for (const SurfaceLayer& layer : layers.surfaces) {
            if (is_opaque(layer)) draw_surface(frame, layer);
            draw_section(frame, layer);
        }
        for (const LinesLayer& layer : layers.lines) draw_lines(frame, layer);
        for (const PointsLayer& layer : layers.points) draw_points(frame, layer);
        slices(false);
        for (const SurfaceLayer& layer : layers.surfaces)
            if (!is_opaque(layer)) draw_transparent(frame, layer);
    }

    [[nodiscard]] Uniforms use_ids(const std::string& vertex, std::uint32_t layer, PickKind kind) {
        const Uniforms uniforms = programs.use(vertex, "pick");
        uniforms.set("layer", layer);
        uniforms.set("kind", static_cast<std::uint32_t>(kind));
        uniforms.set("by_primitive", kind == PickKind::Surface ? 1 : 0);
        return uniforms;
    }

    void draw_surface_ids(const Frame& frame, const SurfaceLayer& layer) {
        const Uniforms uniforms = use_ids("surface", layer.id, PickKind::Surface);
        set_frame(uniforms, frame, {layer.source->bounds().centre, layer.pull, layer.clipped});
        draw_triangles(layer);
    }

    void draw_slice_ids(const Frame& frame, const SliceLayer& layer) {
        const Uniforms uniforms = use_ids("slice", layer.id, PickKind::Slice);
        set_frame(uniforms, frame, {layer.slice->bounds().centre});
        layer.slice->bind(layer.smooth);
        glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    }

    /// What shows through surfaces is picked through them.
    void draw_ids(const Frame& frame, const Layers& layers) {
        for (const SliceLayer& layer : layers.slices)
            if (layer.id != 0) draw_slice_ids(frame, layer);
        for (const SurfaceLayer& layer : layers.surfaces)
            if (layer.id != 0) draw_surface_ids(frame, layer);
        for (const LinesLayer& layer : layers.lines) {
            if (layer.id == 0) continue;
            set_lines(use_ids("polyline", layer.id, PickKind::Line), frame, layer,
                      0.5 * layer.width);
            glDepthFunc(layer.hidden_opacity > 0.0 ? GL_ALWAYS : GL_LEQUAL);
            draw_strips(layer.lines->segment_count());
        }
        for (const PointsLayer& layer : layers.points) {
            if (layer.id == 0) continue;
            set_points(use_ids("points", layer.id, PickKind::Point), frame, layer);
            glDepthFunc(layer.hidden_opacity > 0.0 ? GL_ALWAYS : GL_LEQUAL);
            draw_strips(layer.points->count());
        }
    }
};

Renderer::Renderer() : impl_(std::make_unique<Impl>()) {}

Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

void Renderer::draw(const SceneView& view, const Layers& layers) {
    if (view.rectangle.width < 1 || view.rectangle.height < 1) return;
    const Frame frame = make_frame(view, layers, view.rectangle);
    impl_->begin(frame);
    impl_->clear(view);
    impl_->draw(frame, layers);
    Impl::end();
}

void Renderer::draw_ids(const SceneView& view, const Layers& layers, const PixelRectangle& region) {
    Frame frame = make_frame(view, layers, region);
    frame.region.x = frame.region.y = 0;
    impl_->begin(frame);
    constexpr std::array<unsigned, 4> kNothing{};
    glClearBufferuiv(GL_COLOR, 0, kNothing.data());
    glClear(GL_DEPTH_BUFFER_BIT);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);
    impl_->draw_ids(frame, layers);
    Impl::end();
}

}  // namespace vesselbench
