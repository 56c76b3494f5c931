#include <filesystem>

#include <catch2/catch.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/pending_files.h"
#include "geometry/kernel/whole_file.h"
#include "meshing/tetrahedra/tetrahedralize.h"
#include "tests/support/shapes.h"
#include "workbench/export/export_formats.h"
#include "workbench/export/products.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;

namespace fs = std::filesystem;

namespace {

const Scene& tube_scene() {
    static const Scene scene = [] {
        Scene made;
        made.surface = fine_tube(2.0, 10.0, 24);
        made.volume_mesh = std::make_shared<const VolumeMesh>(
            tetrahedralized(*made.surface, {.cells = 2000.0}).mesh);
        return made;
    }();
    return scene;
}

/// \return the file's path, or the folder's
std::string exported(const std::string& name, const std::string& provenance) {
    const fs::path file = fs::path(temporary_folder()) / name;
    PendingFiles files;
    export_scene(files, file, tube_scene(), {.provenance = provenance});
    files.commit();
    return file.string();
}

constexpr const char* kLine = "project case, cfd, model 1a2b3c4d5e6f, not reviewed";
constexpr const char* kHostile = "\nv 0 0 0\n\x1b[31m */ #codeStream UNITS=m <x>\xe2\x80\xae &";

}  // namespace

SCENARIO("Exported files carry a line on their provenance", "[workbench][export]") {
    for (const char* name : {"a.ply", "a.obj", "a.off", "a.vtp", "a.vtu", "a.glb"})
        CHECK_THAT(file_content(exported(name, kLine)), Contains(kLine));
    const std::string foam = exported("case", kLine);
    for (const char* file : {"/README", "/system/controlDict"})
        CHECK_THAT(file_content(foam + file), Contains(kLine));
    THEN("an STL file has as much of it as fits into 80 bytes") {
        const std::string bytes = file_content(exported("a.stl", kLine));
        CHECK_THAT(bytes.substr(0, 80), Contains("UNITS=mm, project case, cfd, model 1a2b3c4d"));
        CHECK(bytes.size() == 84 + 50 * tube_scene().surface->triangle_count());
    }
    THEN("without one, no file mentions it") {
        CHECK_THAT(file_content(exported("a.vtp", "")), !Contains("Provenance"));
        CHECK(file_content(exported("a.3mf", "")) != file_content(exported("a.3mf", kLine)));
    }
}

SCENARIO("No text of a project changes what a file means", "[workbench][export]") {
    for (const char* name : {"a.stl", "a.ply", "a.obj", "a.off", "a.vtp"}) {
        CAPTURE(name);
        const std::string file = exported(name, kHostile);
        const SurfaceFile read = read_surface(file);
        CHECK(read.unit == LengthUnit::Millimetre);
        CHECK(read.unit_reason == "stated in the file");
        CHECK(read.surface.triangle_count() == tube_scene().surface->triangle_count());
        CHECK(volume(read.surface) == Approx(volume(*tube_scene().surface)).epsilon(1e-5));
        for (const char* part : {"\x1b[31m", "#codeStream", "UNITS=m ", "<x>", "\xe2\x80\xae"})
            CHECK_THAT(file_content(file), !Contains(part));
    }
    CHECK_THAT(file_content(exported("case", kHostile) + "/system/controlDict"),
               !Contains("#codeStream") && !Contains("\x1b"));
}
