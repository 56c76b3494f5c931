#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <utility>

#include <catch2/catch.hpp>
#include <vtkCGNSReader.h>
#include <vtkCell.h>
#include <vtkCompositeDataIterator.h>
#include <vtkDataSet.h>
#include <vtkFLUENTReader.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkOpenFOAMReader.h>
#include <vtkSmartPointer.h>

#include "geometry/kernel/errors.h"
#include "meshing/layers/layered_mesh.h"
#include "meshing/products/cgns.h"
#include "meshing/products/fluent.h"
#include "meshing/tetrahedra/tetrahedralize.h"
#include "tests/support/commands.h"
#include "tests/support/shapes.h"

using namespace vesselbench;

namespace {

constexpr double kExact = 1e-9;   // relative
constexpr double kSingle = 1e-6;  // of coordinates in single precision
constexpr double kMillimetres = 1e3;

/// Cells of a part, and their volume [mm^3] or area [mm^2].
struct Part {
    std::size_t cells = 0;
    double size = 0.0;

    void add(double of_cell) {
        ++cells;
        size += of_cell;
    }
};

using Parts = std::map<std::string, Part>;

template <class Faces>
void add_faces(Parts& parts, const VolumeMesh& mesh, const Faces& faces,
               const PatchLabels& labels) {
    for (std::size_t f = 0; f < faces.size(); ++f)
        parts[mesh.patches[labels[f]].name].add(0.5 * face_normal(mesh.points, faces[f]).norm());
}

Parts parts_of(const VolumeMesh& mesh) {
    Parts parts;
    parts["lumen"] = {mesh.cell_count(), volume(mesh)};
    add_faces(parts, mesh, mesh.boundary, mesh.boundary_patches);
    add_faces(parts, mesh, mesh.boundary_sides, mesh.side_patches);
    return parts;
}

template <class Corners>
Corners corners_of(vtkCell& cell) {
    Corners corners{};
    for (std::size_t k = 0; k < corners.size(); ++k)
        corners[k] = static_cast<VertexId>(cell.GetPointId(static_cast<int>(k)));
    return corners;
}

/// What is known of the order of a wedge's corners.
enum class Wedges : std::uint8_t {
    Penta6,   ///< that of the file, which is CGNS's: (2-1) x (3-1) points from node 1 to 4
    AsBuilt,  ///< that in which VTK put the faces together
};

/// The volume or area that the mesh's own measures give a cell of VTK.
double size_of(const Positions& points, vtkCell& cell, Wedges wedges) {
    switch (cell.GetCellType()) {
        case VTK_TETRA: {
            const auto [a, b, c, d] = corners_of<Tetrahedron>(cell);
            return (points[b] - points[a]).cross(points[c] - points[a]).dot(points[d] - points[a]) /
                   6.0;
        }
        case VTK_WEDGE: {
            const auto [a, b, c, d, e, f] = corners_of<Prism>(cell);
            if (wedges == Wedges::Penta6) return prism_volume(points, {d, e, f, a, b, c});
            return std::abs(prism_volume(points, {a, b, c, d, e, f}));
        }
        case VTK_QUAD:
            return 0.5 * face_normal(points, corners_of<Quadrilateral>(cell)).norm();
        case VTK_TRIANGLE:
            return 0.5 * face_normal(points, corners_of<Triangle>(cell)).norm();
        default:
            FAIL("cells of type " << cell.GetCellType());
            return 0.0;
    }
}

Part part_of(vtkDataSet& data, Wedges wedges) {
    Positions points(static_cast<std::size_t>(data.GetNumberOfPoints()));
    for (std::size_t v = 0; v < points.size(); ++v) {
        data.GetPoint(static_cast<vtkIdType>(v), points[v].data());
        points[v] *= kMillimetres;
    }
    Part part;
    for (vtkIdType c = 0; c < data.GetNumberOfCells(); ++c)
        part.add(size_of(points, *data.GetCell(c), wedges));
    return part;
}

/// The parts that VTK read, by the names of their blocks.
Parts parts_of(vtkMultiBlockDataSet& blocks, Wedges wedges = Wedges::AsBuilt) {
    Parts parts;
    const auto it = vtkSmartPointer<vtkCompositeDataIterator>::Take(blocks.NewIterator());
    for (it->InitTraversal(); !it->IsDoneWithTraversal(); it->GoToNextItem()) {
        auto* data = vtkDataSet::SafeDownCast(it->GetCurrentDataObject());
        const char* name = it->GetCurrentMetaData()->Get(vtkCompositeDataSet::NAME());
        if (data && data->GetNumberOfCells() > 0) parts[name ? name : ""] = part_of(*data, wedges);
    }
    return parts;
}

Parts parts_of_cgns(const std::string& path) {
    vtkNew<vtkCGNSReader> reader;
    reader->SetFileName(path.c_str());
    reader->LoadBndPatchOn();
    reader->UpdateInformation();
    reader->EnableAllBases();
    reader->EnableAllFamilies();
    reader->Update();
    Parts read = parts_of(*reader->GetOutput(), Wedges::Penta6);
    if (read.contains("Internal")) read["lumen"] = read.extract("Internal").mapped();
    return read;
}

void check_same(const Parts& read, const Parts& written, double tolerance) {
    for (const auto& [name, part] : written) {
        INFO(name);
        REQUIRE(read.contains(name));
        CHECK(read.at(name).cells == part.cells);
        CHECK(read.at(name).size == Approx(part.size).epsilon(tolerance));
    }
    CHECK(read.size() == written.size());
}

/// Without wall layers, and with them.
VolumeMesh mesh_of(bool layers) {
    const Surface tube = test::fine_tube(1.0, 4.0, 12);
    return layers ? layered_mesh(tube, {}, {.layers = 2}).mesh : tetrahedralized(tube, {}).mesh;
}

void write_text(const std::string& path, const std::string& text) {
    std::filesystem::create_directories(std::filesystem::path(path).parent_path());
    std::ofstream(path) << text;
}

/// A folder in which OpenFOAM's converters work.
void make_foam_case(const std::string& folder) {
    const std::string header =
        "FoamFile\n{\n version 2.0;\n format ascii;\n class dictionary;\n object ";
    write_text(
        folder + "/system/controlDict",
        header +
            "controlDict;\n}\napplication simpleFoam;\nstartFrom startTime;\nstartTime 0;\n"
            "stopAt endTime;\nendTime 1;\ndeltaT 1;\nwriteInterval 1;\nwritePrecision 17;\n");
    write_text(folder + "/system/fvSchemes",
               header +
                   "fvSchemes;\n}\nddtSchemes {}\ngradSchemes {}\ndivSchemes {}\n"
                   "laplacianSchemes {}\n");
    write_text(folder + "/system/fvSolution", header + "fvSolution;\n}\n");
    write_text(folder + "/case.foam", "");
}

}  // namespace

SCENARIO("A CGNS file holds cells, patches and their areas", "[meshing][products][layers]") {
    const bool layers = GENERATE(false, true);
    const VolumeMesh mesh = mesh_of(layers);
    const std::string path = test::temporary_folder() + "/volume.cgns";
    write_cgns(
        mesh, path, {},
        "vesselbench 0.2.0; case 'Aneurysm, left' (mm), accepted by A. Kern <a@b.c>, sha256:0ab");
    INFO((layers ? "with" : "without") << " wall layers");
    THEN("VTK reads them") {
        check_same(parts_of_cgns(path), parts_of(mesh), kExact);
    }
    THEN("cgnscheck finds nothing to complain about") {
        const auto run = test::run_command("cgnscheck", {path});
        if (!run) return;
        INFO(run->output);
        CHECK(run->exit_code == 0);
        CHECK(run->output.find("ERROR") == std::string::npos);
        CHECK(run->output.find("WARNING") == std::string::npos);
    }
}

SCENARIO("A Fluent file holds cells, patches and their areas", "[meshing][products][layers]") {
    const bool layers = GENERATE(false, true);
    const VolumeMesh mesh = mesh_of(layers);
    const std::string folder = test::temporary_folder(), path = folder + "/volume.fluent.msh";
    write_fluent(
        mesh, path, {},
        "vesselbench 0.2.0; case 'Aneurysm, left' (mm), accepted by A. Kern <a@b.c>, sha256:0ab");
    INFO((layers ? "with" : "without") << " wall layers");
    THEN("VTK reads the cells") {
        vtkNew<vtkFLUENTReader> reader;
        reader->SetFileName(path.c_str());
        reader->Update();
        const Parts read = parts_of(*reader->GetOutput());
        REQUIRE(read.size() == 1);
        CHECK(read.begin()->second.cells == mesh.cell_count());
        CHECK(read.begin()->second.size == Approx(volume(mesh)).epsilon(kSingle));
    }
    THEN("OpenFOAM converts it, finds no fault in its faces, and has its patches") {
        const std::string foam = folder + "/foam";
        make_foam_case(foam);
        const auto converted = test::run_command("fluent3DMeshToFoam", {path}, foam);
        if (!converted) return;
        INFO(converted->output);
        REQUIRE(converted->exit_code == 0);
        const auto checked = test::run_command("checkMesh", {"-allTopology"}, foam);
        REQUIRE(checked);
        INFO(checked->output);
        CHECK(checked->output.find("Mesh OK.") != std::string::npos);
        vtkNew<vtkOpenFOAMReader> reader;
        reader->SetFileName((foam + "/case.foam").c_str());
        reader->UpdateInformation();
        reader->EnableAllPatchArrays();
        reader->Update();
        Parts read = parts_of(*reader->GetOutput());
        if (read.contains("internalMesh")) read["lumen"] = read.extract("internalMesh").mapped();
        check_same(read, parts_of(mesh), kSingle);
    }
}

SCENARIO("Solvers' files need cells, and short names in CGNS", "[meshing][products]") {
    const std::string folder = test::temporary_folder();
    CHECK_THROWS_AS(write_cgns({}, folder + "/none.cgns"), InvalidInput);
    CHECK_THROWS_AS(write_fluent({}, folder + "/none.fluent.msh"), InvalidInput);
    CHECK_FALSE(std::filesystem::exists(folder + "/none.cgns"));
    VolumeMesh mesh = mesh_of(false);
    mesh.patches[1].name = std::string(40, 'a');
    mesh.patches[2].name = std::string(40, 'a') + "b";
    write_cgns(mesh, folder + "/long.cgns");
    const auto run = test::run_command("cgnscheck", {folder + "/long.cgns"});
    if (!run) return;
    CHECK(run->exit_code == 0);
    CHECK(run->output.find(std::string(30, 'a') + "_2") != std::string::npos);
}

SCENARIO("Patches may have the names that a solver's file has for other things",
         "[meshing][products]") {
    const std::string folder = test::temporary_folder();
    VolumeMesh mesh = mesh_of(false);
    REQUIRE(mesh.patches.size() == 3);
    const auto named = [&](const std::array<const char*, 3>& names) {
        for (std::size_t k = 0; k < names.size(); ++k) mesh.patches[k].name = names[k];
    };
    GIVEN("names of CGNS's nodes and of HDF5's folders") {
        using Names = std::array<const char*, 3>;
        const auto [names, written] =
            GENERATE(std::pair(Names{".", "..", "lumen"}, Names{"_", "__", "lumen_2"}),
                     std::pair(Names{"ZoneType", "ZoneBC", "GridCoordinates"},
                               Names{"ZoneType_2", "ZoneBC_2", "GridCoordinates_2"}),
                     std::pair(Names{"Provenance", "DataClass", "DimensionalUnits"},
                               Names{"Provenance_2", "DataClass_2", "DimensionalUnits_2"}));
        named(names);
        write_cgns(mesh, folder + "/names.cgns", {}, "vesselbench");
        named(written);
        check_same(parts_of_cgns(folder + "/names.cgns"), parts_of(mesh), kExact);
    }
    GIVEN("names of Fluent's zones") {
        named({"lumen", "interior-lumen", "outlet"});
        write_fluent(mesh, folder + "/names.fluent.msh");
        std::ifstream file(folder + "/names.fluent.msh");
        const std::string text{std::istreambuf_iterator<char>(file), {}};
        for (const char* name : {" lumen)", " lumen_2)", " interior-lumen)", " interior-lumen_2)"})
            CHECK(text.find(name) != std::string::npos);
        CHECK(text.find(" lumen)") == text.rfind(" lumen)"));
        CHECK(text.find(" interior-lumen)") == text.rfind(" interior-lumen)"));
    }
}
