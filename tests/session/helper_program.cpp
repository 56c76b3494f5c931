// The other process of the workbench tests: a worker, an editor to be killed, a holder of a
// project.

#include <cstdio>
#include <iostream>
#include <string>

// The shapes of tests/support warn through Catch2, whose library would bring its own main().
#define CATCH_CONFIG_RUNNER
#include <catch2/catch.hpp>

#include "tests/session/small_operations.h"
#include "workbench/session/session.h"

using namespace vesselbench;

namespace {

SessionOptions options() {
    SessionOptions made;
    made.find = test::find_test_operation;
    return made;
}

/// Edits endlessly; prints the number of edits after each commit.
int edit(const char* project) {
    Session session = Session::open(project, options());
    for (auto made = session.snapshot()->history->entries().size();; ++made) {
        std::printf("%zu\n", made);
        std::fflush(stdout);
        if (made == 0)
            session.apply("make-sphere", {{"levels", std::int64_t{3}}});
        else
            session.apply("bump", {{"at", Vec3(1.0, 2.0, 10.0)}, {"reach", 4.0}, {"height", 1e-3}});
    }
}

/// Opens a project, says so, and waits for a line.
int hold(const char* project) {
    Session session = Session::open(project, options());
    std::puts(session.read_only_reason().empty() ? "writing" : "reading");
    std::fflush(stdout);
    std::string line;
    std::getline(std::cin, line);
    return 0;
}

}  // namespace

int main(int count, char** words) {
    const std::string what = count > 1 ? words[1] : "";
    if (what == "worker") return worker_main(test::find_test_operation);
    if (what == "edit" && count > 2) return edit(words[2]);
    if (what == "hold" && count > 2) return hold(words[2]);
    return 2;
}
