#include "workbench/window/case/opening.h"

#include <chrono>
#include <filesystem>
#include <thread>

#include <catch2/catch.hpp>

#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "tests/window/window_support.h"
#include "workbench/session/stored_texts.h"
#include "workbench/window/case/document.h"

using namespace vesselbench;
using namespace vesselbench::test;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;

namespace fs = std::filesystem;

namespace {

/// A folder with a tube and this recipe for every purpose.
fs::path case_with_recipe(const std::string& recipe) {
    const fs::path folder = fs::path(temporary_folder()) / "tube";
    fs::create_directory(folder);
    fs::copy_file(tube_file(), folder / "tube.stl");
    write_text(
        folder / "case.json",
        R"({"name": "tube", "surface": "tube.stl", "units": "mm", "recipe": )" + recipe + "}");
    return folder;
}

void wait_for(Document& document) {
    for (const auto end = std::chrono::steady_clock::now() + 60s;
         document.busy() && std::chrono::steady_clock::now() < end;) {
        document.poll();
        std::this_thread::sleep_for(5ms);
    }
    REQUIRE_FALSE(document.busy());
}

void open_and_wait(Document& document, const fs::path& path) {
    document.open({.path = path});
    wait_for(document);
}

std::vector<std::string> operations(const Recipe& recipe) {
    std::vector<std::string> names;
    for (const RecipeEntry& entry : recipe) names.push_back(entry.given.operation().name);
    return names;
}

}  // namespace

SCENARIO("A reopened project still has the recipe of its case", "[window][opening]") {
    const std::vector<std::string> own = {"decimate", "smooth"};
    const fs::path folder =
        case_with_recipe(R"([{"operation": "decimate"}, {"operation": "smooth"}])");
    Document document({.session = session_options(), .documents = temporary_folder()});
    open_and_wait(document, folder);
    REQUIRE(document.is_open());
    CHECK(operations(document.recipe("cfd")) == own);
    const fs::path project = document.project();
    document.close();
    open_and_wait(document, project);
    REQUIRE(document.is_open());
    CHECK(operations(document.recipe("cfd")) == own);
    CHECK(operations(document.recipe("rp")) == own);
    WHEN("what the project keeps cannot be used any more") {
        document.close();
        store_text(project, StoredText::Recipes, R"([{"operation": "vanished"}])");
        open_and_wait(document, project);
        REQUIRE(document.is_open());
        CHECK(operations(document.recipe("cfd")).size() > 2);
        CHECK_THAT(document.messages().back().text, Contains("vanished"));
    }
}

SCENARIO("A reopened project finds the files of its recipe", "[window][opening]") {
    const fs::path folder = case_with_recipe(
        R"([{"operation": "load-neighbour", "arguments": {"name": "bone", "file": "bone.stl"}}])");
    fs::copy_file(tube_file(), folder / "bone.stl");
    Document document({.session = session_options(), .documents = temporary_folder()});
    open_and_wait(document, folder);
    REQUIRE(document.is_open());
    const fs::path project = document.project();
    document.close();
    wait_for(document);  // a session that ends has its project open
    const auto neighbour = [&] {
        REQUIRE(document.is_open());
        return fs::path(document.recipe("cfd").at(0).given->text("file"));
    };
    THEN("also where both were moved to") {
        const fs::path elsewhere = temporary_folder();
        fs::rename(folder, elsewhere / "tube");
        fs::rename(project, elsewhere / "moved.vbench");
        open_and_wait(document, elsewhere / "moved.vbench");
        CHECK(fs::equivalent(neighbour(), elsewhere / "tube" / "bone.stl"));
    }
    THEN("but none outside its folder") {
        store_text(project, StoredText::CaseFolder, "../" + folder.filename().string());
        open_and_wait(document, project);
        REQUIRE(document.is_open());
        CHECK_THAT(document.messages().back().text, Contains("outside the folder"));
    }
}

SCENARIO("A file that was opened before opens its project", "[window][opening]") {
    const fs::path file = tube_file();
    const auto options = [&] {
        return DocumentOptions{.session = session_options(), .documents = temporary_folder()};
    };
    fs::path first;
    {
        Document document(options());
        open_and_wait(document, file);
        CHECK_FALSE(document.made_before());
        first = document.project();
        document.apply("repair", {}, Step::Source);
        while (document.busy()) document.poll();
    }
    Document document(options());
    open_and_wait(document, file);
    REQUIRE(document.made_before());
    CHECK(fs::equivalent(document.project(), first));
    CHECK(document.snapshot()->log.size() == 2);
    WHEN("the user wants to begin anew") {
        document.begin_anew();
        while (document.busy()) document.poll();
        THEN("a new project is made, and the earlier one stays") {
            CHECK_FALSE(document.made_before());
            CHECK(document.project().filename() == "tube-2.vbench");
            CHECK(document.snapshot()->log.size() == 1);
            CHECK(fs::exists(first));
        }
    }
    WHEN("the file is opened while its project is open") {
        const auto snapshot = document.snapshot();
        document.keep_made_before();
        open_and_wait(document, file);
        THEN("that project stays, and a new one is offered") {
            CHECK(fs::equivalent(document.project(), first));
            CHECK(document.snapshot()->history == snapshot->history);
            CHECK_THAT(document.messages().back().text, Contains("is open already, as"));
            CHECK(document.made_before());
        }
    }
    WHEN("another file of this name is opened") {
        document.close();
        while (document.busy()) document.poll();
        fs::copy_file(tube_file(36), file, fs::copy_options::overwrite_existing);
        open_and_wait(document, file);
        THEN("its project is another one") {
            CHECK_FALSE(document.made_before());
            CHECK(document.project().filename() == "tube-2.vbench");
        }
    }
    WHEN("the project is damaged") {
        document.close();
        while (document.busy()) document.poll();
        write_text(first, "no project");
        open_and_wait(document, file);
        CHECK(document.project().filename() == "tube-2.vbench");
    }
}

SCENARIO("A case with a wrong recipe is not opened", "[window][opening]") {
    Document document({.session = session_options(), .documents = temporary_folder()});
    const fs::path folder = case_with_recipe(R"([{"operation": "vanished"}])");
    open_and_wait(document, folder);
    CHECK_FALSE(document.is_open());
    REQUIRE(document.failure());
    CHECK_THAT(document.failure()->text, Contains("vanished"));
    CHECK(names_in(folder.parent_path()) == std::vector<std::string>{"tube"});
}

SCENARIO("An opening that is cancelled at once has no result", "[window][opening]") {
    const fs::path missing = fs::path(temporary_folder()) / "none.stl";
    for (int i = 0; i < 100; ++i) {  // before or after its thread has begun
        Document document({.session = session_options(), .documents = temporary_folder()});
        document.open({.path = missing});
        document.cancel();
        while (document.busy()) document.poll();
        CHECK_FALSE(document.is_open());
        CHECK((document.failure() || document.messages().back().text == "Cancelled"));
    }
}

SCENARIO("A newer opening replaces an older one", "[window][opening]") {
    const fs::path folder = temporary_folder();
    for (const char* name : {"a.stl", "b.stl", "c.stl"}) fs::copy_file(tube_file(), folder / name);
    Document document({.session = session_options(), .documents = temporary_folder()});
    document.open({.path = folder / "a.stl"});
    document.open({.path = folder / "b.stl"});
    std::this_thread::sleep_for(20ms);  // it runs by now
    open_and_wait(document, folder / "c.stl");
    REQUIRE(document.is_open());
    CHECK(document.project().stem() == "c");
    CHECK(document.opened() == 1);
    THEN("nothing is heard of the others") {
        for (const Message& message : document.messages())
            CHECK_THAT(message.text, !Contains("a.vbench") && !Contains("b.vbench"));
    }
}
