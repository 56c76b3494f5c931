// tests/long_tests.txt names tests by their texts: one that is renamed has to be renamed there,
// too.

#include <filesystem>
#include <regex>
#include <set>
#include <sstream>

#include <catch2/catch.hpp>

#include "geometry/kernel/whole_file.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"

using namespace vesselbench::test;

namespace {

/// The tests that ctest knows beside the program.
std::set<std::string> known_tests() {
    const std::string build = std::filesystem::path(program_path()).parent_path();
    const ProgramRun listed = run_program("ctest", {"--test-dir", build, "--show-only"});
    REQUIRE(listed.exit_code == 0);
    static const std::regex line(R"(Test +#\d+: ([^\n]+))");
    std::set<std::string> names;
    for (std::sregex_iterator i(listed.out.begin(), listed.out.end(), line), end; i != end; ++i)
        names.insert((*i)[1]);
    return names;
}

}  // namespace

SCENARIO("Every test of the list of long ones exists", "[workbench][house]") {
    const std::set<std::string> known = known_tests();
    REQUIRE(known.size() > 1000);
    static const std::regex entry(R"((\d+) (turns=\w+ )?(both-cores )?(.+))");
    std::istringstream list(vesselbench::file_content(source_folder() + "/tests/long_tests.txt"));
    std::size_t entries = 0;
    for (std::string line; std::getline(list, line);) {
        if (line.empty() || line.starts_with("#")) continue;
        INFO(line);
        std::smatch parts;
        REQUIRE(std::regex_match(line, parts, entry));
        CHECK(known.contains(parts[4]));
        ++entries;
    }
    CHECK(entries > 30);
}
