#include <fstream>
#include <set>

#include <catch2/catch.hpp>

#include "geometry/formats/centerline_file.h"
#include "geometry/formats/image_file.h"
#include "geometry/formats/image_formats.h"
#include "geometry/formats/surface_file.h"
#include "geometry/formats/surface_formats.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;

namespace {

std::string written(const std::string& name, const std::string& content) {
    const std::string path = temporary_folder() + "/" + name;
    std::ofstream(path, std::ios::binary) << content;
    return path;
}

template <class Row>
void check_rows(const std::vector<Row>& rows, FormatKind kind) {
    std::set<std::string> suffixes;
    for (const Row& row : rows) {
        CAPTURE(row.name);
        CHECK(row.kind == kind);
        CHECK_FALSE(row.content.empty());
        CHECK((row.read || row.write));
        CHECK((!row.folder.empty() || !row.suffixes.empty()));
        for (const std::string& suffix : row.suffixes) {
            CAPTURE(suffix);
            CHECK(suffix.ends_with(lower_suffix("x" + suffix)));  // lower case, with its dot
            CHECK(suffixes.insert(suffix).second);  // no two rows of a kind share a suffix
        }
    }
}

}  // namespace

SCENARIO("Every row of the tables can be chosen by a suffix of its own", "[geometry][formats]") {
    check_rows(surface_formats(), FormatKind::Surface);
    check_rows(image_formats(), FormatKind::Image);
}

SCENARIO("A suffix of two parts is named as a whole", "[geometry][formats]") {
    CHECK(lower_suffix("out/Head.NII.GZ") == ".nii.gz");
    CHECK(lower_suffix("head.gz") == ".gz");
    CHECK(lower_suffix("v1.2/head") == "");
    CHECK(lower_suffix("head.1.stl") == ".stl");
}

SCENARIO("A format that shares a suffix with another kind is known by its content",
         "[geometry][formats]") {
    for (const SurfaceFormat& surface : surface_formats())
        for (const ImageFormat& image : image_formats())
            if (surface.suffixes == image.suffixes) {
                CAPTURE(surface.suffixes[0]);
                CHECK(surface.sniff != nullptr);
                CHECK(image.sniff != nullptr);
            }
    const std::string head = "# vtk DataFile Version 3.0\nx\nASCII\nDATASET ";
    CHECK(holds_surface(written("a.VTK", head + "POLYDATA\n")));
    CHECK_FALSE(holds_surface(written("a.vtk", head + "STRUCTURED_POINTS\n")));
    CHECK_FALSE(holds_surface(written("a.nii", "")));
}

SCENARIO("A DICOM file is known by its content, whatever its name", "[geometry][formats]") {
    const std::string file = written("IM0001", std::string(128, '\0') + "DICM and more");
    const ImageFormat* row = row_that_reads(image_formats(), file);
    REQUIRE(row);
    CHECK(row->name == "DICOM");
    CHECK(row_that_reads(image_formats(), written("IM0002", "something else")) == nullptr);
    CHECK(row_that_reads(image_formats(), temporary_folder())->name == "DICOM");
}

SCENARIO("Errors about a suffix list all suffixes of the table", "[geometry][formats]") {
    for (const std::string& suffix : read_suffixes(surface_formats()))
        CHECK_THROWS_WITH(read_surface("a.docx"), Contains(suffix));
    for (const std::string& suffix : written_suffixes(surface_formats()))
        CHECK_THROWS_WITH(write_surface(cube(1.0), "a.docx"), Contains(suffix));
    for (const std::string& suffix : read_suffixes(image_formats()))
        CHECK_THROWS_WITH(read_image(written("a.docx", "x")), Contains(suffix));
    CHECK_THROWS_AS(check_centerline_name("lines.stl"), UsageError);
    CHECK_THROWS_WITH(write_surface(cube(1.0), "a.docx"), !Contains(".vtk"));  // only read
}

SCENARIO("Texts about folders follow from the rows", "[geometry][formats]") {
    CHECK(folder_text(image_formats()) == "a folder of DICOM slices");
    CHECK(folder_text(image_formats(), "folders") == "folders of DICOM slices");
    CHECK(folder_text(surface_formats()) == "");
    CHECK_THAT(image_formats_text(), Contains(folder_text(image_formats())));
}

SCENARIO("Words are enumerated as in a sentence", "[geometry][formats]") {
    CHECK(enumerated({}) == "");
    CHECK(enumerated({"a"}) == "a");
    CHECK(enumerated({"a", "b", "c"}, "or") == "a, b or c");
}
