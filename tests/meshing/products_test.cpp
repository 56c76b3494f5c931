#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkCompositeDataIterator.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkGLTFReader.h>
#include <vtkIdList.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <zip.h>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "meshing/layers/layered_mesh.h"
#include "meshing/products/glb.h"
#include "meshing/products/gmsh.h"
#include "meshing/products/print_check.h"
#include "meshing/products/threemf.h"
#include "meshing/products/vtu.h"
#include "meshing/products/zip.h"
#include "meshing/tetrahedra/tetrahedralize.h"
#include "tests/support/commands.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_facts.h"

using namespace vesselbench;

namespace {

std::string bytes_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

std::uint32_t number_at(const std::string& bytes, std::size_t place) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + place, 4);
    return value;
}

/// The parts of a ZIP archive by their names.
std::map<std::string, std::string> parts_of(const std::string& archive) {
    zip_source_t* source = zip_source_buffer_create(archive.data(), archive.size(), 0, nullptr);
    zip_t* zip = zip_open_from_source(source, ZIP_CHECKCONS, nullptr);
    REQUIRE(zip);
    std::map<std::string, std::string> parts;
    for (zip_int64_t i = 0; i < zip_get_num_entries(zip, 0); ++i) {
        const auto index = static_cast<zip_uint64_t>(i);
        zip_stat_t stat;
        REQUIRE(zip_stat_index(zip, index, 0, &stat) == 0);
        std::string bytes(stat.size, '\0');
        zip_file_t* file = zip_fopen_index(zip, index, 0);
        REQUIRE(file);
        CHECK(zip_fread(file, bytes.data(), bytes.size()) == static_cast<zip_int64_t>(stat.size));
        zip_fclose(file);
        parts[stat.name] = bytes;
    }
    zip_discard(zip);
    return parts;
}

/// The attributes' values of every XML element that begins so.
std::vector<std::vector<std::string>> quoted_values(const std::string& xml,
                                                    const std::string& tag) {
    std::vector<std::vector<std::string>> all;
    for (auto at = xml.find(tag); at != std::string::npos; at = xml.find(tag, at + 1)) {
        std::istringstream element(xml.substr(at, xml.find('>', at) - at));
        all.emplace_back();
        std::string word;
        for (int k = 0; std::getline(element, word, '"'); ++k)
            if (k % 2 == 1) all.back().push_back(word);
    }
    return all;
}

template <class Corners>
bool is_cell(vtkUnstructuredGrid* grid, std::size_t cell, int type, const Corners& corners) {
    vtkNew<vtkIdList> ids;
    grid->GetCellPoints(static_cast<vtkIdType>(cell), ids);
    return grid->GetCellType(static_cast<vtkIdType>(cell)) == type &&
           std::equal(ids->GetPointer(0), ids->GetPointer(0) + ids->GetNumberOfIds(),
                      corners.begin(), corners.end());
}

std::vector<std::string> texts_in(vtkDataSet* data, const char* name) {
    std::vector<std::string> texts;
    auto* array = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray(name));
    for (vtkIdType i = 0; array && i < array->GetNumberOfValues(); ++i)
        texts.push_back(array->GetValue(i));
    return texts;
}

std::vector<vtkPolyData*> surfaces_in(vtkMultiBlockDataSet* blocks) {
    std::vector<vtkPolyData*> surfaces;
    const auto it = vtkSmartPointer<vtkCompositeDataIterator>::Take(blocks->NewIterator());
    for (it->InitTraversal(); !it->IsDoneWithTraversal(); it->GoToNextItem())
        if (auto* surface = vtkPolyData::SafeDownCast(it->GetCurrentDataObject()))
            surfaces.push_back(surface);
    return surfaces;
}

}  // namespace

SCENARIO("volume files carry regions and patch names", "[meshing][products]") {
    const Surface tube = test::fine_tube(1.0, 4.0, 12);
    const VolumeMesh mesh = tetrahedralized(tube, {}).mesh;
    const std::string folder = test::temporary_folder();
    GIVEN("a Gmsh file") {
        write_msh(mesh, folder + "/volume.msh");
        const std::string text = bytes_of(folder + "/volume.msh");
        THEN("format, names and counts are right") {
            CHECK(text.starts_with("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"));
            CHECK(text.find("2 1 \"wall\"\n2 2 \"inlet\"\n2 3 \"outlet_1\"\n3 4 \"lumen\"") !=
                  std::string::npos);
            CHECK(text.find("$Elements\n" +
                            std::to_string(mesh.boundary.size() + mesh.tetrahedra.size()) + "\n") !=
                  std::string::npos);
        }
        THEN("Gmsh finds nothing to complain about") {
            const auto run = test::run_command("gmsh", {"-check", folder + "/volume.msh"});
            if (!run) return;
            CHECK(run->exit_code == 0);
            CHECK(run->output.find("Error") == std::string::npos);
        }
    }
    GIVEN("a VTU file that VTK reads back") {
        write_vtu(mesh, folder + "/volume.vtu");
        vtkNew<vtkXMLUnstructuredGridReader> reader;
        reader->SetFileName((folder + "/volume.vtu").c_str());
        reader->Update();
        vtkUnstructuredGrid* grid = reader->GetOutput();
        THEN("points and cells are those of the mesh, bit for bit") {
            REQUIRE(grid->GetNumberOfPoints() == static_cast<vtkIdType>(mesh.points.size()));
            CHECK(grid->GetPoints()->GetDataType() == VTK_DOUBLE);
            Positions points(mesh.points.size());
            for (std::size_t v = 0; v < points.size(); ++v)
                grid->GetPoint(static_cast<vtkIdType>(v), points[v].data());
            CHECK((points == mesh.points));
            REQUIRE(grid->GetNumberOfCells() ==
                    static_cast<vtkIdType>(mesh.tetrahedra.size() + mesh.boundary.size()));
            std::size_t wrong = 0;
            for (std::size_t c = 0; c < mesh.tetrahedra.size(); ++c)
                wrong += !is_cell(grid, c, VTK_TETRA, mesh.tetrahedra[c]);
            for (std::size_t t = 0; t < mesh.boundary.size(); ++t)
                wrong += !is_cell(grid, mesh.tetrahedra.size() + t, VTK_TRIANGLE, mesh.boundary[t]);
            CHECK(wrong == 0);
        }
        THEN("cells carry their regions, and the file its patch names and unit") {
            vtkDataArray* regions = grid->GetCellData()->GetArray("CellEntityIds");
            REQUIRE(regions);
            std::vector<int> read, expected(mesh.tetrahedra.size(), 0);
            for (const auto patch : mesh.boundary_patches) expected.push_back(patch + 1);
            for (vtkIdType c = 0; c < regions->GetNumberOfTuples(); ++c)
                read.push_back(static_cast<int>(regions->GetComponent(c, 0)));
            CHECK(read == expected);
            CHECK(texts_in(grid, "PatchNames") ==
                  std::vector<std::string>{"wall", "inlet", "outlet_1"});
            CHECK(texts_in(grid, "Units") == std::vector<std::string>{"mm"});
        }
        THEN("the same mesh gives the same bytes") {
            write_vtu(mesh, folder + "/again.vtu");
            CHECK(bytes_of(folder + "/again.vtu") == bytes_of(folder + "/volume.vtu"));
        }
    }
    GIVEN("a mesh without cells") {
        THEN("both are refused") {
            CHECK_THROWS_AS(write_msh({}, folder + "/none.msh"), InvalidInput);
            CHECK_THROWS_AS(write_vtu({}, folder + "/none.vtu"), InvalidInput);
            CHECK_FALSE(std::filesystem::exists(folder + "/none.vtu"));
        }
    }
}

SCENARIO("volume files carry the prisms of wall layers", "[meshing][products][layers]") {
    const VolumeMesh mesh = layered_mesh(test::fine_tube(1.0, 4.0, 12), {}, {.layers = 2}).mesh;
    REQUIRE(!mesh.boundary_sides.empty());
    const std::string folder = test::temporary_folder();
    GIVEN("a VTU file that VTK reads back") {
        write_vtu(mesh, folder + "/volume.vtu");
        vtkNew<vtkXMLUnstructuredGridReader> reader;
        reader->SetFileName((folder + "/volume.vtu").c_str());
        reader->Update();
        vtkUnstructuredGrid* grid = reader->GetOutput();
        THEN("wedges follow the tetrahedra, quadrangles the boundary's triangles") {
            REQUIRE(grid->GetNumberOfCells() ==
                    static_cast<vtkIdType>(mesh.cell_count() + mesh.boundary.size() +
                                           mesh.boundary_sides.size()));
            std::size_t at = mesh.tetrahedra.size(), wrong = 0;
            for (const Prism& prism : mesh.prisms) wrong += !is_cell(grid, at++, VTK_WEDGE, prism);
            at += mesh.boundary.size();
            for (const Quadrilateral& side : mesh.boundary_sides)
                wrong += !is_cell(grid, at++, VTK_QUAD, side);
            CHECK(wrong == 0);
        }
        THEN("quadrangles have the openings' regions") {
            vtkDataArray* regions = grid->GetCellData()->GetArray("CellEntityIds");
            const std::size_t first = mesh.cell_count() + mesh.boundary.size();
            for (std::size_t k = 0; k < mesh.side_patches.size(); ++k)
                REQUIRE(regions->GetComponent(static_cast<vtkIdType>(first + k), 0) ==
                        mesh.side_patches[k] + 1);
        }
    }
    GIVEN("a Gmsh file") {
        write_msh(mesh, folder + "/volume.msh");
        THEN("a prism's first triangle is the inner one, and Gmsh has no complaint") {
            const Prism& p = mesh.prisms[0];
            std::string corners;
            for (const VertexId v : {p[3], p[4], p[5], p[0], p[1], p[2]})
                corners += " " + std::to_string(v + 1);
            CHECK(bytes_of(folder + "/volume.msh").find(" 6 2 4 4" + corners + "\n") !=
                  std::string::npos);
            const auto run = test::run_command("gmsh", {"-check", folder + "/volume.msh"});
            if (!run) return;
            CHECK(run->exit_code == 0);
            CHECK(run->output.find("Error") == std::string::npos);
        }
    }
}

SCENARIO("ZIP archives contain what was added", "[meshing][products]") {
    const std::string text(5000, 'x');
    const std::string archive = zip_archive({{"a.txt", text}, {"b/c.txt", "y"}});
    CHECK(archive.size() < 1000);
    CHECK(parts_of(archive) ==
          std::map<std::string, std::string>{{"a.txt", text}, {"b/c.txt", "y"}});
    constexpr std::uint32_t kFirstOf1980 = 0x21 << 16;  // date and time as FAT has them
    CHECK(number_at(archive, 10) == kFirstOf1980);
    CHECK(zip_archive({{"a.txt", text}, {"b/c.txt", "y"}}) == archive);
}

SCENARIO("A 3MF file holds the surface's points and triangles exactly", "[meshing][products]") {
    const Surface tube = test::fine_tube(3.0, 12.0, 12);
    const std::string path = test::temporary_folder() + "/print.3mf";
    write_3mf(tube, path);
    const auto parts = parts_of(bytes_of(path));
    CHECK(parts.size() == 3);
    const std::string& model = parts.at("3D/3dmodel.model");
    CHECK(model.find("unit=\"millimeter\"") != std::string::npos);
    Positions points;
    for (const auto& values : quoted_values(model, "<vertex "))
        points.emplace_back(std::stod(values.at(0)), std::stod(values.at(1)),
                            std::stod(values.at(2)));
    CHECK((points == tube.points()));
    std::vector<Triangle> triangles;
    for (const auto& values : quoted_values(model, "<triangle "))
        triangles.push_back({static_cast<VertexId>(std::stoul(values.at(0))),
                             static_cast<VertexId>(std::stoul(values.at(1))),
                             static_cast<VertexId>(std::stoul(values.at(2)))});
    CHECK(std::ranges::equal(triangles, tube.triangles()));
}

SCENARIO("Several closed bodies are named parts of one 3MF object", "[meshing][products]") {
    const Surface two =
        test::merged(test::icosphere(2.0, 2), test::icosphere(2.0, 2, Vec3(0, 0, 10)));
    const std::string path = test::temporary_folder() + "/print.3mf";
    write_3mf(two, path);
    const std::string model = parts_of(bytes_of(path)).at("3D/3dmodel.model");
    for (const char* part : {"name=\"part 1\"", "name=\"part 2\"", "<component objectid=\"1\"/>",
                             "<component objectid=\"2\"/>", "<item objectid=\"3\"/>"})
        CHECK(model.find(part) != std::string::npos);
    CHECK(quoted_values(model, "<vertex ").size() == two.vertex_count());
    THEN("they are watertight") {
        CHECK(print_check(two).is_watertight());
    }
    THEN("a cavity is no part of its own") {
        write_3mf(test::sphere_shell(10.0, 2.0, 2), path);
        CHECK(parts_of(bytes_of(path)).at("3D/3dmodel.model").find("name=\"part") ==
              std::string::npos);
    }
    THEN("a slicer reads both where they are") {
        const auto run = test::run_command("prusa-slicer", {"--info", path});
        if (!run) return;
        CAPTURE(run->output);
        for (const char* part : {"manifold = yes", "max_z = 2.0", "max_z = 12.0"})
            CHECK(run->output.find(part) != std::string::npos);
    }
}

SCENARIO("print files are manifold and in millimetres for other programs", "[meshing][products]") {
    const Surface tube = test::fine_tube(3.0, 12.0, 24);
    const std::string folder = test::temporary_folder();
    write_3mf(tube, folder + "/print.3mf");
    write_surface(tube, folder + "/print.stl");
    GIVEN("PrusaSlicer") {
        for (const std::string name : {"/print.3mf", "/print.stl"}) {
            const auto run = test::run_command("prusa-slicer", {"--info", folder + name});
            if (!run) return;
            CAPTURE(run->output);
            CHECK(run->output.find("manifold = yes") != std::string::npos);
            CHECK(run->output.find("size_z = 12.0") != std::string::npos);
        }
    }
    GIVEN("admesh") {
        const auto run = test::run_command("admesh", {folder + "/print.stl"});
        if (!run) return;
        CAPTURE(run->output);
        CHECK(run->exit_code == 0);
        CHECK(run->output.find("All facets connected.") != std::string::npos);
        CHECK(run->output.find("Facets reversed       :     0") != std::string::npos);
    }
    GIVEN("an open surface") {
        THEN("3MF is refused") {
            CHECK_THROWS_AS(write_3mf(test::open_tube(1, 2, 8, 2), folder + "/open.3mf"),
                            InvalidInput);
        }
    }
    GIVEN("a folder that does not exist") {
        THEN("that is an error of the file") {
            CHECK_THROWS_AS(write_3mf(tube, folder + "/none/print.3mf"), IoError);
        }
    }
}

SCENARIO("VTK reads a GLB file back, patch by patch, in metres with the head up",
         "[meshing][products]") {
    const Surface tube = test::fine_tube(3.0, 12.0, 12);
    const std::string path = test::temporary_folder() + "/vessel.glb";
    write_glb({.surface = tube, .neighbours = {}, .colours = {}}, path);
    vtkNew<vtkGLTFReader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    const auto parts =
        surfaces_in(vtkMultiBlockDataSet::SafeDownCast(reader->GetOutputDataObject(0)));
    REQUIRE(parts.size() == tube.patches.size());
    const Vec3 centre = bounds(tube).centre();
    for (std::size_t patch = 0; patch < parts.size(); ++patch) {
        std::vector<Triangle> expected;
        for (TriangleId t = 0; t < tube.triangle_count(); ++t)
            if ((*tube.patch_labels)[t] == patch) expected.push_back(tube.triangles()[t]);
        REQUIRE(parts[patch]->GetNumberOfCells() == static_cast<vtkIdType>(expected.size()));
        double farthest = 0.0;
        for (std::size_t t = 0; t < expected.size(); ++t)
            for (int k = 0; k < 3; ++k) {
                const Vec3 p = tube.points()[expected[t][static_cast<std::size_t>(k)]] - centre;
                const Vec3 metres = 1e-3 * Vec3(p.x(), p.z(), -p.y());
                vtkCell* cell = parts[patch]->GetCell(static_cast<vtkIdType>(t));
                Vec3 read;
                cell->GetPoints()->GetPoint(k, read.data());
                farthest = std::max(farthest, (read - metres).norm());
            }
        CHECK(farthest < 1e-8);  // [m]; single precision
    }
}
