#include "geometry/kernel/pending_files.h"

#include <csignal>

#include <catch2/catch.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/whole_file.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"

using namespace vesselbench;

namespace fs = std::filesystem;

SCENARIO("Files appear only when all of them are complete", "[workbench][pending-files]") {
    const fs::path folder = test::temporary_folder();
    GIVEN("two files and a folder that are written, but not committed") {
        PendingFiles files;
        files.add_text(folder / "a.txt", "one");
        files.add_text(folder / "b.txt", "two");
        fs::create_directory(files.add(folder / "case"));
        THEN("nothing has its own name yet") {
            CHECK_FALSE(fs::exists(folder / "a.txt"));
            CHECK_FALSE(fs::exists(folder / "case"));
        }
        WHEN("committed") {
            files.commit();
            THEN("they are there and nothing else is") {
                CHECK(test::names_in(folder.string()) ==
                      std::vector<std::string>{"a.txt", "b.txt", "case"});
                CHECK(file_content(folder / "a.txt") == "one");
            }
        }
    }
    WHEN("something goes wrong before") {
        {
            PendingFiles files;
            files.add_text(folder / "a.txt", "one");
        }
        THEN("the folder is as it was") {
            CHECK(test::names_in(folder.string()).empty());
        }
    }
    WHEN("files of these names are there already") {
        fs::create_directories(folder / "case" / "old");
        test::write_text((folder / "a.txt").string(), "old");
        PendingFiles files;
        files.add_text(folder / "a.txt", "new");
        fs::create_directory(files.add(folder / "case"));
        files.commit();
        THEN("they are replaced as a whole") {
            CHECK(file_content(folder / "a.txt") == "new");
            CHECK(test::names_in((folder / "case").string()).empty());
        }
    }
}

SCENARIO("Marks say whether files are complete", "[workbench][pending-files]") {
    const fs::path folder = test::temporary_folder();
    const auto write = [&](const std::string& text, PendingFiles& files) {
        files.add_mark(folder / "list.html", text);
        files.add_mark(folder / "list.json", text);
        for (const char* name : {"a.txt", "b.txt", "c.txt"}) files.add_text(folder / name, text);
    };
    {
        PendingFiles files;
        write("old", files);
        files.commit();
        CHECK(test::names_in(folder.string()) ==
              std::vector<std::string>{"a.txt", "b.txt", "c.txt", "list.html", "list.json"});
    }
    PendingFiles files;
    write("new", files);
    WHEN("they are replaced") {
        files.commit();
        for (const std::string& name : test::names_in(folder.string()))
            CHECK(file_content(folder / name) == "new");
    }
    WHEN("the process ends between two names") {
        // What no file can replace ends the commit where a kill would.
        fs::remove(folder / "b.txt");
        fs::create_directories(folder / "b.txt" / "full");
        CHECK_THROWS_AS(files.commit(), IoError);
        CHECK(file_content(folder / "a.txt") == "new");
        CHECK(file_content(folder / "c.txt") == "old");
        CHECK_FALSE(fs::exists(folder / "list.html"));
        CHECK_FALSE(fs::exists(folder / "list.json"));
    }
    WHEN("a mark cannot be removed") {
        fs::remove(folder / "list.json");
        fs::create_directories(folder / "list.json" / "full");
        CHECK_THROWS_AS(files.commit(), IoError);
        THEN("nothing has been replaced") {
            CHECK(file_content(folder / "a.txt") == "old");
            CHECK(file_content(folder / "list.html") == "old");
            CHECK(fs::exists(folder / "list.json" / "full"));
        }
    }
}

SCENARIO("A killed commit leaves no mark beside a mixture", "[workbench][pending-files]") {
    const fs::path folder = test::temporary_folder(), mark = folder / "list.json";
    constexpr int kFiles = 20;
    const auto write = [&](const std::string& text) {
        PendingFiles files;
        files.add_mark(mark, text);
        for (int i = 0; i < kFiles; ++i) files.add_text(folder / std::to_string(i), text);
        files.commit();
    };
    for (int round = 0; round < 10; ++round) {
        write("old");
        const pid_t child = fork();
        if (child == 0) {
            try {
                write("new");
            } catch (const std::exception&) {
                _exit(1);
            }
            _exit(0);
        }
        bool ended = false;
        while (!ended && fs::exists(mark)) ended = waitpid(child, nullptr, WNOHANG) == child;
        if (!ended) {
            usleep(static_cast<useconds_t>(30 * round));  // a kill in another place of the commit
            ::kill(child, SIGKILL);
            waitpid(child, nullptr, 0);
        }
        if (!fs::exists(mark)) continue;
        for (int i = 0; i < kFiles; ++i)
            CHECK(file_content(folder / std::to_string(i)) == file_content(mark));
    }
}

SCENARIO("Temporary folders cannot be foreseen or read by others", "[workbench][pending-files]") {
    const fs::path folder = test::temporary_folder();
    PendingFiles first, second;
    const fs::path a = first.add(folder / "a"), b = second.add(folder / "a");
    CHECK(a.parent_path() != b.parent_path());
    CHECK(first.add(folder / "b").parent_path() == a.parent_path());
    CHECK((fs::status(a.parent_path()).permissions() &
           (fs::perms::group_all | fs::perms::others_all)) == fs::perms::none);
}

SCENARIO("What killed processes left behind is removed", "[workbench][pending-files]") {
    const fs::path folder = test::temporary_folder();
    const pid_t child = fork();
    if (child == 0) {
        PendingFiles files;
        files.add_text(folder / "a.txt", "half");
        raise(SIGKILL);
    }
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    REQUIRE(test::names_in(folder.string()).size() == 1);
    fs::create_directory(folder / ".partial-notes");  // somebody's own
    PendingFiles alive;
    alive.add_text(folder / "b.txt", "still being written");
    PendingFiles files;
    files.add_text(folder / "c.txt", "whole");
    files.commit();
    alive.commit();
    CHECK(test::names_in(folder.string()) ==
          std::vector<std::string>{".partial-notes", "b.txt", "c.txt"});
}

SCENARIO("Folders that cannot be used are refused by name", "[workbench][pending-files]") {
    const fs::path folder = test::temporary_folder();
    test::write_text((folder / "file").string(), "x");
    CHECK_THROWS_AS(make_folder(folder / "file"), IoError);
    CHECK_THROWS_WITH(make_folder(folder / "file" / "inner"), Catch::Contains("inner"));
    CHECK_THROWS_AS(file_content(folder / "missing"), IoError);
    PendingFiles files;
    CHECK_THROWS_AS(files.add_text(folder / "no-such-folder" / "a.txt", "x"), IoError);
}
