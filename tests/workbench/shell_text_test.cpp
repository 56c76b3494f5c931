#include "workbench/case/shell_text.h"

#include <catch2/catch.hpp>

using namespace vesselbench;

SCENARIO("Words of a shell are quoted only where needed", "[workbench][texts]") {
    CHECK(shell_quoted("a/b-c.vbench") == "a/b-c.vbench");
    CHECK(shell_quoted("") == "''");
    CHECK(shell_quoted("a b") == "'a b'");
    CHECK(shell_quoted("$HOME") == "'$HOME'");
}

SCENARIO("Proposed commands name the project where it is", "[workbench][texts]") {
    CHECK(with_project("lost\nvesselbench change project.vbench 4 edge=0.3, then --resume",
                       "my case/project.vbench") ==
          "lost\nvesselbench change 'my case/project.vbench' 4 edge=0.3, then --resume");
    CHECK(with_project("vesselbench remove project.vbench 4; vesselbench apply project.vbench x",
                       "c/project.vbench") ==
          "vesselbench remove c/project.vbench 4; vesselbench apply c/project.vbench x");
    CHECK(with_project("there is no project.vbench in it", "c/p") ==
          "there is no project.vbench in it");
}
