#include "geometry/formats/grid_cells.h"

#include <fstream>
#include <sstream>

#include <catch2/catch.hpp>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/edges.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_facts.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;

namespace {

struct Cell {
    int type;
    std::vector<int> corners;
    int region = 0;
};

/// A grid of the corners of a cube of 10 mm, x fastest.
std::string legacy_grid(const std::vector<Cell>& cells, bool regions = false) {
    std::ostringstream text;
    text << "# vtk DataFile Version 2.0\nany\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 float\n";
    for (int i = 0; i < 8; ++i)
        text << 10 * (i % 2) << " " << 10 * (i / 2 % 2) << " " << 10 * (i / 4) << "\n";
    std::size_t size = 0;
    for (const Cell& cell : cells) size += cell.corners.size() + 1;
    text << "CELLS " << cells.size() << " " << size << "\n";
    for (const Cell& cell : cells) {
        text << cell.corners.size();
        for (const int v : cell.corners) text << " " << v;
        text << "\n";
    }
    text << "CELL_TYPES " << cells.size() << "\n";
    for (const Cell& cell : cells) text << cell.type << "\n";
    if (regions) {
        text << "CELL_DATA " << cells.size()
             << "\nSCALARS CellEntityIds int 1\nLOOKUP_TABLE default\n";
        for (const Cell& cell : cells) text << cell.region << "\n";
    }
    const std::string path = temporary_folder() + "/grid.vtk";
    std::ofstream(path) << text.str();
    return path;
}

SurfaceFile read(const std::string& path) {
    return read_surface(path, LengthUnit::Millimetre);
}

/// The cube as one volume cell of each type that fills it.
const std::vector<std::vector<Cell>>& filled_cubes() {
    static const std::vector<std::vector<Cell>> cubes = {
        {{11, {0, 1, 2, 3, 4, 5, 6, 7}}},
        {{12, {0, 1, 3, 2, 4, 5, 7, 6}}},
        {{13, {0, 2, 1, 4, 6, 5}}, {13, {1, 2, 3, 5, 6, 7}}},
        {{10, {0, 1, 2, 4}},
         {10, {1, 3, 2, 7}},
         {10, {1, 5, 7, 4}},
         {10, {2, 7, 6, 4}},
         {10, {1, 2, 7, 4}}}};
    return cubes;
}

const std::vector<Cell> kTetrahedron = {
    {5, {0, 2, 1}}, {5, {0, 1, 4}}, {5, {1, 2, 4}}, {5, {2, 0, 4}}};

}  // namespace

SCENARIO("Triangles, quads and strips of a legacy grid are a surface", "[geometry][io][grid]") {
    const SurfaceFile triangles = read(legacy_grid(kTetrahedron));
    CHECK(triangles.surface.triangle_count() == 4);
    CHECK(volume(triangles.surface) == Approx(1000.0 / 6.0));
    const SurfaceFile quads = read(legacy_grid({{9, {0, 2, 3, 1}},
                                                {8, {4, 5, 6, 7}},
                                                {9, {0, 1, 5, 4}},
                                                {7, {2, 6, 7, 3}},
                                                {6, {0, 4, 2, 6}},
                                                {9, {1, 3, 7, 5}},
                                                {3, {0, 7}}}));
    CHECK(volume(quads.surface) == Approx(1000.0));
    CHECK(is_closed_manifold(quads.surface));
    CHECK_THAT(quads.notes.back(), Contains("1 lines or isolated points"));
}

SCENARIO("Of volume cells the outer surface is taken, outward, and said", "[geometry][io][grid]") {
    for (const auto& cube : filled_cubes()) {
        CAPTURE(cube.front().type, cube.size());
        const SurfaceFile file = read(legacy_grid(cube));
        CHECK(is_closed_manifold(file.surface));
        CHECK(volume(file.surface) == Approx(1000.0));
        CHECK_THAT(file.notes.back(), Contains("outer surface"));
    }
}

SCENARIO("Regions of a grid's flat cells become patches of its surface", "[geometry][io][grid]") {
    std::vector<Cell> cells = filled_cubes()[1];
    cells.push_back({9, {0, 2, 3, 1}, 2});
    cells.push_back({9, {4, 5, 7, 6}, 3});
    const SurfaceFile file = read(legacy_grid(cells, true));
    CHECK(is_closed_manifold(file.surface));
    CHECK(file.surface.triangle_count() == 12);
    REQUIRE(file.surface.patches.size() == 3);
    for (std::size_t p : {1, 2}) CHECK(file.surface.patches[p].kind == PatchKind::Cut);
}

SCENARIO("Cells that are not read, or damaged, are refused with what to do",
         "[geometry][io][grid]") {
    CHECK_THROWS_WITH(read(legacy_grid({{42, {0, 1, 2, 3}}})),
                      Contains("type 42") && Contains("Extract Surface"));
    CHECK_THROWS_WITH(read(legacy_grid({{10, {0, 1, 2}}})), Contains("3 corners instead of 4"));
    CHECK_THROWS_WITH(read(legacy_grid({{5, {0, 1, 9}}})), Contains("only 8"));
    CHECK_THROWS_AS(read(legacy_grid({{3, {0, 1}}})), InvalidInput);
}

SCENARIO("The surface of a VTU file is read", "[geometry][io][grid]") {
    const auto written = [](const std::vector<Cell>& cells) {
        const vtkNew<vtkPoints> points;
        for (int i = 0; i < 8; ++i)
            points->InsertNextPoint(10 * (i % 2), 10 * (i / 2 % 2), 10 * (i / 4));
        const vtkNew<vtkUnstructuredGrid> grid;
        grid->SetPoints(points);
        for (const Cell& cell : cells) {
            const std::vector<vtkIdType> ids(cell.corners.begin(), cell.corners.end());
            grid->InsertNextCell(cell.type, static_cast<vtkIdType>(ids.size()), ids.data());
        }
        const std::string path = temporary_folder() + "/grid.vtu";
        const vtkNew<vtkXMLUnstructuredGridWriter> writer;
        writer->SetFileName(path.c_str());
        writer->SetInputData(grid);
        REQUIRE(writer->Write() == 1);
        return path;
    };
    CHECK(volume(read(written(kTetrahedron)).surface) == Approx(1000.0 / 6.0));
    CHECK(volume(read(written(filled_cubes()[3])).surface) == Approx(1000.0));
    CHECK(holds_surface(written(kTetrahedron)));
    THEN("a file that is cut off is refused") {
        const std::string path = written(kTetrahedron);
        std::ifstream in(path, std::ios::binary);
        const std::string bytes{std::istreambuf_iterator<char>(in), {}};
        for (std::size_t length = 0; length < bytes.size(); length += 97) {
            std::ofstream(path, std::ios::binary) << bytes.substr(0, length);
            CHECK_THROWS_AS(read(path), InvalidInput);
        }
    }
}
