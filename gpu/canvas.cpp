#include "gpu/canvas.h"

#include <algorithm>
#include <array>

#include <Eigen/LU>
#include <epoxy/gl.h>

#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

constexpr int kSamples = 4;
constexpr int kLargestSide = 8192;

void attach(const Renderbuffer& buffer, unsigned format, unsigned where, std::array<int, 3> size) {
    glBindRenderbuffer(GL_RENDERBUFFER, buffer.id());
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, size[2], format, size[0], size[1]);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, where, GL_RENDERBUFFER, buffer.id());
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

}  // namespace

void require_size(const PictureOptions& options) {
    if (std::min(options.width, options.height) < 1 ||
        std::max(options.width, options.height) > kLargestSide)
        throw InvalidInput("a picture must be 1 to 8192 pixels wide and high");
}

Camera camera_for(const Positions& points, const Vec3& centre, const PictureOptions& options) {
    const Vec3 back = -options.view.normalized();
    const Vec3 right = options.up.cross(back).normalized();
    Eigen::Matrix3d eye;
    eye << right.transpose(), back.cross(right).transpose(), back.transpose();
    if (!(eye.determinant() > 0.5))
        throw InvalidInput("the view direction and the up direction must not be parallel");
    Vec3 reach = Vec3::Constant(1e-9);
    double radius = 0.0;
    for (const Vec3& p : points) {
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

void set_matrices(const Program& program, const Camera& camera) {
    glUseProgram(program.id());
    glUniformMatrix4fv(glGetUniformLocation(program.id(), "to_clip"), 1, GL_FALSE,
                       camera.to_clip.data());
    glUniformMatrix3fv(glGetUniformLocation(program.id(), "to_eye"), 1, GL_FALSE,
                       camera.to_eye.data());
}

Canvas::Target::Target(int width, int height, int samples) {
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

Canvas::Canvas(int width, int height)
    : width_(width), height_(height), multisampled_(width, height, kSamples) {
    glViewport(0, 0, width, height);
    glClearColor(1.0F, 1.0F, 1.0F, 1.0F);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glEnable(GL_DEPTH_TEST);
}

Picture Canvas::picture() const {
    const Target plain(width_, height_, 0);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, multisampled_.frame.id());
    glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT,
                      GL_NEAREST);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, plain.frame.id());
    return read_back(width_, height_);
}

}  // namespace vesselbench
