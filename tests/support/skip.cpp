#include "tests/support/skip.h"

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <set>

#include <catch2/catch.hpp>

namespace vesselbench::test {

namespace {

std::set<std::string>& skipped() {
    static std::set<std::string> lines;
    return lines;
}

}  // namespace

void skip(const std::string& reason) {
    std::string line = Catch::getResultCapture().getCurrentTestName() + ": " + reason;
    if (!skipped().insert(line).second) return;
    std::cout << "skipped: " << reason << std::endl;
    if (const char* file = std::getenv("VESSELBENCH_SKIPS"))
        std::ofstream(file, std::ios::app) << line + "\n";
}

bool anything_skipped() {
    return !skipped().empty();
}

}  // namespace vesselbench::test
