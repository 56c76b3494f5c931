#include "gpu/picture.h"

#include <cmath>
#include <cstddef>
#include <utility>

#include <epoxy/gl.h>

#include "geometry/kernel/errors.h"
#include "gpu/canvas.h"
#include "gpu/context.h"
#include "gpu/objects.h"

namespace vesselbench {

namespace {

/// Attributes of three corners per triangle: patches and sharp shading need separate corners.
struct Corner {
    Eigen::Vector3f position, normal;
    Colour colour;
};

Colour patch_colour(const Surface& surface, TriangleId t) {
    static const Colour outlets[] = {
        {0.10F, 0.28F, 0.62F}, {0.08F, 0.42F, 0.52F}, {0.28F, 0.20F, 0.58F}};
    const std::uint16_t label = (*surface.patch_labels)[t];
    switch (surface.patches[label].kind) {
        case PatchKind::Wall:
            return {0.72F, 0.42F, 0.34F};
        case PatchKind::Inlet:
            return {0.15F, 0.55F, 0.12F};
        case PatchKind::Outlet:
            return outlets[label % 3];
        case PatchKind::Cut:
            return {0.75F, 0.60F, 0.10F};
    }
    return Colour::Ones();
}

/// Vertex normals from the triangles of one patch only, so that rims of caps stay sharp.
Eigen::Vector3f corner_normal(const Surface& surface, TriangleId t, VertexId v, bool sharp) {
    Vec3 sum = area_normal(surface.points(), surface.triangles()[t]);
    if (!sharp) {
        sum.setZero();
        for (const TriangleId other : surface.topology->triangles_at().row(v))
            if ((*surface.patch_labels)[other] == (*surface.patch_labels)[t])
                sum += area_normal(surface.points(), surface.triangles()[other]);
    }
    return sum.normalized().cast<float>();
}

std::vector<Corner> corners(const Surface& surface, const Vec3& centre,
                            const PictureOptions& options) {
    std::vector<Corner> list;
    list.reserve(surface.triangle_count() * 3);
    for (TriangleId t = 0; t < surface.triangle_count(); ++t)
        for (const VertexId v : surface.triangles()[t]) {
            const Colour colour = options.vertex_colours.empty() ? patch_colour(surface, t)
                                                                 : options.vertex_colours[v];
            list.push_back({(surface.points()[v] - centre).cast<float>(),
                            corner_normal(surface, t, v, options.sharp), colour});
        }
    return list;
}

/// Corners of another surface, without colours.
std::vector<Corner> wire_corners(const Surface& wires, const Vec3& centre,
                                 const PictureOptions& options) {
    PictureOptions plain = options;
    plain.vertex_colours.clear();
    return corners(wires, centre, plain);
}

VertexArray describe_corners() {
    unsigned id = 0;
    glGenVertexArrays(1, &id);
    VertexArray array(id);
    glBindVertexArray(id);
    const std::size_t offsets[] = {offsetof(Corner, position), offsetof(Corner, normal),
                                   offsetof(Corner, colour)};
    for (unsigned i = 0; i < 3; ++i) {
        glEnableVertexAttribArray(i);
        glVertexAttribPointer(i, 3, GL_FLOAT, GL_FALSE, sizeof(Corner),
                              reinterpret_cast<const void*>(offsets[i]));
    }
    return array;
}

// How far edges are pulled towards the eye, relative to the depth of the model: over their own
// triangles, and over a smoothed surface that rose above the original.
constexpr float kOwnPull = 2e-4F, kWirePull = 1e-2F;

/// The edges of the bound corners.
void draw_edges(GLsizei count, const Camera& camera, float pull) {
    const Program lines = make_program("lines");
    set_matrices(lines, camera);
    glUniform4f(glGetUniformLocation(lines.id(), "line_colour"), 0.1F, 0.1F, 0.12F, 1.0F);
    glUniform1f(glGetUniformLocation(lines.id(), "pull"), pull);
    glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    glDrawArrays(GL_TRIANGLES, 0, count);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
}

void draw_corners(const Program& surface, const std::vector<Corner>& list, const Camera& camera,
                  const PictureOptions& options) {
    const Buffer buffer = make_buffer(std::as_bytes(std::span(list)), "surface corners");
    const VertexArray array = describe_corners();
    const auto count = static_cast<GLsizei>(list.size());
    set_matrices(surface, camera);
    glUniform3fv(glGetUniformLocation(surface.id(), "back_colour"), 1, options.back.data());
    glDrawArrays(GL_TRIANGLES, 0, count);
    if (options.edges) draw_edges(count, camera, kOwnPull);
}

/// Draws the edges of another surface over the current drawing.
void draw_wires(const std::vector<Corner>& list, const Camera& camera) {
    const Buffer buffer = make_buffer(std::as_bytes(std::span(list)), "wire corners");
    const VertexArray array = describe_corners();
    draw_edges(static_cast<GLsizei>(list.size()), camera, kWirePull);
}

void check(const Surface& surface, const PictureOptions& options) {
    if (surface.empty()) throw InvalidInput("there is no surface to draw");
    require_size(options);
    if (!options.vertex_colours.empty() && options.vertex_colours.size() != surface.vertex_count())
        throw InvalidInput("there must be one colour per vertex");
}

Picture drawn(const Surface& surface, const PictureOptions& options, const Program& program) {
    const Surface& frame = options.frame ? *options.frame : surface;
    Eigen::AlignedBox3d box;
    for (const Vec3& p : frame.points()) box.extend(p);
    const Camera camera = camera_for(frame.points(), box.center(), options);
    const Canvas canvas(options.width, options.height);
    draw_corners(program, corners(surface, box.center(), options), camera, options);
    if (options.wires) draw_wires(wire_corners(*options.wires, box.center(), options), camera);
    return canvas.picture();
}

}  // namespace

Vec3 upward_for(const Vec3& view) {
    return std::abs(view.z()) < 0.95 ? Vec3(0, 0, 1) : Vec3(0, -1, 0);
}

std::vector<Picture> draw_views(const Surface& surface, std::span<const PictureOptions> views) {
    for (const PictureOptions& options : views) check(surface, options);
    const OffscreenContext context;
    const Program program = make_program("surface");
    std::vector<Picture> pictures;
    for (const PictureOptions& options : views)
        pictures.push_back(drawn(surface, options, program));
    return pictures;
}

Picture draw(const Surface& surface, const PictureOptions& options) {
    return std::move(draw_views(surface, std::span(&options, 1)).front());
}

}  // namespace vesselbench
