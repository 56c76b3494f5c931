#include "workbench/case/shell_text.h"

#include <catch2/catch.hpp>

using namespace vesselbench;

SCENARIO("Words of a shell are quoted only where needed", "[workbench][texts]") {
    CHECK(shell_quoted("a/b-c.vbench") == "a/b-c.vbench");
    CHECK(shell_quoted("") == "''");
    CHECK(shell_quoted("a b") == "'a b'");
    CHECK(shell_quoted("$HOME") == "'$HOME'");
}
