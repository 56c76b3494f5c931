#include "geometry/formats/image_file.h"

#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>

#include <catch2/catch.hpp>
#include <vtkImageData.h>
#include <vtkMatrix3x3.h>
#include <vtkNew.h>
#include <vtkXMLImageDataWriter.h>

#include "geometry/formats/image_bytes.h"
#include "geometry/formats/image_formats.h"
#include "geometry/formats/nifti.h"
#include "geometry/formats/surface_file.h"
#include "geometry/kernel/errors.h"
#include "tests/support/image_shapes.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;

namespace {

/// A value that no two voxels share: any mix-up of axes shows.
Image numbered(const Eigen::Matrix4d& matrix) {
    Image image;
    image.size = {4, 5, 6};
    image.index_to_patient = matrix;
    std::vector<float> voxels;
    for (int v = 0; v < 120; ++v) voxels.push_back(0.5f * static_cast<float>(v) - 7.0f);
    image.voxels = std::make_shared<const std::vector<float>>(voxels);
    return image;
}

std::string write_text(const std::string& name, const std::string& bytes) {
    const std::string path = temporary_folder() + "/" + name;
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
}

std::string bytes_in(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

template <class T>
std::string raw(const std::vector<T>& values) {
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

std::string counting_bytes(int count) {
    std::string bytes;
    for (int i = 0; i < count; ++i) bytes += static_cast<char>(i);
    return bytes;
}

template <class T>
void put(std::string& bytes, std::size_t at, T value) {
    std::memcpy(bytes.data() + at, &value, sizeof(T));
}

}  // namespace

SCENARIO("An image keeps its place, direction and values through every written format",
         "[images][io]") {
    const std::string suffix = GENERATE(from_range(written_suffixes(image_formats())));
    const bool mirrored = GENERATE(false, true);
    GIVEN("an oblique, anisotropic image as " + suffix + (mirrored ? ", mirrored" : "")) {
        const Image image =
            numbered(oblique_matrix(Vec3(0.4, 0.9, 2.5), Vec3(-31.5, 12.25, 140.0), mirrored));
        const std::string path = temporary_folder() + "/image" + suffix;
        write_image(path, image);
        const ImageFile file = read_image_file(path);
        THEN("every corner lies where it was") {
            REQUIRE(file.image.size == image.size);
            for (const Vec3& index : {Vec3(0, 0, 0), Vec3(3, 0, 0), Vec3(0, 4, 0), Vec3(3, 4, 5)})
                CHECK((file.image.to_patient(index) - image.to_patient(index)).norm() < 2e-5);
            CHECK(file.unit == 1.0);
        }
        THEN("every voxel has its value") {
            CHECK(*file.image.voxels == *image.voxels);
        }
    }
}

SCENARIO("Integers are stored in the smallest type that holds them", "[images][io]") {
    const float value = GENERATE(255.0f, -3.0f, 40000.0f);
    Image image = numbered(Eigen::Matrix4d::Identity());
    image.voxels = std::make_shared<const std::vector<float>>(120, value);
    const std::string path = temporary_folder() + "/whole.nrrd";
    write_image(path, image);
    CHECK(*read_image(path).voxels == *image.voxels);
}

SCENARIO("A NIfTI file's sform, qform, byte order, units and scaling are applied", "[images][io]") {
    const Image image = numbered(Eigen::Matrix4d::Identity());
    GIVEN("a qform that mirrors the slices, in metres, with slope and intercept") {
        std::string bytes = nifti_bytes(image);
        put<std::int16_t>(bytes, 252, 1);  // qform_code
        put<std::int16_t>(bytes, 254, 0);  // sform_code
        put(bytes, 76, -1.0f);             // qfac
        put(bytes, 80, 0.001f);
        put(bytes, 84, 0.002f);
        put(bytes, 88, 0.003f);
        // A quarter turn about z: b = c = 0, d = sin 45 degrees.
        put(bytes, 264, 0.70710678f);
        put(bytes, 268, 0.010f);
        put<std::uint8_t>(bytes, 123, 1);  // metres
        put(bytes, 112, 2.0f);
        put(bytes, 116, 100.0f);
        const ImageFile file = read_image_file(write_text("q.nii", bytes));
        THEN("the axes are turned, mirrored and in LPS millimetres") {
            const Eigen::Matrix4d& m = file.image.index_to_patient;
            CHECK((m.col(0).head<3>() - Vec3(0, -1, 0)).norm() < 1e-5);  // RAS +y is LPS -y
            CHECK((m.col(1).head<3>() - Vec3(2, 0, 0)).norm() < 1e-5);   // RAS -x is LPS +x
            CHECK((m.col(2).head<3>() - Vec3(0, 0, -3)).norm() < 1e-5);
            CHECK((m.col(3).head<3>() - Vec3(-10, 0, 0)).norm() < 1e-5);
            CHECK(file.unit == 1000.0);
        }
        THEN("values are scaled") {
            CHECK((*file.image.voxels)[3] == Approx(2.0 * (*image.voxels)[3] + 100.0));
        }
    }
    GIVEN("a big-endian file") {
        std::string bytes = nifti_bytes(image);
        const auto swap = [&](std::size_t at, std::size_t size) {
            std::reverse(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                         bytes.begin() + static_cast<std::ptrdiff_t>(at + size));
        };
        swap(0, 4);
        for (std::size_t i = 0; i < 8; ++i) swap(40 + 2 * i, 2);
        for (const std::size_t at : {70u, 72u, 252u, 254u}) swap(at, 2);
        for (std::size_t at = 76; at < 120; at += 4) swap(at, 4);
        for (std::size_t at = 256; at < 328; at += 4) swap(at, 4);
        for (std::size_t at = 352; at < bytes.size(); at += 4) swap(at, 4);
        const Image read = read_image(write_text("big.nii", bytes));
        THEN("it is the same image") {
            CHECK(*read.voxels == *image.voxels);
            CHECK(same_grid(read, image));
        }
    }
    GIVEN("neither sform nor qform") {
        std::string bytes = nifti_bytes(image);
        put<std::int16_t>(bytes, 254, 0);
        const ImageFile file = read_image_file(write_text("none.nii", bytes));
        THEN("that is said") {
            REQUIRE(file.notes.size() == 1);
            CHECK_THAT(file.notes[0], Contains("orientation"));
        }
    }
}

SCENARIO("NRRD headers of all kinds are understood", "[images][io]") {
    const std::string voxels = counting_bytes(2 * 3 * 2);
    const std::string head = "NRRD0004\n# comment\ntype: unsigned char\ndimension: 3\n";
    GIVEN("RAS space, raw data") {
        const Image image = read_image(
            write_text("ras.nrrd", head +
                                       "space: right-anterior-superior\nsizes: 2 3 2\n"
                                       "space directions: (0.5, 0, 0) (0,0.25,0) (0,0,-2)\n"
                                       "space origin: (10,20,30)\nencoding: raw\n\n" +
                                       voxels));
        THEN("it is turned to LPS") {
            CHECK((image.to_patient(Vec3(1, 1, 1)) - Vec3(-10.5, -20.25, 28)).norm() < 1e-12);
            CHECK(image.at(1, 2, 1) == 11.0f);
        }
    }
    GIVEN("no space, no spacing, text encoding") {
        const ImageFile file = read_image_file(
            write_text("text.nrrd", head + "sizes: 2 2 2\nencoding: ascii\n\n1 2 3 4\n5 6 7 8\n"));
        THEN("1 mm and LPS are taken, and both are said") {
            CHECK(file.image.at(1, 1, 1) == 8.0f);
            CHECK((file.image.spacing() - Vec3::Ones()).norm() == 0.0);
            CHECK(file.notes.size() == 2);
        }
    }
    GIVEN("a detached header with big-endian voxels in another file") {
        const std::string folder = temporary_folder();
        std::ofstream(folder + "/d.raw", std::ios::binary)
            << std::string("\x01\x00\x02\x00", 4) << std::string("\x00\x03\x00\x04", 4);
        std::ofstream(folder + "/d.nhdr")
            << "NRRD0004\ntype: short\ndimension: 3\nspace: LPS\nsizes: 2 2 1\nspacings: 1 2 3\n"
               "endian: big\nencoding: raw\ndata file: d.raw\n";
        const Image image = read_image(folder + "/d.nhdr");
        THEN("it is read") {
            CHECK(image.at(0, 0, 0) == 256.0f);
            CHECK(image.at(1, 1, 0) == 4.0f);
            CHECK((image.spacing() - Vec3(1, 2, 3)).norm() == 0.0);
        }
    }
    GIVEN("several values per voxel") {
        THEN("it is refused with the remedy") {
            CHECK_THAT(
                message_of(write_text("rgb.nrrd",
                                      "NRRD0004\ntype: uchar\ndimension: 4\nsizes: 3 2 2 1\n"
                                      "space: LPS\nspace directions: none (1,0,0) (0,1,0) (0,0,1)\n"
                                      "encoding: raw\n\n" +
                                          voxels)),
                Contains("rgb.nrrd") && Contains("values per voxel"));
        }
    }
}

SCENARIO("MetaImage headers of all kinds are understood", "[images][io]") {
    const std::string head = "ObjectType = Image\nNDims = 3\nDimSize = 2 2 2\n";
    GIVEN("rows of the matrix that are the axes' directions, data beside the header") {
        const std::string folder = temporary_folder();
        std::ofstream(folder + "/m.raw", std::ios::binary) << "pad" << counting_bytes(8);
        std::ofstream(folder + "/m.mhd")
            << head << "TransformMatrix = 0 1 0 0 0 1 1 0 0\nOffset = 5 6 7\n"
            << "ElementSpacing = 0.5 1.5 2.5\nDistanceUnits = cm\nHeaderSize = -1\n"
            << "ElementType = MET_UCHAR\nElementDataFile = m.raw\n";
        const Image image = read_image(folder + "/m.mhd");
        THEN("the first axis points along the first row, in mm") {
            CHECK((image.to_patient(Vec3(1, 0, 0)) - Vec3(50, 65, 70)).norm() < 1e-12);
            CHECK((image.to_patient(Vec3(0, 0, 1)) - Vec3(75, 60, 70)).norm() < 1e-12);
            CHECK(image.at(1, 1, 1) == 7.0f);
        }
    }
    GIVEN("voxels as text") {
        const Image image =
            read_image(write_text("t.mha", head + "BinaryData = False\nElementType = MET_SHORT\n"
                                                  "ElementDataFile = LOCAL\n1 2 3 4 5 6 7 -8\n"));
        THEN("they are read") {
            CHECK(image.at(1, 1, 1) == -8.0f);
        }
    }
}

SCENARIO("A detached header names a file that can exist", "[images][io][bad-input]") {
    for (const std::string& name : {std::string("\0d.raw", 6), std::string("\x1b[31m.raw")}) {
        const std::string nrrd =
            "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 2 1\nencoding: raw\n";
        const std::string meta =
            "ObjectType = Image\nNDims = 3\nDimSize = 2 2 1\nElementType = MET_UCHAR\n";
        for (const std::string& path : {write_text("d.nhdr", nrrd + "data file: " + name + "\n"),
                                        write_text("d.mhd", meta + "ElementDataFile = " + name)})
            CHECK_THAT(message_of(path), Contains("name of its voxel file is '\\x"));
    }
}

SCENARIO("A VTK image keeps its direction matrix", "[images][io]") {
    vtkNew<vtkImageData> data;
    data->SetExtent(2, 4, 0, 3, 0, 1);
    data->SetSpacing(0.5, 1.0, 2.0);
    data->SetOrigin(1.0, 2.0, 3.0);
    const Eigen::Matrix3d turn = skew_rotation();
    double direction[9];
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) direction[3 * r + c] = turn(r, c);
    data->SetDirectionMatrix(direction);
    data->AllocateScalars(VTK_SHORT, 1);
    for (int v = 0; v < 24; ++v) static_cast<short*>(data->GetScalarPointer())[v] = v;
    const std::string path = temporary_folder() + "/turned.vti";
    vtkNew<vtkXMLImageDataWriter> writer;
    writer->SetFileName(path.c_str());
    writer->SetInputData(data);
    writer->Write();
    const ImageFile file = read_image_file(path);
    double expected[3];
    data->TransformIndexToPhysicalPoint(3, 2, 1, expected);
    CHECK((file.image.to_patient(Vec3(1, 2, 1)) - Vec3(expected)).norm() < 1e-9);
    CHECK(file.image.at(1, 2, 1) == 19.0f);
    CHECK(file.notes.size() == 1);
}

SCENARIO("Truncated and damaged images are refused with name, cause and remedy",
         "[images][io][bad-input]") {
    const std::string suffix = GENERATE(".nii", ".nii.gz", ".mha", ".nrrd");
    const std::string whole = temporary_folder() + "/whole" + suffix;
    write_image(whole, numbered(oblique_matrix(Vec3(1, 1, 2), Vec3::Zero())));
    const std::string bytes = bytes_in(whole);
    for (const std::size_t length :
         {std::size_t{0}, std::size_t{3}, bytes.size() / 4, bytes.size() / 2, bytes.size() - 9}) {
        const std::string path = write_text("cut" + suffix, bytes.substr(0, length));
        const std::string text = message_of(path);
        INFO(suffix << " cut to " << length << " bytes: " << text);
        CHECK_THAT(text, Contains("cut" + suffix) && Contains(";"));
        CHECK(text.find('/') == std::string::npos);
    }
}

SCENARIO("A flipped byte never crashes a reader", "[images][io][bad-input]") {
    const std::string suffix = GENERATE(".nii", ".mha", ".nrrd", ".nii.gz");
    const std::string whole = temporary_folder() + "/whole" + suffix;
    write_image(whole, numbered(oblique_matrix(Vec3(1, 1, 2), Vec3::Zero())));
    const std::string bytes = bytes_in(whole);
    const std::string path = temporary_folder() + "/spoiled" + suffix;
    for (std::size_t at = 0; at < bytes.size(); at += 7)
        for (const char mask : {'\x01', '\x40', '\x7f'}) {
            std::string spoiled = bytes;
            spoiled[at] = static_cast<char>(spoiled[at] ^ mask);
            std::ofstream(path, std::ios::binary | std::ios::trunc) << spoiled;
            try {
                const Image image = read_image(path);
                REQUIRE(image.voxels->size() == image.voxel_count());
            } catch (const InvalidInput&) {
            } catch (const IoError&) {
            }
        }
    SUCCEED();
}

SCENARIO("Absurd sizes, bad numbers and unknown files are refused", "[images][io][bad-input]") {
    const std::string mha = "NDims = 3\nElementType = MET_FLOAT\n";
    CHECK_THAT(message_of(write_text("a.mha", mha + "DimSize = 99999 99999 99999\n"
                                                    "ElementDataFile = LOCAL\n")),
               Contains("2^30"));
    CHECK_THAT(message_of(write_text("b.mha", mha + "DimSize = 2 2 -2\nElementDataFile = LOCAL\n")),
               Contains("damaged"));
    CHECK_THAT(message_of(write_text("c.mha", mha +
                                                  "DimSize = 2 1 1\nElementSpacing = 1 nan 1\n"
                                                  "ElementDataFile = LOCAL\n" +
                                                  raw<float>({1, 2}))),
               Contains("not a number"));
    const float nan = std::numeric_limits<float>::quiet_NaN();
    CHECK_THAT(message_of(write_text("d.mha", mha + "DimSize = 2 1 1\nElementDataFile = LOCAL\n" +
                                                  raw<float>({1, nan}))),
               Contains("1 of its 2 voxels"));
    CHECK_THAT(message_of(write_text("e.mha", mha +
                                                  "DimSize = 2 1 1\nElementSpacing = 1 0 1\n"
                                                  "ElementDataFile = LOCAL\n" +
                                                  raw<float>({1, 2}))),
               Contains("degenerate"));
    CHECK_THAT(message_of(write_text("f.vti", "<VTKFile type=\"ImageData\">")),
               Contains("truncated"));
    CHECK_THAT(message_of(write_text("g.vtk",
                                     "# vtk DataFile Version 3.0\nx\nBINARY\n"
                                     "DATASET STRUCTURED_POINTS\nDIMENSIONS 900 900 900\n")),
               Contains("truncated"));
    CHECK_THAT(message_of(write_text("h.jpg", "nothing")), Contains("format"));
    CHECK_THROWS_AS(read_image(temporary_folder() + "/absent.nii"), IoError);
    CHECK_THROWS_AS(
        write_image(temporary_folder() + "/x.png", numbered(Eigen::Matrix4d::Identity())),
        UsageError);
}

SCENARIO("Real images are read with their geometry", "[images][io][real-data]") {
    const std::string levelset = shared_data("images/vmtk_aorta_final_levelset.mha");
    if (levelset.empty()) return;
    const Image aorta = read_image(levelset);
    CHECK(aorta.size == std::array<int, 3>{157, 393, 34});
    CHECK(aorta.index_to_patient(0, 0) == Approx(-0.878906));
    const ImageFile stent = read_image_file(shared_data("images/stent_graft_ct.nrrd"));
    CHECK(stent.image.size == std::array<int, 3>{128, 128, 256});
    CHECK(stent.notes.size() == 1);
    const Image carotid = read_image(shared_data("images/vtk_carotid.vtk"));
    CHECK(carotid.size == std::array<int, 3>{76, 49, 45});
    CHECK(*std::max_element(carotid.voxels->begin(), carotid.voxels->end()) == 580.0f);
    const Image mra = read_image(shared_data("images/niivue_tof_mra.nii.gz"));
    CHECK((mra.spacing() - Vec3(0.520833, 0.520833, 0.65)).norm() < 1e-4);
    CHECK_FALSE(holds_surface(shared_data("images/vtk_carotid.vtk")));
    CHECK(holds_surface(shared_data("surfaces/vampy_vein.stl")));
}
