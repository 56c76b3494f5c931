#include <cstdlib>
#include <filesystem>

#include <catch2/catch.hpp>

#include "geometry/kernel/stopwatch.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "tests/window/random_user.h"
#include "tests/window/window_support.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace fs = std::filesystem;

namespace {

constexpr unsigned kSeeds = 20, kUsualSeeds = 8;
constexpr double kUsualSeconds = 1.0;  ///< for each seed

/// VESSELBENCH_RANDOM_SECONDS=60 makes it a minute for each of 20 seeds.
const char* wished_seconds() {
    return std::getenv("VESSELBENCH_RANDOM_SECONDS");
}

double seconds_per_seed() {
    return wished_seconds() == nullptr ? kUsualSeconds : std::atof(wished_seconds());
}

/// Every project in a folder can be read.
void require_sound_projects(const fs::path& folder) {
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (entry.path().extension() != ".vbench") continue;
        INFO(entry.path());
        CHECK_NOTHROW(Session::open(entry.path(), session_options()).log());
    }
}

}  // namespace

SCENARIO("Random clicks, keys and drops do no harm", "[window][random]") {
    const unsigned seed = GENERATE(range(1U, kSeeds + 1));
    if (seed > kUsualSeeds && wished_seconds() == nullptr) return;
    const fs::path home = temporary_folder();
    live_in(home);
    const std::string tube = tube_file(12), broken = home / "broken.stl";
    write_text(broken, "solid nothing\nfacet normal");
    {
        const auto shell = test_shell();
        if (!shell) return;
        shell->frame();
        if (seed % 4 != 0) open_and_wait(*shell, tube);
        RandomUser user(*shell, seed, {tube, broken, home / "none.stl"});
        const Stopwatch watch;
        while (watch.seconds() < seconds_per_seed()) user.act();
        INFO("seed " << seed << ", latest inputs:\n" << user.latest());
        shell->app().place().document.cancel();
        CHECK(wait_until_idle(*shell));
    }
    require_sound_projects(home);
    require_sound_projects(fs::path(tube).parent_path());
}
