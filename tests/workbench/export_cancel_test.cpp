#include <filesystem>
#include <fstream>

#include <catch2/catch.hpp>

#include "geometry/formats/image_file.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/pending_files.h"
#include "geometry/kernel/whole_file.h"
#include "meshing/tetrahedra/tetrahedralize.h"
#include "tests/support/shapes.h"
#include "tests/support/stop_at.h"
#include "workbench/export/export_formats.h"
#include "workbench/export/products.h"
#include "workbench/review/review_page_bytes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace fs = std::filesystem;

namespace {

/// A surface and a volume mesh whose files have several times the rows after which a writer asks.
const Scene& large_scene() {
    static const Scene scene = [] {
        Scene made;
        made.surface = icosphere(10.0, 5);
        made.volume_mesh = std::make_shared<const VolumeMesh>(
            tetrahedralized(fine_tube(2.0, 10.0, 24), {.cells = 40000.0}).mesh);
        return made;
    }();
    return scene;
}

std::string name_of(const ExportFormat& format) {
    return format.folder.empty() ? "model" + format.suffixes.front() : "case";
}

/// Without npm, a build has no page.
bool can_be_written(const ExportFormat& format) {
    return !format.takes_page || !viewer_page_bytes().empty();
}

/// A progress that is cancelled already.
Progress stopped() {
    std::stop_source stop;
    stop.request_stop();
    return {nullptr, stop.get_token()};
}

std::size_t entries_in(const fs::path& folder) {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

}  // namespace

SCENARIO("A cancel is heard within each file that is exported", "[workbench][cancel]") {
    for (const ExportFormat& format : export_formats()) {
        if (!can_be_written(format)) continue;
        const std::string name = name_of(format);
        INFO(name);
        const fs::path folder = temporary_folder();
        StopAt stop(0.2);
        {
            PendingFiles files;
            CHECK_THROWS_AS(export_scene(files, folder / name, large_scene(), {}, stop.progress()),
                            Cancelled);
        }
        CHECK(entries_in(folder) == 0);
        REQUIRE_FALSE(stop.fractions().empty());
        CHECK(*stop.fractions().begin() == 0.0);
        CHECK(*stop.fractions().rbegin() < 0.6);  // the rows after it were not written
    }
}

SCENARIO("An export that is not cancelled reports until its end", "[workbench][cancel]") {
    for (const ExportFormat& format : export_formats()) {
        if (!can_be_written(format)) continue;
        const std::string name = name_of(format);
        INFO(name);
        const fs::path folder = temporary_folder();
        StopAt never(2.0);
        PendingFiles files;
        export_scene(files, folder / name, large_scene(), {}, never.progress());
        files.commit();
        CHECK(entries_in(folder) == 1);
        CHECK(*never.fractions().rbegin() <= 1.0);
        CHECK(*never.fractions().rbegin() >= 0.4);
        CHECK_FALSE(never.whats().empty());
    }
}

SCENARIO("A cancelled export keeps an earlier file of the same name", "[workbench][cancel]") {
    const std::string file = temporary_folder() + "/model.stl";
    std::ofstream(file) << "an earlier result";
    StopAt stop(0.2);
    PendingFiles files;
    CHECK_THROWS_AS(export_scene(files, file, large_scene(), {}, stop.progress()), Cancelled);
    CHECK(file_content(file) == "an earlier result");
}

SCENARIO("A cancel is heard while bytes are compressed and written", "[workbench][cancel]") {
    const fs::path folder = temporary_folder();
    Image image;
    image.size = {4, 4, 4};
    image.voxels = std::make_shared<const std::vector<float>>(64, 1.0f);
    for (const char* name : {"a.nii", "a.nii.gz", "a.nrrd", "a.mha"})
        CHECK_THROWS_AS(write_image((folder / name).string(), image, stopped()), Cancelled);
    CHECK_THROWS_AS(write_file(folder / "a.txt", "text", stopped()), Cancelled);
    CHECK(entries_in(folder) == 0);
}
