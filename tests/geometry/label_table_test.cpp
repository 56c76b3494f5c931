#include "geometry/formats/label_table.h"

#include <fstream>

#include <catch2/catch.hpp>

#include "geometry/formats/image_file.h"
#include "geometry/kernel/label_table_places.h"
#include "tests/support/image_shapes.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

using Colour = std::array<std::uint8_t, 3>;

std::vector<std::string> names_in_table(const std::string& text) {
    std::vector<std::string> names;
    for (const Segment& segment : label_table_in(text))
        names.push_back(std::to_string(segment.label) + " " + segment.name);
    return names;
}

const std::vector<std::string> kBoth = {"1 aorta", "2 left kidney"};

}  // namespace

SCENARIO("Label tables of several programs name a label map's labels", "[formats][labels]") {
    GIVEN("ITK-SNAP's descriptions") {
        const std::string text =
            "# ITK-SnAP Label Description File\n"
            "    0     0    0    0        0  0  0    \"Clear Label\"\n"
            "    1   255    0    0        1  1  1    \"aorta\"\n"
            "    2     0  255    0        1  1  1    \"left kidney\"\n";
        CHECK(names_in_table(text) == kBoth);
        CHECK(label_table_in(text)[0].colour == Colour{255, 0, 0});
    }
    GIVEN("a colour table of 3D Slicer or FreeSurfer") {
        const std::string text =
            "# Color table\n0 Background 0 0 0 0\n1 aorta 255 0 0 255\n2 left kidney 0 255 0 255\n";
        CHECK(names_in_table(text) == kBoth);
        CHECK(label_table_in(text)[1].colour == Colour{0, 255, 0});
    }
    GIVEN("columns as of BIDS") {
        const std::string text = "index\tname\tcolor\n1\taorta\t#ff0000\n2\tleft kidney\t#00ff00\n";
        CHECK(names_in_table(text) == kBoth);
        CHECK(label_table_in(text)[0].colour == Colour{255, 0, 0});
        CHECK(names_in_table("id,name\n1,aorta\n2,\"left kidney\"\n") == kBoth);
    }
    GIVEN("JSON") {
        CHECK(names_in_table(R"({"1": "aorta", "2": "left kidney"})") == kBoth);
        CHECK(names_in_table(R"({"background": 0, "aorta": 1, "left kidney": 2})") == kBoth);
        CHECK(names_in_table(R"({"labels": {"aorta": 1, "left kidney": "2"}, "name": "x"})") ==
              kBoth);
        CHECK(names_in_table(
                  R"([{"label": 2, "name": "left kidney"}, {"label": 1, "name": "aorta"}])") ==
              kBoth);
    }
}

SCENARIO("What is no label table names nothing", "[formats][labels][bad-input]") {
    for (const char* text :
         {"", "a letter to the reader", R"({"EchoTime": 0.03, "Manufacturer": "x"})", "{", "[[[[",
          "1 aorta\n", "index\tname\n1\n", R"([1, 2])", R"({"labels": {"labels": {}}})",
          "1 255 0 0 1 1 1 \"aorta\"\nnot a line of the table\n"}) {
        INFO(text);
        CHECK(label_table_in(text).empty());
    }
}

SCENARIO("A table lies beside its label map, with the same base name", "[formats][labels]") {
    const auto places = label_table_places("/a/seg.nii.gz");
    REQUIRE(places.size() == 6);
    CHECK(places.front() == "/a/seg.txt");
    CHECK(label_table_places("/a/two.seg.nrrd").back() == "/a/two.json");
    CHECK(label_table_places("/a/model.stl").empty());
    CHECK(label_table_places("/a/folder").empty());
    const std::string folder = temporary_folder();
    const Image labels = image_of({20, 6, 6}, Eigen::Matrix4d::Identity(), [](const Vec3& p) {
        return p.x() < 5.5 ? 0.0 : p.x() < 12.5 ? 1.0 : 2.0;
    });
    write_image(folder + "/seg.nii.gz", labels);
    CHECK(read_segmentation_file(folder + "/seg.nii.gz").segments.empty());
    std::ofstream(folder + "/seg.txt") << "notes about the patient\n";
    std::ofstream(folder + "/seg.json") << R"({"aorta": 1, "left kidney": 2})";
    const ImageFile file = read_segmentation_file(folder + "/seg.nii.gz");
    REQUIRE(file.segments.size() == 2);
    CHECK(file.segments[1].name == "left kidney");
    CHECK(file.notes.back().find("'seg.json'") != std::string::npos);
}

SCENARIO("Names of segments are stored in one line without control characters",
         "[formats][labels][bad-input]") {
    const auto names = names_in_table("{\"a\\u001b[31m\\nb\": 1}");
    REQUIRE(names.size() == 1);
    CHECK(names[0].find('\x1b') == std::string::npos);
    CHECK(names[0].find('\n') == std::string::npos);
    CHECK(names_in_table("{\"" + std::string(500, 'x') + "\": 1}")[0].size() < 80);
}
