#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>

namespace vesselbench {

/// An OpenGL object's name, owned: move-only, deleted with the owner while its context must be
/// current.
template <void (*Delete)(unsigned)>
class GlObject {
public:
    GlObject() = default;

    explicit GlObject(unsigned id) : id_(id) {}

    ~GlObject() {
        if (id_ != 0) Delete(id_);
    }

    GlObject(GlObject&& other) noexcept : id_(std::exchange(other.id_, 0)) {}

    GlObject& operator=(GlObject&& other) noexcept {
        std::swap(id_, other.id_);
        return *this;
    }

    [[nodiscard]] unsigned id() const { return id_; }

    /// Forgets the object without deleting it, when its context is not current any more.
    void leave() const { id_ = 0; }

private:
    mutable unsigned id_ = 0;
};

void delete_buffer(unsigned id);
void delete_program(unsigned id);
void delete_vertex_array(unsigned id);
void delete_framebuffer(unsigned id);
void delete_renderbuffer(unsigned id);
void delete_query(unsigned id);
void delete_texture(unsigned id);

using Buffer = GlObject<delete_buffer>;
using Program = GlObject<delete_program>;
using VertexArray = GlObject<delete_vertex_array>;
using Framebuffer = GlObject<delete_framebuffer>;
using Renderbuffer = GlObject<delete_renderbuffer>;
using Query = GlObject<delete_query>;
using Texture = GlObject<delete_texture>;

/// A labelled buffer filled with bytes.
/// \throw GpuUnavailable if the device is out of memory
[[nodiscard]] Buffer make_buffer(std::span<const std::byte> bytes, const std::string& label);

/// A linked program from the texts of gpu/shaders/<vertex>.vert and <fragment>.frag, with their
/// includes.
/// \param defines lines that follow `#version`
/// \throw GpuUnavailable with file, line and message if a shader does not compile or link
[[nodiscard]] Program make_program(const std::string& vertex, const std::string& fragment,
                                   const std::string& defines = "");

[[nodiscard]] VertexArray make_vertex_array();

/// \param format such as GL_RGBA8
/// \param samples 0: one per pixel
[[nodiscard]] Renderbuffer make_renderbuffer(unsigned format, int width, int height, int samples);

}  // namespace vesselbench
