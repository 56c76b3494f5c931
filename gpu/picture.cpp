#include "gpu/picture.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include <Eigen/LU>
#include <epoxy/gl.h>

#include "geometry/errors.h"
#include "gpu/context.h"
#include "gpu/objects.h"

namespace vesselbench {

namespace {

constexpr int kSamples = 4;
constexpr int kLargestSide = 8192;

/// Attributes of three corners per triangle: patches and sharp shading need corners of their own.
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

/// Corners of another surface, whose colours do not count.
std::vector<Corner> wire_corners(const Surface& wires, const Vec3& centre,
                                 const PictureOptions& options) {
    PictureOptions plain = options;
    plain.vertex_colours.clear();
    return corners(wires, centre, plain);
}

struct Camera {
    Eigen::Matrix4f to_clip = Eigen::Matrix4f::Identity();
    Eigen::Matrix3f to_eye = Eigen::Matrix3f::Identity();
};

/// Orthographic: the eye looks along -z of a right-handed frame; everything within the model's
/// sphere is in depth.
Camera camera_for(const Surface& surface, const Vec3& centre, const PictureOptions& options) {
    const Vec3 back = -options.view.normalized();
    const Vec3 right = options.up.cross(back).normalized();
    Eigen::Matrix3d eye;
    eye << right.transpose(), back.cross(right).transpose(), back.transpose();
    if (!(eye.determinant() > 0.5))
        throw InvalidInput("the direction of sight and the up direction must not be parallel");
    Vec3 reach = Vec3::Constant(1e-9);
    double radius = 0.0;
    for (const Vec3& p : surface.points()) {
        reach = reach.cwiseMax((eye * (p - centre)).cwiseAbs());
        radius = std::max(radius, (p - centre).norm());
    }
    const double aspect = static_cast<double>(options.width) / options.height;
    const double fitting = 1.06 * std::max(reach.y(), reach.x() / aspect) / options.zoom;
    const double half_height = options.half_height > 0.0 ? options.half_height : fitting;
    Eigen::Matrix4d clip = Eigen::Matrix4d::Identity();
    clip.topLeftCorner<3, 3>() =
        Vec3(1.0 / (half_height * aspect), 1.0 / half_height, -0.5 / radius).asDiagonal() * eye;
    clip.topRightCorner<3, 1>() = -clip.topLeftCorner<3, 3>() * options.shift;
    return {clip.cast<float>(), eye.cast<float>()};
}

/// A framebuffer with colour and depth of one size.
struct Target {
    Framebuffer frame;
    Renderbuffer colour, depth;

    Target(int width, int height, int samples) {
        unsigned ids[3];
        glGenFramebuffers(1, &ids[0]);
        glGenRenderbuffers(2, &ids[1]);
        frame = Framebuffer(ids[0]);
        colour = Renderbuffer(ids[1]);
        depth = Renderbuffer(ids[2]);
        glBindFramebuffer(GL_FRAMEBUFFER, frame.id());
        attach(colour, GL_RGBA8, GL_COLOR_ATTACHMENT0, {width, height, samples});
        attach(depth, GL_DEPTH_COMPONENT24, GL_DEPTH_ATTACHMENT, {width, height, samples});
        if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
            throw GpuUnavailable("the device offers no framebuffer for a picture of this size");
    }

    static void attach(const Renderbuffer& buffer, unsigned format, unsigned where,
                       std::array<int, 3> size) {
        glBindRenderbuffer(GL_RENDERBUFFER, buffer.id());
        glRenderbufferStorageMultisample(GL_RENDERBUFFER, size[2], format, size[0], size[1]);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, where, GL_RENDERBUFFER, buffer.id());
    }
};

void set_matrices(const Program& program, const Camera& camera) {
    glUseProgram(program.id());
    glUniformMatrix4fv(glGetUniformLocation(program.id(), "to_clip"), 1, GL_FALSE,
                       camera.to_clip.data());
    glUniformMatrix3fv(glGetUniformLocation(program.id(), "to_eye"), 1, GL_FALSE,
                       camera.to_eye.data());
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

// How far edges are pulled towards the eye, by the depth of the model: over their own triangles,
// and over a smoothed surface that rose above the original.
constexpr float kOwnPull = 2e-4F, kWirePull = 1e-2F;

/// The edges of the corners that are bound.
void draw_edges(GLsizei count, const Camera& camera, float pull) {
    const Program lines = make_program("lines");
    set_matrices(lines, camera);
    glUniform4f(glGetUniformLocation(lines.id(), "line_colour"), 0.1F, 0.1F, 0.12F, 1.0F);
    glUniform1f(glGetUniformLocation(lines.id(), "pull"), pull);
    glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    glDrawArrays(GL_TRIANGLES, 0, count);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
}

void draw_corners(const std::vector<Corner>& list, const Camera& camera, bool edges) {
    const Buffer buffer = make_buffer(std::as_bytes(std::span(list)), "surface corners");
    const VertexArray array = describe_corners();
    const auto count = static_cast<GLsizei>(list.size());
    const Program surface = make_program("surface");
    set_matrices(surface, camera);
    glDrawArrays(GL_TRIANGLES, 0, count);
    if (edges) draw_edges(count, camera, kOwnPull);
}

/// Edges of another surface over what is drawn already.
void draw_wires(const std::vector<Corner>& list, const Camera& camera) {
    const Buffer buffer = make_buffer(std::as_bytes(std::span(list)), "wire corners");
    const VertexArray array = describe_corners();
    draw_edges(static_cast<GLsizei>(list.size()), camera, kWirePull);
}

Picture read_back(int width, int height) {
    Picture picture{width, height, {}};
    const auto row = static_cast<std::size_t>(width) * 3;
    std::vector<std::uint8_t> upside_down(row * static_cast<std::size_t>(height));
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, upside_down.data());
    for (int y = height - 1; y >= 0; --y) {
        const auto* first = upside_down.data() + static_cast<std::size_t>(y) * row;
        picture.rgb.insert(picture.rgb.end(), first, first + row);
    }
    return picture;
}

void check(const Surface& surface, const PictureOptions& options) {
    if (surface.empty()) throw InvalidInput("there is no surface to draw");
    if (std::min(options.width, options.height) < 1 ||
        std::max(options.width, options.height) > kLargestSide)
        throw InvalidInput("a picture must be 1 to 8192 pixels wide and high");
    if (!options.vertex_colours.empty() && options.vertex_colours.size() != surface.vertex_count())
        throw InvalidInput("there must be one colour per vertex");
}

}  // namespace

Picture draw(const Surface& surface, const PictureOptions& options) {
    check(surface, options);
    const Surface& frame = options.frame ? *options.frame : surface;
    Eigen::AlignedBox3d box;
    for (const Vec3& p : frame.points()) box.extend(p);
    const Camera camera = camera_for(frame, box.center(), options);
    const OffscreenContext context;
    const Target multisampled(options.width, options.height, kSamples);
    glViewport(0, 0, options.width, options.height);
    glClearColor(1.0F, 1.0F, 1.0F, 1.0F);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glEnable(GL_DEPTH_TEST);
    draw_corners(corners(surface, box.center(), options), camera, options.edges);
    if (options.wires) draw_wires(wire_corners(*options.wires, box.center(), options), camera);
    const Target plain(options.width, options.height, 0);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, multisampled.frame.id());
    glBlitFramebuffer(0, 0, options.width, options.height, 0, 0, options.width, options.height,
                      GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, plain.frame.id());
    return read_back(options.width, options.height);
}

}  // namespace vesselbench
