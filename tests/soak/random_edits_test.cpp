#include "tests/soak/random_edits.h"

#include <catch2/catch.hpp>

#include "tests/support/paths.h"
#include "tests/support/shapes.h"
#include "workbench/case/history.h"

using namespace vesselbench;

SCENARIO("Random valid edits replay to the same bits, and their arguments lose nothing",
         "[soak][random]") {
    const soak::SmallFiles files(test::temporary_folder() + "/files");
    const std::uint64_t seed = GENERATE(1, 2, 3, 4);
    INFO("seed " << seed);
    soak::RandomEditor editor(seed, files);
    const SessionOptions options = soak::table_options({test::program_path(), "--worker"});
    Session session = Session::unsaved(options);
    for (int action = 0; action < 30; ++action) {
        const std::string what = editor.act(session);
        UNSCOPED_INFO(what);
    }
    for (const std::string& text : soak::unreproduced(session, files, options)) FAIL_CHECK(text);
    CHECK(session.snapshot()->history->edits().size() >= 3);
}
