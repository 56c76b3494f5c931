#include "geometry/formats/patient_axes.h"

#include <fstream>

#include <catch2/catch.hpp>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/measure.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

const Vec3 kPlace(30.0, -20.0, 50.0);  // [mm]

/// A sphere away from the origin, as written without a word on its axes.
std::string written(const std::string& suffix) {
    const std::string path = temporary_folder() + "/ball" + suffix;
    write_surface(icosphere(5.0, 2, kPlace), path);
    return path;
}

std::string bytes_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// The same file with a word of its header or comment replaced.
void state(const std::string& path, const std::string& was, const std::string& now) {
    std::string bytes = bytes_of(path);
    const auto at = bytes.find(was);
    REQUIRE(at != std::string::npos);
    bytes.replace(at, was.size(), now);
    std::ofstream(path, std::ios::binary) << bytes;
}

Vec3 middle_of(const SurfaceFile& file) {
    const Bounds box = bounds(file.surface);
    return 0.5 * (box.min + box.max);
}

const Vec3 kTurned = kPlace.cwiseProduct(Vec3(-1.0, -1.0, 1.0));

void check_turned(const SurfaceFile& file) {
    CHECK((middle_of(file) - kTurned).norm() < 1e-4);
    CHECK(file.axes == PatientAxes::Ras);
    CHECK(volume(file.surface) > 0.0);
    REQUIRE_FALSE(file.notes.empty());
    CHECK_THAT(file.notes.front(), Catch::Contains("RAS"));
}

void check_kept(const SurfaceFile& file) {
    CHECK((middle_of(file) - kPlace).norm() < 1e-4);
    CHECK(file.axes == PatientAxes::Lps);
}

}  // namespace

SCENARIO("The axes that a text states are known", "[geometry][io][axes]") {
    CHECK(stated_axes("3D Slicer output. SPACE=RAS") == PatientAxes::Ras);
    CHECK(stated_axes("3D Slicer output. SPACE=LPS;") == PatientAxes::Lps);
    CHECK(stated_axes("space=ras") == PatientAxes::Ras);
    CHECK_FALSE(stated_axes("made in a space"));
    CHECK_FALSE(stated_axes("SPACE=LAS"));
    CHECK_FALSE(stated_axes("SPACE="));
}

SCENARIO("A surface that states RAS is turned to LPS, one that states LPS or nothing is not",
         "[geometry][io][axes]") {
    GIVEN("a header of a binary STL, or a comment of a PLY or OBJ file") {
        for (const std::string suffix : {".stl", ".ply", ".obj"}) {
            CAPTURE(suffix);
            const std::string path = written(suffix);
            check_kept(read_surface(path));
            state(path, "vesselbench UNITS=mm", "UNITS=mm   SPACE=RAS");
            check_turned(read_surface(path));
            state(path, "SPACE=RAS", "SPACE=LPS");
            check_kept(read_surface(path));
        }
    }
    GIVEN("a name of a text STL") {
        const std::string path = temporary_folder() + "/a.stl";
        std::ofstream(path) << "solid 3D Slicer output. SPACE=RAS\nfacet normal 0 0 1\nouter loop\n"
                               "vertex 30 10 0\nvertex 40 10 0\nvertex 30 20 0\nendloop\nendfacet\n"
                               "endsolid\n";
        CHECK(bounds(read_surface(path, LengthUnit::Millimetre).surface).max.x() == Approx(-30.0));
    }
    GIVEN("a field array of a VTP file") {
        for (const std::string space : {"RAS", "LPS"}) {
            const std::string path = written(".vtp");
            const vtkNew<vtkXMLPolyDataReader> reader;
            reader->SetFileName(path.c_str());
            reader->Update();
            const vtkNew<vtkStringArray> stated;
            stated->SetName("SPACE");
            stated->InsertNextValue(space);
            reader->GetOutput()->GetFieldData()->AddArray(stated);
            const vtkNew<vtkXMLPolyDataWriter> writer;
            writer->SetFileName(path.c_str());
            writer->SetInputData(reader->GetOutput());
            REQUIRE(writer->Write() == 1);
            if (space == "RAS")
                check_turned(read_surface(path));
            else
                check_kept(read_surface(path));
        }
    }
    GIVEN("a title, or a field array, of a legacy VTK file") {
        const auto text = [](const std::string& title, const std::string& field) {
            const std::string path = temporary_folder() + "/a.vtk";
            std::ofstream(path) << "# vtk DataFile Version 4.2\n"
                                << title << "\nASCII\n"
                                << "DATASET POLYDATA\n"
                                << field
                                << "POINTS 4 float\n30 0 0 40 0 0 30 10 0 30 0 10\n"
                                   "POLYGONS 4 16\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
            return bounds(read_surface(path, LengthUnit::Millimetre).surface).max.x();
        };
        CHECK(text("3D Slicer output. SPACE=RAS", "") == Approx(-30.0));
        CHECK(text("x", "FIELD FieldData 1\nSPACE 1 1 string\nRAS\n") == Approx(-30.0));
        CHECK(text("x", "FIELD FieldData 1\nSPACE 1 1 string\nLPS\n") == Approx(40.0));
        CHECK(text("x", "") == Approx(40.0));
    }
    GIVEN("axes that are given: what the file states does not matter") {
        const std::string path = written(".stl");
        check_turned(read_surface(path, std::nullopt, PatientAxes::Ras));
        state(path, "vesselbench UNITS=mm", "UNITS=mm   SPACE=RAS");
        check_kept(read_surface(path, std::nullopt, PatientAxes::Lps));
    }
}
