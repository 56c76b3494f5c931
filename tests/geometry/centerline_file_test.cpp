#include "geometry/formats/centerline_file.h"

#include <fstream>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/vessel/centerlines/branch_queries.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

CenterlineGraph ring_with_stem() {
    CenterlineGraph graph;
    graph.nodes = {{{0, 0, 0}, 1.5, {0}}, {{5, 0, 0}, 1.25, {0, 1, 1}}};
    graph.branches = {{0, 1, {{0, 0, 0}, {2, 0.1, 0}, {5, 0, 0}}, {1.5, 1.4, 1.25}},
                      {1, 1, {{5, 0, 0}, {9, 4, 0}, {9, -4, 1}, {5, 0, 0}}, {1.25, 1, 1, 1.25}}};
    return graph;
}

}  // namespace

SCENARIO("Centerlines survive a file", "[geometry][centerlines]") {
    const std::string path = temporary_folder() + "/lines.vtp";
    const CenterlineGraph graph = ring_with_stem();
    write_centerlines(graph, path);
    const CenterlineGraph read = read_centerlines(path);
    REQUIRE(read.branches.size() == 2);
    REQUIRE(read.nodes.size() == 2);
    for (std::size_t b = 0; b < 2; ++b) {
        CHECK(read.branches[b].points == graph.branches[b].points);
        CHECK(read.branches[b].radii == graph.branches[b].radii);
        CHECK(read.branches[b].start_node == graph.branches[b].start_node);
    }
    CHECK(read.nodes[1].branches == std::vector<std::size_t>{0, 1, 1});
    CHECK(read.nodes[0].is_tip());
    CHECK(read.nodes[0].radius == 1.5);
}

SCENARIO("VMTK's centerlines are read", "[geometry][centerlines]") {
    const std::string path = shared_data("centerlines/vmtk_aorta_centerline.vtp");
    if (path.empty()) return;
    const CenterlineGraph lines = read_centerlines(path);
    CHECK(lines.branches.size() == 2);
    CHECK(branch_length(lines.branches[0]) > 70.0);
    CHECK(lines.branches[0].radii[50] > 3.0);
}

SCENARIO("A file that is not a centerline file is rejected", "[geometry][centerlines]") {
    const std::string folder = temporary_folder();
    CHECK_THROWS_AS(read_centerlines(folder + "/absent.vtp"), IoError);
    std::ofstream(folder + "/bad.vtp") << "<VTKFile type=\"PolyData\"><PolyData>";
    CHECK_THROWS_AS(read_centerlines(folder + "/bad.vtp"), InvalidInput);
    CHECK_THROWS_AS(write_centerlines(ring_with_stem(), folder + "/lines.stl"), UsageError);
    CHECK_THROWS_AS(write_centerlines({}, folder + "/none.vtp"), InvalidInput);
    CHECK_THROWS_AS(write_centerlines(ring_with_stem(), folder + "/none/x.vtp"), IoError);
}

SCENARIO("Lines that refer to missing points or values are no reason to crash",
         "[geometry][centerlines][bad-input]") {
    const auto file = [](const std::string& points, const std::string& ends,
                         const std::string& arrays) {
        const std::string path = temporary_folder() + "/lines.vtp";
        std::ofstream(path)
            << "<VTKFile type=\"PolyData\" version=\"0.1\"><PolyData><Piece NumberOfPoints=\""
            << points << "\" NumberOfLines=\"1\">" << arrays
            << "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">"
               "0 0 0 1 0 0</DataArray></Points><Lines>"
               "<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">"
            << ends
            << "</DataArray><DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">2"
               "</DataArray></Lines></Piece></PolyData></VTKFile>";
        return path;
    };
    CHECK(read_centerlines(file("2", "0 1", "")).branches.size() == 1);
    CHECK_THROWS_AS(read_centerlines(file("2", "0 7", "")), InvalidInput);
    CHECK_THROWS_AS(read_centerlines(file("2", "0 -1", "")), InvalidInput);
    CHECK_THROWS_AS(read_centerlines(file("0", "0 1", "")), InvalidInput);
    const std::string radii =
        "<PointData><DataArray type=\"Float64\" Name=\"Radius\" NumberOfComponents=\"2\" "
        "format=\"ascii\">1 1 1 1</DataArray></PointData>";
    CHECK(read_centerlines(file("2", "0 1", radii)).branches[0].radii[1] == 0.0);
}
