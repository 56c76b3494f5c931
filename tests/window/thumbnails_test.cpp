#include "workbench/window/features/history/thumbnails.h"

#include <algorithm>
#include <filesystem>
#include <optional>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "tests/gpu/watched_context.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "tests/support/skip.h"
#include "tests/window/window_support.h"
#include "workbench/window/features/history/thumbnail_drawing.h"
#include "workbench/window/features/history/thumbnail_files.h"

using namespace vesselbench;
using namespace vesselbench::test;
using namespace std::chrono_literals;

namespace fs = std::filesystem;

namespace {

int alpha_at(const ClearPicture& picture, int x, int y) {
    return picture.rgba[(static_cast<std::size_t>(y) * picture.width + x) * 4 + 3];
}

/// A gradient with transparent pixels.
ClearPicture small_picture() {
    ClearPicture picture{4, 3, {}};
    for (int i = 0; i < 4 * 3 * 4; ++i) picture.rgba.push_back(static_cast<std::uint8_t>(i * 5));
    return picture;
}

}  // namespace

SCENARIO("A thumbnail shows the model on nothing", "[window][thumbnails]") {
    std::optional<WatchedContext> context;
    try {
        context.emplace();
    } catch (const GpuUnavailable& error) {
        return skip(error.what());
    }
    Renderer renderer;
    ThumbnailDrawing drawing;
    const Surface ball = GENERATE(icosphere(5.0, 3, Vec3(900, 0, 0)), icosphere(5.0, 6));
    const ClearPicture picture = drawing.draw(renderer, thumbnail_arrays(ball));
    REQUIRE(picture.width == kThumbnailWidth);
    REQUIRE(picture.rgba.size() == std::size_t{4} * kThumbnailWidth * kThumbnailHeight);
    CHECK(alpha_at(picture, kThumbnailWidth / 2, kThumbnailHeight / 2) == 255);
    CHECK(alpha_at(picture, 2, 2) == 0);
    int covered = 0;
    for (int y = 0; y < kThumbnailHeight; ++y)
        for (int x = 0; x < kThumbnailWidth; ++x) covered += alpha_at(picture, x, y) > 127;
    const double radius = kThumbnailHeight / 2.0 / 1.08;
    CHECK(covered == Approx(3.14159 * radius * radius).epsilon(0.05));
}

SCENARIO("A project's thumbnail is kept in the cache folder", "[window][thumbnails]") {
    const std::string cache = temporary_folder(), folder = temporary_folder();
    const fs::path project = fs::path(folder) / "a.vbench";
    CHECK_FALSE(saved_thumbnail(cache, project));
    save_thumbnail(cache, project, small_picture());
    const auto saved = saved_thumbnail(cache, project);
    REQUIRE(saved);
    CHECK(saved->width == 4);
    CHECK(saved->rgba == small_picture().rgba);
    CHECK(thumbnail_file(cache, fs::path(folder) / "x" / ".." / "a.vbench") ==
          thumbnail_file(cache, project));
    CHECK(thumbnail_file(cache, fs::path(folder) / "b.vbench") != thumbnail_file(cache, project));
    WHEN("the file is damaged") {
        write_text(thumbnail_file(cache, project).string(), "\x89PNG and no more");
        CHECK_FALSE(saved_thumbnail(cache, project));
    }
    WHEN("the folder cannot be made") {
        write_text(cache + "/file", "");
        save_thumbnail(cache + "/file", project, small_picture());
        CHECK_FALSE(saved_thumbnail(cache + "/file", project));
    }
}

SCENARIO("An opened case leaves its picture for the start screen", "[window][thumbnails]") {
    AppOptions options = app_options();
    const fs::path cache = options.cache = temporary_folder();
    std::unique_ptr<OffscreenShell> shell;
    try {
        shell = std::make_unique<OffscreenShell>(options, 1280, 720);
    } catch (const GpuUnavailable& error) {
        return skip(error.what());
    }
    open_and_wait(*shell, tube_file());
    Workplace& place = shell->app().place();
    const fs::path project = place.document.project();
    const auto first = saved_thumbnail(cache, project);
    REQUIRE(first);
    CHECK(std::ranges::count(first->rgba, 0) > 0);
    WHEN("the model changes") {
        place.document.apply("smooth", {{"iterations", Value(std::int64_t{60})}}, Step::Smoothing);
        REQUIRE(wait_until_idle(*shell));
        REQUIRE(shell->settle(60s));
        THEN("so does its picture") {
            CHECK(saved_thumbnail(cache, project)->rgba != first->rgba);
        }
    }
    WHEN("the case is closed") {
        const Picture plain = [&] {
            fs::rename(cache / "thumbnails", cache / "away");
            place.close();
            shell->settle(10s);
            return shell->picture();
        }();
        fs::rename(cache / "away", cache / "thumbnails");
        place.open(project);
        REQUIRE(wait_until_idle(*shell));
        REQUIRE(shell->settle(60s));
        place.close();
        REQUIRE(shell->settle(10s));
        THEN("the start screen shows it") {
            CHECK(shell->picture().rgb != plain.rgb);
        }
    }
}
