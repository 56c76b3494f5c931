#include "meshing/products/gmsh.h"

#include "geometry/kernel/errors.h"
#include "geometry/kernel/plain_name.h"
#include "geometry/kernel/whole_file.h"
#include "meshing/products/text_buffer.h"

namespace vesselbench {

namespace {

constexpr int kGmshTriangle = 2, kGmshQuadrangle = 3, kGmshTetrahedron = 4, kGmshPrism = 6;

void put_names(TextBuffer& out, const VolumeMesh& mesh) {
    out << "$PhysicalNames\n" << mesh.patches.size() + 1 << '\n';
    for (std::size_t k = 0; k < mesh.patches.size(); ++k)
        out << "2 " << k + 1 << " \"" << mesh.patches[k].name << "\"\n";
    out << "3 " << mesh.patches.size() + 1 << " \"lumen\"\n$EndPhysicalNames\n";
}

void put_points(TextBuffer& out, const VolumeMesh& mesh, LoopProgress& rows) {
    out << "$Nodes\n" << mesh.points.size() << '\n';
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
        rows.step();
        const Vec3& p = mesh.points[v];
        out << v + 1 << ' ' << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
    }
    out << "$EndNodes\n";
}

// number, type, count of tags, physical and elementary entity, corners
template <class Corners>
void put_element(TextBuffer& out, std::size_t number, int type, std::size_t region,
                 const Corners& corners) {
    out << number << ' ' << type << " 2 " << region << ' ' << region;
    for (const VertexId v : corners) out << ' ' << std::size_t{v} + 1;
    out << '\n';
}

void put_elements(TextBuffer& out, const VolumeMesh& mesh, LoopProgress& rows) {
    out << "$Elements\n"
        << mesh.boundary.size() + mesh.boundary_sides.size() + mesh.cell_count() << '\n';
    std::size_t number = 0;
    for (std::size_t t = 0; t < mesh.boundary.size(); ++t) {
        rows.step();
        put_element(out, ++number, kGmshTriangle, std::size_t{mesh.boundary_patches[t]} + 1,
                    mesh.boundary[t]);
    }
    for (std::size_t t = 0; t < mesh.boundary_sides.size(); ++t) {
        rows.step();
        put_element(out, ++number, kGmshQuadrangle, std::size_t{mesh.side_patches[t]} + 1,
                    mesh.boundary_sides[t]);
    }
    for (const Tetrahedron& cell : mesh.tetrahedra) {
        rows.step();
        put_element(out, ++number, kGmshTetrahedron, mesh.patches.size() + 1, cell);
    }
    for (const auto& [a, b, c, d, e, f] : mesh.prisms) {
        rows.step();
        const Prism inner_first = {d, e, f, a, b, c};  // Gmsh's order
        put_element(out, ++number, kGmshPrism, mesh.patches.size() + 1, inner_first);
    }
    out << "$EndElements\n";
}

}  // namespace

void write_msh(const VolumeMesh& mesh, const std::string& path, const Progress& progress) {
    if (mesh.tetrahedra.empty()) throw InvalidInput("MSH: the volume mesh has no cells");
    require_plain_names(mesh.patches);
    TextBuffer out;
    out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
    put_names(out, mesh);
    LoopProgress rows(
        progress,
        mesh.points.size() + mesh.boundary.size() + mesh.boundary_sides.size() + mesh.cell_count(),
        writing_text(path));
    put_points(out, mesh, rows);
    put_elements(out, mesh, rows);
    write_file(path, out.text(), progress);
}

}  // namespace vesselbench
