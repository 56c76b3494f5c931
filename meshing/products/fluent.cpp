#include "meshing/products/fluent.h"

#include <algorithm>
#include <charconv>

#include "geometry/formats/comment_line.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/plain_name.h"
#include "geometry/kernel/whole_file.h"
#include "meshing/products/text_buffer.h"
#include "meshing/tetrahedra/quality.h"

namespace vesselbench {

namespace {

constexpr double kMetres = 1e-3;

// Indices of sections (Ansys Fluent User's Guide, appendix "Mesh File Format") and their codes.
constexpr int kNodes = 10, kCells = 12, kFaces = 13, kZone = 45;
constexpr int kMixed = 0, kTetrahedron = 2, kWedge = 6, kTriangle = 3, kQuadrilateral = 4;
constexpr int kFluid = 1;
constexpr std::size_t kNodeZone = 1, kCellZone = 2, kInnerZone = 3, kFirstPatchZone = 4;

struct ZoneType {
    int code;
    std::string_view name;
};

constexpr ZoneType kInterior = {2, "interior"};

ZoneType zone_type(PatchKind kind) {
    switch (kind) {
        case PatchKind::Inlet:
            return {10, "velocity-inlet"};
        case PatchKind::Outlet:
            return {5, "pressure-outlet"};
        case PatchKind::Wall:
        case PatchKind::Cut:
            break;
    }
    return {3, "wall"};
}

/// Numbers within sections are hexadecimal.
struct Hex {
    std::size_t number;
};

TextBuffer& operator<<(TextBuffer& out, Hex value) {
    char digits[16];
    const char* end = std::to_chars(digits, digits + sizeof digits, value.number, 16).ptr;
    return out << std::string_view(digits, end);
}

/// OpenFOAM's converter reads no other characters in comments.
std::string comment_text(const std::string& provenance) {
    std::string text = comment_line(provenance);
    std::ranges::replace_if(
        text,
        [](char c) {
            return !is_plain_name({&c, 1}) && c != ' ' && c != ':';
        },
        '_');
    return text;
}

void begin(TextBuffer& out, int section, std::size_t zone, std::size_t first, std::size_t last) {
    out << '(' << section << " (" << Hex{zone} << ' ' << Hex{first} << ' ' << Hex{last};
}

void put_nodes(TextBuffer& out, const VolumeMesh& mesh, LoopProgress& rows) {
    begin(out, kNodes, 0, 1, mesh.points.size());
    out << " 0 3))\n";
    begin(out, kNodes, kNodeZone, 1, mesh.points.size());
    out << " 1 3)(\n";
    for (const Vec3& p : mesh.points) {
        rows.step();
        out << p.x() * kMetres << ' ' << p.y() * kMetres << ' ' << p.z() * kMetres << '\n';
    }
    out << "))\n";
}

void put_cells(TextBuffer& out, const VolumeMesh& mesh) {
    begin(out, kCells, 0, 1, mesh.cell_count());
    out << " 0))\n";
    begin(out, kCells, kCellZone, 1, mesh.cell_count());
    out << ' ' << kFluid << ' ' << (mesh.prisms.empty() ? kTetrahedron : kMixed) << ')';
    if (!mesh.prisms.empty()) {
        constexpr std::size_t kInLine = 40;
        out << "(\n";
        for (std::size_t c = 0; c < mesh.cell_count(); ++c)
            out << (c < mesh.tetrahedra.size() ? kTetrahedron : kWedge)
                << (c % kInLine + 1 == kInLine ? '\n' : ' ');
        out << ')';
    }
    out << ")\n";
}

// The normal by the right-hand rule points into the first of a face's two cells; 0 is none.
void put_face(TextBuffer& out, const MeshFace& face, bool counted) {
    if (counted) out << face.corners.size() << ' ';
    for (std::size_t k = face.corners.size(); k-- > 0;)
        out << Hex{std::size_t{face.corners[k]} + 1} << ' ';
    out << Hex{std::size_t{face.owner} + 1} << ' '
        << Hex{face.neighbour == MeshFace::kOutside ? 0 : std::size_t{face.neighbour} + 1} << '\n';
}

void put_face_zone(TextBuffer& out, std::span<const MeshFace> faces, std::size_t first,
                   std::size_t zone, const ZoneType& type, LoopProgress& rows) {
    const auto [least, most] =
        std::ranges::minmax(faces, {}, [](const MeshFace& face) { return face.corners.size(); });
    const bool mixed = least.corners.size() != most.corners.size();
    const int shape = mixed ? kMixed : least.corners.size() == 3 ? kTriangle : kQuadrilateral;
    begin(out, kFaces, zone, first + 1, first + faces.size());
    out << ' ' << Hex{static_cast<std::size_t>(type.code)} << ' ' << shape << ")(\n";
    for (const MeshFace& face : faces) {
        rows.step();
        put_face(out, face, mixed);
    }
    out << "))\n";
}

void put_zone_name(TextBuffer& out, std::size_t zone, std::string_view type,
                   std::string_view name) {
    out << '(' << kZone << " (" << zone << ' ' << type << ' ' << name << ")())\n";
}

bool same_zone(const MeshFace& a, const MeshFace& b) {
    const bool inner = a.neighbour != MeshFace::kOutside;
    if (inner != (b.neighbour != MeshFace::kOutside)) return false;
    return inner || a.patch == b.patch;
}

void put_faces(TextBuffer& out, const VolumeMesh& mesh, const std::vector<MeshFace>& faces,
               LoopProgress& rows) {
    begin(out, kFaces, 0, 1, faces.size());
    out << " 0))\n";
    TextBuffer zones;
    PlainNames names;
    put_zone_name(zones, kCellZone, "fluid", names.add("lumen"));
    const std::string inner_name = names.add("interior-lumen");
    for (std::size_t first = 0, last = 0; first < faces.size(); first = last) {
        while (last < faces.size() && same_zone(faces[first], faces[last])) ++last;
        const MeshFace& face = faces[first];
        const bool inner = face.neighbour != MeshFace::kOutside;
        const std::size_t zone = inner ? kInnerZone : kFirstPatchZone + face.patch;
        const ZoneType type = inner ? kInterior : zone_type(mesh.patches[face.patch].kind);
        put_face_zone(out, std::span(faces).subspan(first, last - first), first, zone, type, rows);
        put_zone_name(zones, zone, type.name,
                      inner ? inner_name : names.add(mesh.patches[face.patch].name));
    }
    out << zones.text();
}

}  // namespace

void write_fluent(const VolumeMesh& mesh, const std::string& path, const Progress& progress,
                  const std::string& provenance) {
    if (mesh.tetrahedra.empty()) throw InvalidInput("Fluent: the volume mesh has no cells");
    require_plain_names(mesh.patches);
    const std::vector<MeshFace> faces = mesh_faces(mesh, cell_neighbours(mesh, progress));
    TextBuffer out;
    out << "(0 \"lengths in m";
    if (!provenance.empty()) out << ". " << comment_text(provenance);
    out << "\")\n(2 3)\n";
    LoopProgress rows(progress, mesh.points.size() + faces.size(), writing_text(path));
    put_nodes(out, mesh, rows);
    put_cells(out, mesh);
    put_faces(out, mesh, faces, rows);
    write_file(path, out.text(), progress);
}

}  // namespace vesselbench
