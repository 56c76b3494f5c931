#include <filesystem>
#include <fstream>
#include <iterator>

#include <catch2/catch.hpp>
#include <gdcmAttribute.h>
#include <gdcmImage.h>
#include <gdcmImageWriter.h>
#include <gdcmMediaStorage.h>
#include <gdcmUIDGenerator.h>
#include <gdcmWriter.h>

#include "geometry/formats/dicom.h"
#include "geometry/formats/image_file.h"
#include "geometry/kernel/errors.h"
#include "tests/support/image_shapes.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;

namespace {

/// How one synthetic slice is written.
struct Slice {
    Vec3 position = Vec3::Zero();
    Vec3 along_row = Vec3::UnitX();
    Vec3 along_column = Vec3::UnitY();
    std::string series = "1.2.3.4";
    int columns = 4;
    int rows = 3;
    short first = 0;  ///< value of the first pixel; the others count up
};

constexpr double kColumnSpacing = 0.5, kRowSpacing = 0.75, kSlope = 2.0, kIntercept = -1000.0;

template <std::uint16_t Group, std::uint16_t Element>
void set_text(gdcm::DataSet& set, const char* text) {
    gdcm::Attribute<Group, Element> attribute;
    attribute.SetValue(text);
    set.Replace(attribute.GetAsDataElement());
}

void write_slice(const std::string& path, const Slice& slice) {
    gdcm::ImageWriter writer;
    gdcm::Image& image = writer.GetImage();
    image.SetNumberOfDimensions(2);
    image.SetDimension(0, static_cast<unsigned>(slice.columns));
    image.SetDimension(1, static_cast<unsigned>(slice.rows));
    image.SetPixelFormat(gdcm::PixelFormat::INT16);
    image.SetPhotometricInterpretation(gdcm::PhotometricInterpretation::MONOCHROME2);
    image.SetTransferSyntax(gdcm::TransferSyntax::ExplicitVRLittleEndian);
    image.SetSpacing(0, kColumnSpacing);
    image.SetSpacing(1, kRowSpacing);
    // The array form drops z of a two-dimensional image.
    for (unsigned a = 0; a < 3; ++a) image.SetOrigin(a, slice.position[a]);
    const double cosines[6] = {slice.along_row.x(),    slice.along_row.y(),
                               slice.along_row.z(),    slice.along_column.x(),
                               slice.along_column.y(), slice.along_column.z()};
    image.SetDirectionCosines(cosines);
    image.SetSlope(kSlope);
    image.SetIntercept(kIntercept);
    std::vector<short> pixels;
    for (int p = 0; p < slice.columns * slice.rows; ++p)
        pixels.push_back(static_cast<short>(slice.first + p));
    gdcm::DataElement data(gdcm::Tag(0x7fe0, 0x0010));
    data.SetByteValue(reinterpret_cast<const char*>(pixels.data()),
                      static_cast<std::uint32_t>(pixels.size() * sizeof(short)));
    image.SetDataElement(data);
    gdcm::DataSet& set = writer.GetFile().GetDataSet();
    set_text<0x0008, 0x0016>(set,
                             gdcm::MediaStorage::GetMSString(gdcm::MediaStorage::CTImageStorage));
    set_text<0x0008, 0x0018>(set, gdcm::UIDGenerator().Generate());
    set_text<0x0020, 0x000e>(set, slice.series.c_str());
    set_text<0x0028, 0x0004>(set, "MONOCHROME2");
    set_text<0x0010, 0x0010>(set, "Secret^Name");
    writer.SetFileName(path.c_str());
    REQUIRE(writer.Write());
}

/// Six oblique slices, 1.25 mm apart, in files whose names are in reverse order of position.
std::vector<Slice> oblique_series() {
    const Eigen::Matrix3d turn = skew_rotation();
    std::vector<Slice> slices;
    for (int s = 0; s < 6; ++s) {
        Slice slice;
        slice.along_row = turn.col(0);
        slice.along_column = turn.col(1);
        slice.position = Vec3(11, -22, 33) + 1.25 * s * Vec3(turn.col(2));
        slice.first = static_cast<short>(100 * s);
        slices.push_back(slice);
    }
    return slices;
}

std::string write_series(const std::vector<Slice>& slices) {
    const std::string folder = temporary_folder();
    for (std::size_t s = 0; s < slices.size(); ++s)
        write_slice(folder + "/slice" + std::to_string(9 - s) + ".dcm", slices[s]);
    std::ofstream(folder + "/LICENSE.txt") << "not a slice";
    return folder;
}

/// The files of a folder with other rows and columns in their headers.
void announce_size(const std::string& folder, std::uint16_t size) {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() != ".dcm") continue;
        std::ifstream in(entry.path(), std::ios::binary);
        std::string bytes(std::istreambuf_iterator<char>(in), {});
        for (const char element : {'\x10', '\x11'}) {
            const std::size_t at =
                bytes.find(std::string("\x28\0", 2) + element + std::string("\0US\2\0", 5));
            REQUIRE(at != std::string::npos);
            bytes[at + 8] = static_cast<char>(size & 0xff);
            bytes[at + 9] = static_cast<char>(size >> 8);
        }
        std::ofstream(entry.path(), std::ios::binary) << bytes;
    }
}

}  // namespace

SCENARIO("A DICOM slice that announces more pixels than it holds is refused",
         "[images][dicom][bad-input]") {
    const std::string folder = write_series(oblique_series());
    announce_size(folder, 40000);
    CHECK_THAT(message_of(folder), Contains("its header announces 3200000000 bytes"));
}

/// A DICOM file of another kind, by its SOP class, without pixels.
std::string write_object(const char* sop_class, const std::string& name) {
    gdcm::Writer writer;
    gdcm::File& file = writer.GetFile();
    file.GetHeader().SetDataSetTransferSyntax(gdcm::TransferSyntax::ExplicitVRLittleEndian);
    gdcm::DataSet& set = file.GetDataSet();
    set_text<0x0008, 0x0016>(set, sop_class);
    set_text<0x0008, 0x0018>(set, gdcm::UIDGenerator().Generate());
    const std::string path = temporary_folder() + "/" + name;
    writer.SetFileName(path.c_str());
    REQUIRE(writer.Write());
    return path;
}

SCENARIO("DICOM segmentations are refused with the way through 3D Slicer",
         "[images][dicom][labels][bad-input]") {
    for (const auto& [sop_class, kind] : {std::pair{"1.2.840.10008.5.1.4.1.1.481.3", "RTSTRUCT"},
                                          {"1.2.840.10008.5.1.4.1.1.66.4", "SEG"}}) {
        const std::string message = message_of(write_object(sop_class, "object.dcm"));
        CHECK_THAT(message, Contains("object.dcm") && Contains(kind) && Contains("3D Slicer") &&
                                Contains("labelmap") && Contains("--mask"));
    }
    GIVEN("one among the slices of its image") {
        const std::string folder = write_series(oblique_series());
        std::filesystem::copy(write_object("1.2.840.10008.5.1.4.1.1.481.3", "contours.dcm"),
                              folder + "/contours.dcm");
        CHECK_THAT(message_of(folder), Contains("contours.dcm") && Contains("RTSTRUCT"));
    }
}

SCENARIO("A DICOM series gives its true geometry", "[images][dicom]") {
    GIVEN("oblique slices in files of another order") {
        const auto slices = oblique_series();
        const ImageFile file = read_image_file(write_series(slices));
        const Image& image = file.image;
        THEN("columns, rows and slices lie where the headers say") {
            REQUIRE(image.size == std::array<int, 3>{4, 3, 6});
            const Slice& third = slices[2];
            const Vec3 expected = third.position + 3 * kColumnSpacing * third.along_row +
                                  2 * kRowSpacing * third.along_column;
            CHECK((image.to_patient(Vec3(3, 2, 2)) - expected).norm() < 1e-6);
            CHECK(
                (Vec3(image.index_to_patient.block<3, 1>(0, 0)) - kColumnSpacing * third.along_row)
                    .norm() < 1e-6);
            CHECK((Vec3(image.index_to_patient.block<3, 1>(0, 2)) -
                   1.25 * third.along_row.cross(third.along_column))
                      .norm() < 1e-6);
        }
        THEN("values are rescaled and in their slices") {
            CHECK(image.at(3, 2, 2) == Approx(kSlope * 211 + kIntercept));
        }
    }
    GIVEN("a tilted gantry") {
        auto slices = oblique_series();
        for (std::size_t s = 0; s < slices.size(); ++s)
            slices[s].position += 0.3 * static_cast<double>(s) * slices[s].along_column;
        const Image image = read_image(write_series(slices));
        THEN("the third axis is oblique") {
            CHECK((image.to_patient(Vec3(0, 0, 5)) - slices[5].position).norm() < 1e-6);
        }
    }
}

SCENARIO("A DICOM folder that is no volume is refused", "[images][dicom][bad-input]") {
    auto slices = oblique_series();
    WHEN("is a slice missing") {
        slices.erase(slices.begin() + 3);
        THEN("the gap is named") {
            CHECK_THAT(message_of(write_series(slices)), Contains("2.5 mm"));
        }
    }
    WHEN("two series lie in it") {
        slices[1].series = "1.2.3.5";
        THEN("they are counted") {
            CHECK_THAT(message_of(write_series(slices)), Contains("2 DICOM series"));
        }
    }
    WHEN("two slices lie in one place") {
        slices[1].position = slices[2].position;
        THEN("that is said") {
            CHECK_THAT(message_of(write_series(slices)), Contains("same place"));
        }
    }
    WHEN("a slice has another size") {
        slices[4].rows = 5;
        THEN("both sizes are named") {
            CHECK_THAT(message_of(write_series(slices)), Contains("4 x 3") && Contains("4 x 5"));
        }
    }
    WHEN("a slice has another orientation") {
        std::swap(slices[4].along_row, slices[4].along_column);
        THEN("that is said") {
            CHECK_THAT(message_of(write_series(slices)), Contains("orientation"));
        }
    }
    WHEN("a slice is cut off") {
        const std::string folder = write_series(slices);
        std::filesystem::resize_file(folder + "/slice7.dcm",
                                     std::filesystem::file_size(folder + "/slice7.dcm") - 9);
        THEN("it is named, and no patient") {
            const std::string text = message_of(folder);
            CHECK_THAT(text, Contains("slice7.dcm") && !Contains("Secret") && !Contains("/"));
        }
    }
    WHEN("there is none") {
        THEN("that is said") {
            CHECK_THAT(message_of(temporary_folder()), Contains("no DICOM"));
        }
    }
}

SCENARIO("Real DICOM files are read or refused for a reason", "[images][dicom][real-data]") {
    const std::string series = shared_data("images/dicom_series");
    if (series.empty()) return;
    const Image body = read_image(series);
    CHECK(body.size == std::array<int, 3>{512, 512, 3});
    CHECK((body.spacing() - Vec3(0.9765625, 0.9765625, 12.0)).norm() < 1e-9);
    CHECK((body.to_patient(Vec3::Zero()) - Vec3(-250, -250, -12)).norm() < 1e-9);
    CHECK_THAT(message_of(shared_data("images/vmtk_mr_multiframe.dcm")),
               Contains("16 frames are points in time"));
    CHECK_THAT(message_of(series + "/1-1.dcm"), Contains("single slice"));
    const Image frames = read_image(shared_data("images/vmtk_mr_multiframe_jpeg2000.dcm"));
    CHECK(frames.size == std::array<int, 3>{256, 256, 16});
    CHECK(*std::max_element(frames.voxels->begin(), frames.voxels->end()) == 252.0f);
}
