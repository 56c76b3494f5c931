#include "gpu/device_caps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include <epoxy/gl.h>

#include "geometry/kernel/parallel.h"
#include "smoothing/context/flat_areas.h"

namespace vesselbench {

namespace {

constexpr std::size_t kPartBytes = 16;  // of each half of a part (gpu/shaders/part_planes.glsl)

struct LabelledVertex {
    VertexId vertex, part;
};

/// Data of the search for planar parts.
struct PartBuffers {
    Buffer normals, labels, low_parts, high_parts;

    explicit PartBuffers(const DeviceSurface& surface) {
        const Device& device = surface.device();
        const std::size_t count = surface.vertex_count();
        normals = make_storage(device, 3 * count * sizeof(std::int32_t), "flat vertices' normals");
        labels = make_storage(device, count * sizeof(VertexId), "labels of parts");
        for (Buffer* parts : {&low_parts, &high_parts}) {
            *parts = make_storage(device, count * kPartBytes, "sums of parts");
            fill_storage(device, *parts, 0);
        }
    }
};

void find_flat_vertices(const DeviceSurface& surface, double flat_cosine,
                        const PartBuffers& buffers) {
    const Device& device = surface.device();
    const std::size_t triangles = surface.surface().triangle_count();
    Buffer faces;
    if (!surface.wide()) {
        faces = make_storage(device, 3 * triangles * sizeof(double), "face normals");
        bind_storage({&surface.exact(), &surface.triangles(), &faces});
        dispatch(device, surface.program("face_normals"), triangles);
    }
    const DeviceRows& rows = surface.triangles_at();
    bind_storage({surface.wide() ? Bound(&surface.exact()) : Bound(&faces), &buffers.normals,
                  &buffers.labels, &rows.offsets, &rows.values});
    if (surface.wide()) bind_view(1, surface.triangles());
    const Program& program = surface.program("flat_vertices");
    glUseProgram(program.id());
    glUniform1d(1, flat_cosine);
    dispatch(device, program, surface.vertex_count());
}

void find_parts(const DeviceSurface& surface, const PartBuffers& buffers) {
    const Device& device = surface.device();
    const std::size_t count = surface.vertex_count();
    const DeviceRows& rings = surface.rings(1);
    const DeviceOrder& order = surface.order();
    Buffer numbers;
    if (!order.is_own()) {
        std::vector<VertexId> vertices(count);
        for_each_vertex(count, [&](std::size_t i) { vertices[i] = order.vertex_at(i); });
        numbers = make_storage(device, std::span<const VertexId>(vertices), "vertices' numbers");
    }
    bind_storage({order.is_own() ? nullptr : &numbers, &buffers.normals, &buffers.labels,
                  &rings.offsets, &rings.values, &buffers.low_parts, &buffers.high_parts});
    const Program& join = surface.program("join_parts");
    glUseProgram(join.id());
    glUniform1i(1, order.is_own() ? 0 : 1);
    dispatch(device, join, count);
    dispatch(device, surface.program("part_sums"), count);
    const Program& program = surface.program("part_insides");
    glUseProgram(program.id());
    glUniform1d(1, spread_cosine());
    dispatch(device, program, count);
}

/// The vertices of the parts that may be caps, by part.
std::vector<LabelledVertex> read_planes(const DeviceSurface& surface, int smallest_faces,
                                        const PartBuffers& buffers) {
    const Device& device = surface.device();
    const Program& program = surface.program("plane_vertices");
    const Buffer count = make_storage(device, sizeof(std::uint32_t), "vertices in planes");
    const auto run = [&](const Buffer& list, bool lists) {
        fill_storage(device, count, 0);
        bind_storage({&count, &buffers.normals, &buffers.labels, nullptr, nullptr,
                      &buffers.low_parts, &buffers.high_parts, &list});
        glUseProgram(program.id());
        glUniform1ui(1, static_cast<unsigned>(smallest_faces));
        glUniform1i(2, lists ? 1 : 0);
        dispatch(device, program, surface.vertex_count());
        return read_storage<std::uint32_t>(device, count, 1).front();
    };
    const std::uint32_t found = run(count, false);
    if (found == 0) return {};
    const Buffer list = make_storage(device, found * sizeof(LabelledVertex), "vertices in planes");
    run(list, true);
    auto vertices = read_storage<LabelledVertex>(device, list, found);
    const DeviceOrder& order = surface.order();
    for (auto& [vertex, part] : vertices) {
        vertex = order.vertex_at(vertex);
        part = order.vertex_at(part);
    }
    std::ranges::sort(vertices, [](const LabelledVertex& a, const LabelledVertex& b) {
        return std::array{a.part, a.vertex} < std::array{b.part, b.vertex};
    });
    return vertices;
}

CompressedRows rows_of(const std::vector<LabelledVertex>& vertices) {
    CompressedRows rows{{0}, {}};
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        rows.values.push_back(vertices[i].vertex);
        if (i + 1 == vertices.size() || vertices[i + 1].part != vertices[i].part)
            rows.offsets.push_back(static_cast<std::uint32_t>(i + 1));
    }
    return rows;
}

}  // namespace

std::vector<Cap> find_caps(const DeviceSurface& surface, const CapParameters& parameters) {
    require_cap_parameters(parameters);
    const PartBuffers buffers(surface);
    find_flat_vertices(surface, std::cos(parameters.flat_angle_deg * std::numbers::pi / 180.0),
                       buffers);
    find_parts(surface, buffers);
    const auto vertices = read_planes(surface, parameters.smallest_faces, buffers);
    const AreaNormals faces(surface.surface(), AreaNormals::When::Asked);
    return caps_of_parts(faces, rows_of(vertices), parameters);
}

}  // namespace vesselbench
