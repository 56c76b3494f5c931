#include "geometry/formats/surface_file.h"

#include <filesystem>
#include <fstream>
#include <iterator>

#include <catch2/catch.hpp>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>

#include "geometry/formats/surface_formats.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "tests/support/shapes.h"
#include "tests/support/small_files.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

std::string written(const std::string& name, const std::string& content) {
    const std::string path = temporary_folder() + "/" + name;
    std::ofstream(path, std::ios::binary) << content;
    return path;
}

std::string bytes_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

Surface patient_tube() {
    Surface tube = mapped(closed_tube(2.0, 20.0, 24, 10), [](const Vec3& p) {
        return Vec3(skew_rotation() * p + Vec3(-120.3, 45.7, 900.1));
    });
    std::vector<double> weights;
    for (const Vec3& p : tube.points()) weights.push_back(p.x());
    tube.attributes["weight"] = std::make_shared<const std::vector<double>>(weights);
    return tube;
}

std::string legacy_vtk() {
    return "# vtk DataFile Version 3.0\na tetrahedron\nASCII\nDATASET POLYDATA\n"
           "POINTS 4 double\n0 0 0 10 0 0 0 10 0 0 0 10\n"
           "POLYGONS 4 16\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n"
           "POINT_DATA 4\nSCALARS weight double\nLOOKUP_TABLE default\n1 2 3 4\n"
           "NORMALS n float\n0 0 1 0 0 1 0 0 1 0 0 1\n";
}

}  // namespace

SCENARIO("Legacy VTK files are read, text and binary, old and new", "[geometry][io]") {
    const auto text = read_surface(written("t.vtk", legacy_vtk()), LengthUnit::Millimetre);
    CHECK(volume(text.surface) == Approx(1000.0 / 6.0));
    CHECK(text.surface.attributes.at("weight")->at(2) == 3.0);
    std::string bytes =
        "# vtk DataFile Version 5.1\nstrip\nBINARY\nDATASET POLYDATA\nPOINTS 4 float\n";
    for (const char* xyz : {"000", "100", "010", "110"})
        for (int k = 0; k < 3; ++k) bytes.append(xyz[k] == '1' ? "\x41\x20\0\0" : "\0\0\0\0", 4);
    const auto whole = [&](char value) { bytes.append(7, '\0') += value; };
    bytes += "\nMETADATA\nINFORMATION 0\n\nTRIANGLE_STRIPS 2 4\nOFFSETS vtktypeint64\n";
    for (const char v : {'\0', '\4'}) whole(v);
    bytes += "\nCONNECTIVITY vtktypeint64\n";
    for (const char v : {'\0', '\1', '\2', '\3'}) whole(v);
    const auto strip = read_surface(written("s.vtk", bytes), LengthUnit::Millimetre);
    CHECK(area(strip.surface) == Approx(100.0));
    CHECK(area_normal(strip.surface.points(), strip.surface.triangles()[0]).z() ==
          Approx(area_normal(strip.surface.points(), strip.surface.triangles()[1]).z()));
    CHECK_THROWS_WITH(read_surface(written("g.vtk",
                                           "# vtk DataFile Version 3.0\nx\nASCII\nDATASET "
                                           "STRUCTURED_GRID\n")),
                      Catch::Contains("POLYDATA"));
}

SCENARIO("A full disk is reported, and nothing is left", "[geometry][io]") {
    const std::string folder = temporary_folder();
    const std::string path = folder + "/a.stl";
    write_surface(cube(1.0), path);
    const std::string before = bytes_of(path);
    {
        const SmallFiles small(1000);
        CHECK_THROWS_AS(write_surface(icosphere(1.0, 4), path), IoError);
    }
    CHECK(bytes_of(path) == before);
    CHECK(std::distance(std::filesystem::directory_iterator(folder), {}) == 1);
}

SCENARIO("Every format keeps the shape, and all data it can store", "[geometry][io]") {
    const Surface tube = patient_tube();
    const std::string folder = temporary_folder();
    for (const std::string& suffix : written_suffixes(surface_formats())) {
        CAPTURE(suffix);
        write_surface(tube, folder + "/tube" + suffix);
        const SurfaceFile file = read_surface(folder + "/tube" + suffix);
        CHECK(file.unit == LengthUnit::Millimetre);
        CHECK(file.unit_reason == "stated in the file");
        CHECK(file.surface.vertex_count() == tube.vertex_count());
        CHECK(file.surface.triangle_count() == tube.triangle_count());
        CHECK(volume(file.surface) == Approx(volume(tube)).epsilon(1e-4));
        const bool has_patches = suffix == ".ply" || suffix == ".obj" || suffix == ".vtp";
        if (has_patches) {
            CHECK(file.surface.patches == tube.patches);
            CHECK(measure_patches(file.surface)[2].area ==
                  Approx(measure_patches(tube)[2].area).epsilon(1e-9));
        }
        if (suffix != ".stl" && suffix != ".obj")
            CHECK(file.surface.points()[7] == tube.points()[7]);
        if (suffix == ".ply" || suffix == ".vtp")
            CHECK(*file.surface.attributes.at("weight") == *tube.attributes.at("weight"));
    }
}

SCENARIO("A file truncated at any length is rejected", "[geometry][io]") {
    const Surface tube = closed_tube(2.0, 20.0, 12, 4);
    const std::string folder = temporary_folder();
    std::vector<std::string> files = {written("t.vtk", legacy_vtk())};
    for (const std::string suffix : {".stl", ".ply", ".off", ".vtp"}) {
        files.push_back(folder + "/tube" + suffix);
        write_surface(tube, files.back());
    }
    for (const std::string& path : files) {
        const std::string whole = bytes_of(path);
        for (int part = 0; part < 40; ++part) {
            const std::size_t length = whole.size() * static_cast<std::size_t>(part) / 40;
            const std::string cut =
                folder + "/cut" + std::filesystem::path(path).extension().string();
            std::ofstream(cut, std::ios::binary) << whole.substr(0, length);
            CAPTURE(cut, length);
            CHECK_THROWS_AS(read_surface(cut), InvalidInput);
        }
    }
}

SCENARIO("A text STL truncated at any length is rejected", "[geometry][io]") {
    std::string text = "solid a\n";
    for (int i = 0; i < 3; ++i)
        text += "facet normal 0 0 1\n outer loop\n  vertex 0 0 " + std::to_string(i) +
                "\n  vertex 10 0 0\n  vertex 0 10 0\n endloop\nendfacet\n";
    text += "endsolid a\n";
    CHECK(read_surface(written("a.stl", text)).surface.triangle_count() == 3);
    for (std::size_t length = 0; length < text.size() - 10; ++length)
        CHECK_THROWS_AS(read_surface(written("a.stl", text.substr(0, length))), InvalidInput);
}

SCENARIO("A text STL is read however its program spells it", "[geometry][io]") {
    const std::string corners = "VERTEX 0 0 0\nvertex 10 0 0\nVertex 0 10 0\n";
    const auto area_in = [&](const std::string& text) {
        return area(read_surface(written("a.stl", text), LengthUnit::Millimetre).surface);
    };
    CHECK(area_in("SOLID A\nFACET NORMAL 0 0 1\nOUTER LOOP\n" + corners +
                  "ENDLOOP\nENDFACET\nENDSOLID A\n") == Approx(50.0));
    CHECK(area_in("solid\nfacet normal nan NaN -nan(ind)\nouter loop\n" + corners +
                  "end loop\nend facet\nend solid\n") == Approx(50.0));
}

SCENARIO("Named solids of an STL file are patches", "[geometry][io]") {
    const auto facet = [](const std::string& corners) {
        return "facet normal 0 0 1\nouter loop\n" + corners + "endloop\nendfacet\n";
    };
    const auto file = read_surface(
        written("a.stl", "solid wall\n" + facet("vertex 0 0 0\nvertex 10 0 0\nvertex 0 0 10\n") +
                             facet("vertex 10 0 0\nvertex 0 10 0\nvertex 0 0 10\n") +
                             facet("vertex 0 10 0\nvertex 0 0 0\nvertex 0 0 10\n") +
                             "endsolid wall\nsolid inlet\n" +
                             facet("vertex 0 0 0\nvertex 0 10 0\nvertex 10 0 0\n") +
                             "endsolid inlet\n"),
        LengthUnit::Millimetre);
    CHECK(file.surface.vertex_count() == 4);
    REQUIRE(file.surface.patches.size() == 2);
    CHECK(file.surface.patches[1] == Patch{"inlet", PatchKind::Inlet});
}

SCENARIO("Coordinates that are not finite are refused with their place", "[geometry][io]") {
    const auto refused = [](const std::string& path, const std::string& place) {
        CAPTURE(path);
        CHECK_THROWS_WITH(read_surface(path), Catch::Contains(place) && Catch::Contains("finite") &&
                                                  !Catch::Contains("/"));
    };
    refused(written("a.off", "OFF\n3 1 0\n0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n"), "a.off, line 4");
    refused(written("a.obj", "v 0 0 0\nv inf 0 0\nv 0 1 0\nf 1 2 3\n"), "a.obj, line 2");
    refused(written("a.ply",
                    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                    "property float y\nproperty float z\nelement face 1\n"
                    "property list uchar int vertex_index\nend_header\n"
                    "0 0 0\n1 0 nan\n0 1 0\n3 0 1 2\n"),
            "a.ply, byte");
    const std::string folder = temporary_folder();
    write_surface(cube(10.0), folder + "/nan.stl");
    std::string bytes = bytes_of(folder + "/nan.stl");
    bytes.replace(84 + 50 * 3 + 12, 4, "\xff\xff\xff\xff");
    refused(written("nan.stl", bytes), "nan.stl, triangle 3");
}

SCENARIO("Polygons become triangles that cover them once", "[geometry][io]") {
    // An L of area 3, given as one polygon with a concave corner.
    const auto file = read_surface(written("l.obj",
                                           "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\n"
                                           "v 0 2 0\nf -6 -5 -4 -3 -2 -1\n"),
                                   LengthUnit::Millimetre);
    CHECK(file.surface.triangle_count() == 4);
    CHECK(area(file.surface) == Approx(3.0));
}

SCENARIO("PLY files of either byte order and with other elements are read", "[geometry][io]") {
    std::string bytes =
        "ply\nformat binary_big_endian 1.0\nelement camera 1\n"
        "property list uchar float pose\nelement vertex 3\nproperty float x\n"
        "property float y\nproperty float z\nproperty uchar red\nelement face 1\n"
        "property list uchar ushort vertex_indices\nend_header\n";
    const auto real = [&](const char* four) { bytes.append(four, 4); };
    bytes += '\1';
    real("\x3f\x80\0\0");
    for (int v = 0; v < 3; ++v) {
        real(v == 1 ? "\x41\x20\0\0" : "\0\0\0\0");  // 10
        real(v == 2 ? "\x41\x20\0\0" : "\0\0\0\0");
        real("\0\0\0\0");
        bytes += '\7';
    }
    bytes.append("\3\0\0\0\1\0\2", 7);
    const auto file = read_surface(written("b.ply", bytes), LengthUnit::Millimetre);
    CHECK(area(file.surface) == Approx(50.0));
}

SCENARIO("A model's place and its edges tell its unit, too", "[geometry][io]") {
    const auto guess = [](int around, double away) {
        const Surface tube = open_tube(1.0, 20.0, around, 3 * around);
        return guess_length_unit(
            mapped(tube, [&](const Vec3& p) { return Vec3(p + Vec3(away, 0.0, 0.0)); }));
    };
    const UnitGuess excerpt = guess(14, 80.0), aorta = guess(60, 20.0), moved = guess(32, 0.0);
    CHECK(excerpt.unit == LengthUnit::Millimetre);  // in cm it would be 0.8 m away
    CHECK(excerpt.doubt.empty());
    CHECK(aorta.unit == LengthUnit::Centimetre);  // no image shows 0.1 mm
    CHECK(aorta.doubt.empty());
    CHECK_FALSE(moved.doubt.empty());
}

SCENARIO("Units are guessed from what a vessel can be, stated or given", "[geometry][io]") {
    const auto guess = [](double factor) {
        return guess_length_unit(
            mapped(open_tube(2.5, 60.0, 24, 40), [&](const Vec3& p) { return Vec3(factor * p); }));
    };
    CHECK(guess(1.0).unit == LengthUnit::Millimetre);
    CHECK(guess(0.1).unit == LengthUnit::Centimetre);
    CHECK(guess(0.001).unit == LengthUnit::Metre);
    // A pulmonary trunk in cm is nearly as plausible as a thin artery in mm.
    const Surface trunk = open_tube(1.0, 12.0, 24, 40);
    CHECK(guess_length_unit(trunk, LengthUnit::Centimetre).unit == LengthUnit::Centimetre);
    const auto doubtful = [](double radius, double length) {
        return !guess_length_unit(open_tube(radius, length, 24, 40)).doubt.empty();
    };
    CHECK(doubtful(1.0, 12.0));        // a carotid's excerpt, or a pulmonary trunk in cm
    CHECK_FALSE(doubtful(1.7, 22.0));  // an intracranial artery: no aorta is 34 mm wide throughout
    CHECK_FALSE(doubtful(2.3, 58.0));  // a carotid
    CHECK_FALSE(doubtful(9.0, 300.0));
    // Triangles that are not oriented alike enclose no volume; an atrium of a square metre is none.
    const Surface atrium = icosphere(30.0, 3);
    std::vector<Triangle> mixed(atrium.triangles().begin(), atrium.triangles().end());
    for (std::size_t t = 0; t < mixed.size(); t += 2) std::swap(mixed[t][0], mixed[t][1]);
    CHECK(guess_length_unit(make_surface(atrium.points(), mixed)).doubt.empty());
    CHECK_FALSE(doubtful(0.002, 0.02));
    CHECK(guess(1000.0).unit == LengthUnit::Micrometre);
    // In cm it would be 1.2 m long, which no vessel is.
    CHECK_FALSE(doubtful(1.25, 120.0));
    const std::string folder = temporary_folder();
    write_surface(cube(3.0), folder + "/c.vtp");
    CHECK(volume(read_surface(folder + "/c.vtp").surface) == Approx(27.0));
    CHECK(volume(read_surface(folder + "/c.vtp", LengthUnit::Centimetre).surface) ==
          Approx(27000.0));
}

SCENARIO("Units are known by each of their names", "[geometry][io]") {
    for (const std::string name :
         {"um", "\xc2\xb5m", "\xce\xbcm", "micron", "Microns", "micrometers"}) {
        CAPTURE(name);
        CHECK(unit_named(name) == LengthUnit::Micrometre);
        const auto file = read_surface(
            written("a.obj", "# UNITS=" + name + "\nv 0 0 0\nv 9000 0 0\nv 0 9000 0\nf 1 2 3\n"));
        CHECK(file.unit == LengthUnit::Micrometre);
        CHECK(area(file.surface) == Approx(40.5));
    }
    CHECK(unit_named("Millimetres") == LengthUnit::Millimetre);
    CHECK(unit_named("cm") == LengthUnit::Centimetre);
    CHECK(unit_named("meters") == LengthUnit::Metre);
    CHECK_FALSE(unit_named("inch"));
    CHECK_FALSE(unit_named(""));
}

SCENARIO("A surface with SimVascular's faces is taken to be in cm", "[geometry][io]") {
    const Surface trunk = open_tube(1.0, 12.0, 24, 40);
    const auto text = [&](const std::string& array) {
        std::string file = "# vtk DataFile Version 3.0\nmodel\nASCII\nDATASET POLYDATA\nPOINTS " +
                           std::to_string(trunk.vertex_count()) + " double\n";
        for (const Vec3& p : trunk.points())
            file += std::to_string(p.x()) + " " + std::to_string(p.y()) + " " +
                    std::to_string(p.z()) + "\n";
        const std::string count = std::to_string(trunk.triangle_count());
        file += "POLYGONS " + count + " " + std::to_string(4 * trunk.triangle_count()) + "\n";
        for (const auto& [a, b, c] : trunk.triangles())
            file +=
                "3 " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) + "\n";
        file += "CELL_DATA " + count + "\nSCALARS " + array + " int 1\nLOOKUP_TABLE default\n";
        for (std::size_t t = 0; t < trunk.triangle_count(); ++t) file += "1\n";
        return file;
    };
    CHECK(read_surface(written("sv.vtk", text("ModelFaceID"))).unit == LengthUnit::Centimetre);
    CHECK(read_surface(written("other.vtk", text("Region"))).unit == LengthUnit::Millimetre);
}

SCENARIO("The units of the real surfaces are guessed right", "[geometry][io]") {
    const std::string cm[] = {"gmsh_aorta2_open.stl", "sv_demo_aortofemoral.vtp",
                              "sv_rom_model_surface.vtp"};
    const std::string m[] = {"openlb_cerebral_aneurysm3d.stl",
                             "vasp_small_aneurysm_fluidboundary.vtp"};
    const std::string folder = shared_data("surfaces");
    if (folder.empty()) return;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        CAPTURE(name);
        const LengthUnit right =
            std::count(std::begin(cm), std::end(cm), name) ? LengthUnit::Centimetre
            : std::count(std::begin(m), std::end(m), name) ? LengthUnit::Metre
                                                           : LengthUnit::Millimetre;
        CHECK(read_surface(entry.path().string()).unit == right);
    }
}

SCENARIO("Caps that SimVascular numbered become openings", "[geometry][io]") {
    const std::string path = shared_data("surfaces/sv_demo_aortofemoral.vtp");
    if (path.empty()) return;
    const auto patches = measure_patches(read_surface(path).surface);
    REQUIRE(patches.size() == 4);
    CHECK(patches[0].triangles == 9267 + 5222);
    CHECK(patches[1].triangles == 78);
    CHECK(patches[1].kind == PatchKind::Cut);
}

SCENARIO("Files that are no surface are refused clearly", "[geometry][io]") {
    for (const std::string name :
         {"assimp_crash.ply", "assimp_invalid.off", "assimp_malformed.obj", "trimesh_empty.ply",
          "trimesh_empty.stl", "trimesh_empty_bin.stl", "trimesh_points_emptyface.ply"}) {
        const std::string path = shared_data("nasty/" + name);
        if (path.empty()) return;
        CAPTURE(name);
        CHECK_THROWS_AS(read_surface(path), InvalidInput);
    }
    CHECK_THROWS_AS(read_surface("no_such_file.stl"), IoError);
    CHECK_THROWS_WITH(
        read_surface(written("notes.stl", "Dear colleague,\nthe surface is attached.\n")),
        Catch::Contains("it is a text that begins with 'Dear colleague,', not with 'solid'"));
    CHECK_THROWS_AS(read_surface(written("a.docx", "x")), InvalidInput);
    for (const std::string& suffix : read_suffixes(surface_formats())) {
        CAPTURE(suffix);
        CHECK_THROWS_AS(read_surface(written("garbage" + suffix, "this is not a surface\n\1\2\3")),
                        InvalidInput);
        CHECK_THROWS_AS(read_surface(written("empty" + suffix, "")), InvalidInput);
    }
}

SCENARIO("A VTP file that announces huge arrays is refused at once", "[geometry][io]") {
    const std::string file = temporary_folder() + "/cube.vtp";
    write_surface(cube(3.0), file);
    std::ifstream whole(file, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(whole), {}};
    const std::string key = "NumberOfComponents=\"3\"";
    for (const std::string count : {"1000000000", "-1", "x"}) {
        std::string damaged = text;
        damaged.replace(damaged.find(key), key.size(), "NumberOfComponents=\"" + count + "\"");
        std::ofstream(file, std::ios::binary) << damaged;
        CHECK_THROWS_WITH(read_surface(file), Catch::Contains("cube.vtp announces an array"));
    }
}

SCENARIO("A VTP file's lists of texts hold no more than announced", "[geometry][io][bad-input]") {
    const std::string file = temporary_folder() + "/tube.vtp";
    write_surface(closed_tube(2.0, 8.0, 12, 4), file);  // PatchNames: wall, inlet, outlet_1
    REQUIRE(read_surface(file).surface.patches.size() == 3);
    std::string text = bytes_of(file);
    const std::string key = "NumberOfTuples=\"3\"";
    REQUIRE(text.find(key) != std::string::npos);
    text.replace(text.find(key), key.size(), "NumberOfTuples=\"1\"");
    std::ofstream(file, std::ios::binary) << text;
    CHECK_THROWS_WITH(read_surface(file), Catch::Contains("texts is longer than announced"));
    const auto list_of = [](const std::string& count) {
        return "<VTKFile type=\"PolyData\" version=\"0.1\"><PolyData><FieldData><Array "
               "type=\"String\" "
               "Name=\"PatchNames\" NumberOfTuples=\"" +
               count + "\" format=\"ascii\">97 0 98 0</Array></FieldData></PolyData></VTKFile>";
    };
    CHECK_THROWS_WITH(read_surface(written("a.vtp", list_of("1"))), Catch::Contains("texts"));
    CHECK_THROWS_WITH(read_surface(written("a.vtp", list_of("2"))), !Catch::Contains("texts"));
}

SCENARIO("A VTP file's lists of texts are read in every encoding", "[geometry][io]") {
    const std::string file = temporary_folder() + "/tube.vtp";
    write_surface(closed_tube(2.0, 8.0, 12, 4), file);
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName(file.c_str());
    reader->Update();
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetInputData(reader->GetOutput());
    writer->SetFileName(file.c_str());
    writer->SetDataMode(
        GENERATE(vtkXMLWriter::Ascii, vtkXMLWriter::Binary, vtkXMLWriter::Appended));
    if (GENERATE(false, true)) writer->SetCompressorTypeToNone();
    writer->SetEncodeAppendedData(GENERATE(0, 1));
    REQUIRE(writer->Write() == 1);
    CHECK(read_surface(file).surface.patches.size() == 3);
}

SCENARIO("A failed write leaves no file behind", "[geometry][io]") {
    const std::string folder = temporary_folder();
    CHECK_THROWS_AS(write_surface(cube(1.0), folder + "/missing/a.stl"), IoError);
    CHECK_THROWS_AS(write_surface(cube(1.0), folder + "/a.docx"), UsageError);
    CHECK_THROWS_AS(write_surface(Surface{}, folder + "/a.stl"), InvalidInput);
    CHECK(std::filesystem::is_empty(folder));
}
