// Draws every screen of the window in both themes, at 1280 x 720 and at 3840 x 2160, through the
// window without a display: FOLDER/<screen>-<theme>-<width>.png, and the words on them:
// FOLDER/labels.json. What is shown is made by clicks.
//   window_screenshots PROGRAM FOLDER [SIZE]... [WORD]...
//   SIZE  WIDTHxHEIGHT or WIDTHxHEIGHT@PERCENT of the text: 1024x700@150, instead of the usual two
//   WORD  only the screens whose names contain a word

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/whole_file.h"
#include "gpu/png.h"
#include "tests/window/random_user.h"
#include "workbench/operations/table.h"
#include "workbench/window/drawing/screen_places.h"
#include "workbench/window/keys/keys.h"
#include "workbench/window/shell/offscreen_shell.h"

namespace vesselbench::screenshots {

namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

struct Size {
    int width, height;
    double scale;    ///< of the display
    int text = 100;  ///< [%]
};

constexpr Size kUsual{1280, 720, 1.0}, kLarge{3840, 2160, 2.0};

/// The size that a word of the command line says; none: it is a part of a screen's name.
std::optional<Size> size_from(const std::string& word) {
    Size size = kUsual;
    char rest = 0;
    const int read =
        std::sscanf(word.c_str(), "%dx%d@%d%c", &size.width, &size.height, &size.text, &rest);
    if (read != 2 && read != 3) return std::nullopt;
    return size;
}

std::string name_of(const Size& size) {
    const std::string text = size.text == 100 ? "" : "-" + std::to_string(size.text);
    return std::to_string(size.width) + text;
}

/// The home of the person who uses the window in the pictures; removed at the end.
class Home {
public:
    Home() : folder_(fs::temp_directory_path() / "ada") {
        fs::remove_all(folder_);
        fs::create_directories(folder_ / "Documents");
        test::live_in(folder_);
        ::setenv("XDG_DOCUMENTS_DIR", (folder_ / "Documents").c_str(), 1);
    }

    ~Home() {
        std::error_code ignored;
        fs::remove_all(folder_, ignored);
    }

    Home(const Home&) = delete;
    Home& operator=(const Home&) = delete;

    [[nodiscard]] fs::path documents() const { return folder_ / "Documents"; }

private:
    fs::path folder_;
};

AppOptions options(const fs::path& program) {
    AppOptions options;
    options.session = {.author = "Ada", .find = find_operation};
    options.session.worker.command = {program.string(), "--worker"};
    return options;
}

class Photographer {
public:
    Photographer(const fs::path& program, fs::path folder, const std::vector<std::string>& words)
        : shell(options(program), kUsual.width, kUsual.height), folder_(std::move(folder)) {
        for (const std::string& word : words)
            if (const auto size = size_from(word))
                sizes_.push_back(*size);
            else
                words_.push_back(word);
        if (sizes_.empty()) sizes_ = {kUsual, kLarge};
        fs::create_directories(folder_);
        shell.frame();
    }

    /// All pictures of what is shown.
    void take(const std::string& screen) {
        const auto asked = [&](const std::string& word) {
            return screen.find(word) != screen.npos;
        };
        if (!words_.empty() && std::ranges::none_of(words_, asked)) return;
        for (const Size& size : sizes_)
            for (const bool dark : {true, false}) take(screen, size, dark);
        show(kUsual, true);
        note_labels(screen);
    }

    /// Which words buttons and rows have on each screen at the usual size, as FOLDER/labels.json:
    /// a check compares those of pictures in documents with the window's.
    void write_labels() const { write_file(folder_ / "labels.json", labels_.dump(1) + "\n"); }

    /// Clicks an item that must be there.
    void click(const std::string& item) {
        if (!shell.click_item(item)) throw AlgorithmFailure("nothing to click: " + item);
        shell.frame();
    }

    void fill(const std::string& item, const std::string& text) {
        if (!shell.fill_item(item, text)) throw AlgorithmFailure("no field: " + item);
    }

    /// Scrolls the list of an item. \param notches upwards
    void scroll(const std::string& item, int notches) {
        const ScreenRect rect = shell.app().ui().items().at(item).rect;
        shell.move_mouse(rect.middle_x(), rect.middle_y());
        for (int i = 0; i < std::abs(notches); ++i) shell.wheel(notches > 0 ? 1.0F : -1.0F);
        shell.frame();
    }

    /// Waits for what the last click started.
    void wait() {
        const Document& document = shell.app().place().document;
        if (!shell.run_until([&] { return !document.activity(); }, 10min) || !shell.settle(2min))
            throw AlgorithmFailure("the window did not come to rest");
    }

    /// Puts the cursor on a point of the model.
    void point_at(const Vec3& point) {
        const ScreenRect view = shell.app().ui().items().at("view.area").rect;
        if (const auto at = on_screen(shell.app().camera(), view).place(point))
            shell.move_mouse(static_cast<float>(at->x()), static_cast<float>(at->y()));
        shell.settle(10s);
    }

    /// Makes a spot of the place of the model that is seen where a point is.
    void click_model(const Vec3& point) {
        const auto& items = shell.app().ui().items();
        ScreenRect room = items.at("view.area").rect;
        room.width = items.at("gallery.cell.0").rect.x - room.x;
        if (const auto at = on_screen(shell.app().camera(), room).place(point))
            shell.click(static_cast<float>(at->x()), static_cast<float>(at->y()));
        shell.settle(10s);
    }

    /// Clicks on a point of the model.
    void click_at(const Vec3& point) {
        const ScreenRect view = shell.app().ui().items().at("view.area").rect;
        if (const auto at = on_screen(shell.app().camera(), view).place(point))
            shell.click(static_cast<float>(at->x()), static_cast<float>(at->y()));
        shell.settle(10s);
    }

    /// The place of the model nearest to the eye at a share of its height.
    Vec3 front_at(double share) {
        const Surface& surface = *shell.app().place().document.current()->surface;
        const Bounds box = bounds(surface);
        const double z = box.min.z() + share * (box.max.z() - box.min.z());
        const auto depth = [&](const Vec3& point) {
            return std::abs(point.z() - z) > 1.0 ? 1e9 : point.dot(shell.app().camera().view);
        };
        return *std::ranges::min_element(surface.points(), {}, depth);
    }

    void rest_mouse() { shell.move_mouse(-1e4F, -1e4F); }

    OffscreenShell shell;

private:
    void show(const Size& size, bool dark) {
        shell.app().place().settings.dark = dark;
        shell.app().place().settings.scale = 0.01 * size.text;
        shell.app().set_display_scale(size.scale);
        shell.resize(size.width, size.height);
        shell.frame();
        shell.settle(1min);
    }

    void take(const std::string& screen, const Size& size, bool dark) {
        show(size, dark);
        const fs::path file =
            folder_ / (screen + (dark ? "-dark-" : "-light-") + name_of(size) + ".png");
        write_file(file, png(shell.picture()));
        std::printf("%s\n", file.c_str());
        std::fflush(stdout);
    }

    void note_labels(const std::string& screen) {
        std::set<std::string> labels;
        for (const auto& [name, item] : shell.app().ui().items())
            if (!item.label.empty()) labels.insert(item.label);
        labels_[screen] = labels;
    }

    fs::path folder_;
    nlohmann::json labels_ = nlohmann::json::object();
    std::vector<Size> sizes_;
    std::vector<std::string> words_;
};

void start_screens(Photographer& p) {
    p.take("start");
    p.shell.press_key(keys::kF1);
    p.take("help");
    p.shell.press_key(keys::kEscape);
    p.click("start.open");
    p.take("file-dialog");
    p.click("file.cancel");
}

void failures(Photographer& p, const Home& home) {
    write_file(home.documents() / "broken.stl", std::string("solid nothing\nfacet normal"));
    p.shell.app().open(home.documents() / "broken.stl");
    p.wait();
    p.take("broken-file");
    p.click("start.dismiss");
}

/// A slid iso-value, not applied.
void extraction(Photographer& p) {
    p.click("rail.source");
    p.click("choose.extract-surface");
    p.click("form.live");
    p.wait();
    const ScreenRect rect = p.shell.app().ui().items().at("extraction.histogram").rect;
    p.shell.click(rect.x + 0.62F * rect.width, rect.middle_y());
    p.wait();
    p.rest_mouse();
    p.take("live-extraction");
    p.click("form.fields");
    p.click("operation.back");
    p.wait();
}

/// Suggestions side by side, and a spot magnified under each; the form's values stay.
void gallery(Photographer& p) {
    p.click("live.gallery");
    p.wait();
    p.rest_mouse();
    p.take("gallery");
    p.click("live.spots");
    for (const double share : {0.25, 0.7}) {
        if (!p.shell.app().place().gallery().picks()) p.click("spot.pick");
        p.click_model(p.front_at(share));
    }
    p.fill("spot.name.1", "fork");
    p.wait();
    p.rest_mouse();
    p.take("spots");
    p.click("live.spots");
}

/// How many triangles a decimation should leave.
void quality(Photographer& p) {
    p.click("rail.remeshing");
    p.click("choose.decimate");
    p.click("form.live");
    p.wait();
    p.rest_mouse();
    p.take("quality");
    p.click("form.fields");
    p.click("operation.back");
}

/// The surface as it comes from the image; the edit is undone afterwards.
void live(Photographer& p) {
    p.click("rail.source");
    p.click("choose.extract-surface");
    p.click("operation.apply");
    p.wait();
    p.click("rail.smoothing");
    p.click("choose.smooth");
    p.click("form.live");
    p.click("live.follow");
    p.click("view.deviation");
    p.wait();
    p.rest_mouse();
    p.scroll("quality.view", -4);
    p.rest_mouse();
    p.take("live-graphs");
    p.scroll("quality.graph.lambda", 20);
    p.click("quality.view");
    p.click("quality.view=Bars by parameter");
    p.rest_mouse();
    p.take("live-bars");
    p.click("quality.view");
    p.click("quality.view=Graphs");
    p.click("view.deviation");
    gallery(p);
    p.click("form.fields");
    p.click("operation.back");
    quality(p);
    p.click("tool.undo");
    p.wait();
}

void new_case(Photographer& p) {
    p.click("case.aneurysm");
    p.shell.frame();
    p.wait();
    p.rest_mouse();
    p.take("image");
    p.click("slices.quarters");
    p.rest_mouse();
    p.take("quarters");
    p.click("slices.quarters");
    for (int i = 0; i < 2; ++i) p.shell.click_item("slice.coronal.area");
    p.rest_mouse();
    p.take("enlarged-slice");
    p.shell.press_key(keys::kEscape);
    extraction(p);
    live(p);
    p.click("tool.prepare");
    p.rest_mouse();
    p.take("prepare-dialog");
    p.click("prepare.run");
    p.shell.run_until([&] { return p.shell.app().place().document.snapshot()->log.size() > 4; },
                      10min);
    p.shell.frame();
    p.rest_mouse();
    p.take("preparing");
    p.wait();
    p.take("prepared");
}

void looks(Photographer& p) {
    p.click("view.edges");
    p.click("view.deviation");
    p.wait();
    p.rest_mouse();
    p.take("deviation-edges");
    p.click("view.edges");
    p.click("view.deviation");
    p.click("view.transparent");
    p.rest_mouse();
    p.take("transparent");
    p.click("view.transparent");
    p.click("tab.messages");
    p.rest_mouse();
    p.take("messages");
    p.click("tab.findings");
    p.wait();
    p.rest_mouse();
    p.take("findings");
    p.click("tab.history");
}

void forms(Photographer& p) {
    p.click("rail.smoothing");
    p.rest_mouse();
    p.take("operations");
    p.click("choose.smooth");
    p.fill("field.iterations", "30");
    p.rest_mouse();
    p.take("form");
    p.click("operation.preview");
    p.wait();
    p.rest_mouse();
    p.take("preview");
    p.fill("field.iterations", "-3");
    p.rest_mouse();
    p.take("wrong-value");
    p.click("operation.back");
    p.click("rail.local-repair");
    p.click("choose.brush-inflate");
    p.point_at(Vec3(0, 0, 20));
    p.take("brush");
}

void places(Photographer& p) {
    p.click("rail.openings");
    p.click("choose.clip-opening");
    p.wait();
    p.rest_mouse();
    p.take("ends");
    p.click("field.tip.pick");
    p.wait();
    p.rest_mouse();
    p.take("picking");
    p.shell.press_key(keys::kEscape);
    p.click("rail.branches");
    p.click("choose.remove-branch");
    p.fill("field.tip", "500,500,500");
    p.click("operation.apply");
    p.wait();
    p.rest_mouse();
    p.take("failure");
    p.click("operation.back");
}

/// A pin and two ends of a distance on the edit that is judged.
void marks(Photographer& p) {
    p.click("review.place_pin");
    p.click_at(p.front_at(0.45));
    p.shell.type("a bump is left");
    p.click("review.place_distance");
    for (const double share : {0.6, 0.75}) p.click_at(p.front_at(share));
    p.shell.type("length of the neck");
    p.shell.press_key(keys::kEnter);
    p.shell.press_key(keys::kEscape);
    p.click("review.draft.pin.0.look");
    p.wait();
}

void review(Photographer& p) {
    p.scroll("rail.smoothing", -30);
    p.click("rail.review");
    p.wait();
    p.click("review.edit.4");
    p.fill("review.name", "A. Kern");
    p.fill("review.role", "radiologist");
    p.click("review.keep_name");
    marks(p);
    p.fill("review.comment", "a hole is left");
    p.rest_mouse();
    p.take("review-marks");
    p.click("review.reject");
    p.wait();
    p.rest_mouse();
    p.take("review");
    p.click("review.blink");
    p.wait();
    p.shell.press_key(keys::kSpace);
    p.rest_mouse();
    p.take("review-blink");
    p.click("review.blink");
    p.wait();
    p.click("review.correct");
    p.wait();
    p.rest_mouse();
    p.take("review-correct");
    p.click("operation.back");
    p.wait();
    p.click("rail.review");
    p.wait();
    p.scroll("review.edit.1", -60);
    p.click("review.whole");
    p.scroll("review.whole", -60);
    p.rest_mouse();
    p.take("review-whole");
    p.scroll("review.whole", 60);
    p.click("review.import");
    p.rest_mouse();
    p.take("review-import");
    p.click("file.cancel");
    p.scroll("rail.review", 30);
}

void history(Photographer& p) {
    for (int i = 0; i < 2; ++i) {
        p.click("tool.undo");
        p.wait();
    }
    p.click("rail.smoothing");
    p.click("choose.smooth");
    p.fill("field.iterations", "2");
    p.click("operation.apply");
    p.wait();
    p.rest_mouse();
    p.take("branches");
    p.click("rail.edit.4");
    p.rest_mouse();
    p.take("edit");
    p.click("operation.remove");
    p.wait();
    p.rest_mouse();
    p.take("pending");
    p.click("tool.export");
    p.rest_mouse();
    p.take("export-dialog");
    p.click("file.cancel");
    p.click("tool.home");
    p.rest_mouse();
    p.take("start-again");
}

int run(const std::vector<std::string>& words) {
    const Home home;
    Photographer photographer(words[0], words[1], {words.begin() + 2, words.end()});
    start_screens(photographer);
    failures(photographer, home);
    new_case(photographer);
    looks(photographer);
    forms(photographer);
    places(photographer);
    review(photographer);
    history(photographer);
    photographer.write_labels();
    return 0;
}

}  // namespace

}  // namespace vesselbench::screenshots

int main(int count, char** words) {
    if (count < 3) {
        std::fprintf(stderr, "usage: window_screenshots PROGRAM FOLDER [SIZE]... [WORD]...\n");
        return 2;
    }
    try {
        return vesselbench::screenshots::run({words + 1, words + count});
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
