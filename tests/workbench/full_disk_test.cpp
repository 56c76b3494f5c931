#include <filesystem>
#include <fstream>
#include <string>

#include <catch2/catch.hpp>

#include "geometry/formats/surface_file.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "tests/support/skip.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;

namespace {

/// A disk of 2 MiB, where the test may mount one.
class SmallDisk {
public:
    SmallDisk()
        : mounted_(
              run_program("mount", {"-t", "tmpfs", "-o", "size=2m", "tmpfs", folder_}).exit_code ==
              0) {
        if (!mounted_) skip("no disk can be mounted (needs root)");
    }

    ~SmallDisk() {
        if (mounted_) static_cast<void>(run_program("umount", {"-l", folder_}));
    }

    SmallDisk(const SmallDisk&) = delete;
    SmallDisk& operator=(const SmallDisk&) = delete;

    [[nodiscard]] bool is_mounted() const { return mounted_; }

    [[nodiscard]] std::string path(const std::string& name) const { return folder_ + "/" + name; }

    void fill() const {
        std::ofstream file(path("full"), std::ios::binary);
        const std::string page(4096, 'x');
        while (file) file.write(page.data(), static_cast<std::streamsize>(page.size())).flush();
    }

private:
    std::string folder_ = temporary_folder();
    bool mounted_;
};

}  // namespace

SCENARIO("A project on a full disk can be read, and its model saved elsewhere",
         "[workbench][command-line][hostile]") {
    const SmallDisk disk;
    if (!disk.is_mounted()) return;
    const std::string elsewhere = temporary_folder(), project = disk.path("p.vbench");
    write_surface(icosphere(10.0, 2), elsewhere + "/ball.stl");
    REQUIRE(run({"new", project, elsewhere + "/ball.stl", "--units", "mm"}).exit_code == 0);
    disk.fill();
    const ProgramRun log = run({"log", project});
    INFO(log.err);
    CHECK(log.exit_code == 0);
    CHECK_THAT(log.out, Contains("load-surface"));
    CHECK(run({"review", project}).exit_code == 0);
    CHECK(run({"audit", project}).exit_code == 0);
    const ProgramRun saved = run({"export", project, elsewhere + "/model.stl"});
    CHECK(saved.exit_code == 0);
    CHECK_THAT(saved.err, Contains("the export is not recorded"));
    CHECK(read_surface(elsewhere + "/model.stl").surface.triangle_count() == 320);
    THEN("what has to be written says that the disk is full, and changes nothing") {
        const ProgramRun refused = run({"apply", project, "smooth"});
        CHECK(refused.exit_code == 3);
        CHECK_THAT(refused.err, Contains("disk"));
        std::filesystem::remove(disk.path("full"));
        CHECK(run({"audit", project}).exit_code == 0);
        CHECK(run({"apply", project, "smooth"}).exit_code == 0);
    }
}

SCENARIO("Projects are shared with whom the umask lets in, and with nobody else",
         "[workbench][command-line]") {
    const std::string folder = temporary_folder();
    write_surface(icosphere(10.0, 2), folder + "/ball.stl");
    const auto permissions_with = [&](const std::string& umask, const std::string& name) {
        const std::string project = folder + "/" + name;
        REQUIRE(run_program(program_path(), {"new", project, folder + "/ball.stl", "--units", "mm"},
                            "umask " + umask + ";")
                    .exit_code == 0);
        return std::filesystem::status(project).permissions();
    };
    using enum std::filesystem::perms;
    CHECK(permissions_with("000", "all.vbench") ==
          (owner_read | owner_write | group_read | group_write | others_read | others_write));
    CHECK(permissions_with("007", "group.vbench") ==
          (owner_read | owner_write | group_read | group_write));
    CHECK(permissions_with("077", "own.vbench") == (owner_read | owner_write));
}
