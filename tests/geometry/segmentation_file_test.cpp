#include <algorithm>
#include <fstream>

#include <catch2/catch.hpp>

#include "geometry/formats/image_file.h"
#include "geometry/image/threshold.h"
#include "geometry/kernel/errors.h"
#include "tests/support/image_shapes.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;

namespace {

/// A .seg.nrrd with voxels as text. \param sizes "4 3 2", or with layers "2 4 3 2"
std::string segmentation(const std::string& sizes, const std::string& segments,
                         const std::string& voxels) {
    const bool layered = std::count(sizes.begin(), sizes.end(), ' ') == 3;
    const std::string path = temporary_folder() + "/drawn.seg.nrrd";
    std::ofstream(path) << "NRRD0004\ntype: uchar\ndimension: " << (layered ? 4 : 3)
                        << "\nspace: left-posterior-superior\nsizes: " << sizes
                        << "\nspace directions: " << (layered ? "none " : "")
                        << "(2,0,0) (0,2,0) (0,0,2)\nencoding: ascii\nspace origin: (0,0,0)\n"
                        << segments << "\n"
                        << voxels << "\n";
    return path;
}

std::string segment(int number, const std::string& name, int label, int layer) {
    const std::string prefix = "Segment" + std::to_string(number) + "_";
    return prefix + "ID:=Segment_" + std::to_string(number + 1) + "\n" + prefix +
           "LabelValue:=" + std::to_string(label) + "\n" + prefix +
           "Layer:=" + std::to_string(layer) + "\n" + prefix + "Name:=" + name + "\n" + prefix +
           "Color:=1 0.5 0\n";
}

}  // namespace

SCENARIO("Segments of 3D Slicer have names, labels and colours", "[formats][labels]") {
    const std::string path = segmentation(
        "2 2 2", segment(0, "artery", 1, 0) + segment(1, "bone, left", 7, 0), "0 1 1 0 7 7 0 0");
    const ImageFile file = read_segmentation_file(path);
    REQUIRE(file.segments.size() == 2);
    CHECK(file.segments[0].name == "artery");
    CHECK(file.segments[1].name == "bone, left");
    CHECK(file.segments[1].label == 7);
    CHECK(file.segments[0].colour == std::array<std::uint8_t, 3>{255, 128, 0});
    CHECK(labels_of(file.image) == std::vector<int>{1, 7});
    CHECK(read_image_file(path).segments.size() == 2);
}

SCENARIO("Segments that overlap are read in layers", "[formats][labels]") {
    const std::string path =
        segmentation("2 2 2 2", segment(0, "lumen", 1, 0) + segment(1, "wall", 1, 1),
                     "0 0  1 1  1 1  0 1  0 1  0 0  0 0  0 0");
    const ImageFile file = read_segmentation_file(path);
    REQUIRE(file.layers.size() == 1);
    REQUIRE(file.stored.size() == 2);
    CHECK(file.image.size == std::array<int, 3>{2, 2, 2});
    CHECK(*file.image.voxels == std::vector<float>{0, 1, 1, 0, 0, 0, 0, 0});
    CHECK(*file.layers[0].voxels == std::vector<float>{0, 1, 1, 1, 1, 0, 0, 0});
    CHECK(file.segments[0].label == 1);
    CHECK(file.segments[1].label == 2);
    THEN("who wants an image is refused") {
        CHECK_THROWS_WITH(read_image_file(path), Contains("overlap") && Contains("label map"));
    }
}

SCENARIO("Damaged descriptions of segments are left out with a note",
         "[formats][labels][bad-input]") {
    const ImageFile file = read_segmentation_file(
        segmentation("2 2 2",
                     "Segment0_ID:=Segment_1\nSegment0_Name:=lost\n" + segment(1, "artery", 1, 0) +
                         segment(2, "beyond", 1, 5),
                     "0 1 1 0 0 0 0 0"));
    REQUIRE(file.segments.size() == 1);
    CHECK(file.segments[0].name == "artery");
    CHECK(file.notes.size() >= 2);
    CHECK_THROWS_AS(read_segmentation_file(segmentation("2000 2 2 2", segment(0, "a", 1, 0), "0")),
                    InvalidInput);
}

SCENARIO("Sizes of labels are those of their voxels", "[images][labels]") {
    const Image labels = image_of({6, 6, 6}, Eigen::Matrix4d::Identity(), [](const Vec3& p) {
        return p.x() < 2.5 ? 0.0 : p.y() < 1.5 ? 3.0 : 1.0;
    });
    const auto sizes = label_sizes(labels);
    REQUIRE(sizes.size() == 2);
    CHECK(sizes.at(3).volume == Approx(36.0));
    CHECK((sizes.at(3).size - Vec3(3, 2, 6)).norm() < 1e-9);
    CHECK(sizes.at(1).volume == Approx(72.0));
    CHECK(name_of_label({{.label = 3, .name = "bone"}}, 3) == "bone");
    CHECK(name_of_label({{.label = 3, .name = "bone"}}, 1) == "label 1");
}
