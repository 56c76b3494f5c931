#include "meshing/products/openfoam_mesh.h"

#include "geometry/kernel/whole_file.h"
#include "meshing/products/text_buffer.h"

namespace vesselbench {

namespace {

constexpr double kMetres = 1e-3;

/// What the writers of the large files share.
struct Rows {
    LoopProgress loop;  ///< over points, and twice over the faces
    Progress progress;  ///< asked while a file's bytes are written
};

void write_points(const std::filesystem::path& folder, const VolumeMesh& mesh, Rows& rows) {
    TextBuffer out;
    out << foam_header("vectorField", "constant/polyMesh", "points") << mesh.points.size()
        << "\n(\n";
    for (const Vec3& p : mesh.points) {
        rows.loop.step();
        out << '(' << p.x() * kMetres << ' ' << p.y() * kMetres << ' ' << p.z() * kMetres << ")\n";
    }
    out << ")\n";
    write_file(folder / "points", out.text(), rows.progress);
}

void write_faces(const std::filesystem::path& folder, const std::vector<MeshFace>& faces,
                 Rows& rows) {
    TextBuffer out;
    out << foam_header("faceList", "constant/polyMesh", "faces") << faces.size() << "\n(\n";
    for (const MeshFace& f : faces) {
        rows.loop.step();
        out << f.corners.size() << '(' << f.corners[0];
        for (std::size_t k = 1; k < f.corners.size(); ++k) out << ' ' << f.corners[k];
        out << ")\n";
    }
    out << ")\n";
    write_file(folder / "faces", out.text(), rows.progress);
}

void write_cells_of_faces(const std::filesystem::path& folder, const VolumeMesh& mesh,
                          const std::vector<MeshFace>& faces, Rows& rows) {
    std::size_t inner = 0;
    TextBuffer owners, neighbours;
    for (const MeshFace& f : faces) {
        rows.loop.step();
        owners << f.owner << '\n';
        if (f.neighbour == MeshFace::kOutside) continue;
        neighbours << f.neighbour << '\n';
        ++inner;
    }
    TextBuffer note;
    note << "nPoints:" << mesh.points.size() << " nCells:" << mesh.cell_count()
         << " nFaces:" << faces.size() << " nInternalFaces:" << inner;
    TextBuffer owner, neighbour;
    owner << foam_header("labelList", "constant/polyMesh", "owner", note.text()) << faces.size()
          << "\n(\n"
          << owners.text() << ")\n";
    neighbour << foam_header("labelList", "constant/polyMesh", "neighbour", note.text()) << inner
              << "\n(\n"
              << neighbours.text() << ")\n";
    write_file(folder / "owner", owner.text(), rows.progress);
    write_file(folder / "neighbour", neighbour.text(), rows.progress);
}

void write_boundary(const std::filesystem::path& folder, const std::vector<FoamPatch>& patches) {
    TextBuffer out;
    out << foam_header("polyBoundaryMesh", "constant/polyMesh", "boundary") << patches.size()
        << "\n(\n";
    for (const FoamPatch& patch : patches) {
        const bool wall = patch.kind == PatchKind::Wall || patch.kind == PatchKind::Cut;
        out << "    " << patch.name << "\n    {\n        type " << (wall ? "wall" : "patch")
            << ";\n";
        if (wall) out << "        inGroups 1(wall);\n";
        out << "        nFaces " << patch.faces << ";\n        startFace " << patch.first_face
            << ";\n    }\n";
    }
    out << ")\n";
    write_file(folder / "boundary", out.text());
}

}  // namespace

std::string foam_word(const std::string& name) {
    const char first = name.front();
    const bool letter = (first >= 'a' && first <= 'z') || (first >= 'A' && first <= 'Z');
    return letter || first == '_' ? name : "patch_" + name;
}

std::string foam_header(const std::string& kind, const std::string& location,
                        const std::string& object, const std::string& note) {
    std::string text =
        "FoamFile\n{\n    version     2.0;\n    format      ascii;\n    class       " + kind +
        ";\n";
    if (!note.empty()) text += "    note        \"" + note + "\";\n";
    return text + "    location    \"" + location + "\";\n    object      " + object + ";\n}\n\n";
}

std::vector<FoamPatch> foam_patches(const VolumeMesh& mesh, const std::vector<MeshFace>& faces) {
    std::vector<FoamPatch> patches;
    for (std::size_t f = 0; f < faces.size(); ++f) {
        if (faces[f].neighbour != MeshFace::kOutside) continue;
        const std::size_t index = faces[f].patch;
        if (patches.empty() || patches.back().index != index)
            patches.push_back(
                {foam_word(mesh.patches[index].name), mesh.patches[index].kind, f, 0, index});
        ++patches.back().faces;
    }
    return patches;
}

void write_poly_mesh(const std::filesystem::path& folder, const VolumeMesh& mesh,
                     const std::vector<MeshFace>& faces, const Progress& progress) {
    Rows rows{{progress, mesh.points.size() + 2 * faces.size(), writing_text(folder)}, progress};
    write_points(folder, mesh, rows);
    write_faces(folder, faces, rows);
    write_cells_of_faces(folder, mesh, faces, rows);
    write_boundary(folder, foam_patches(mesh, faces));
}

}  // namespace vesselbench
