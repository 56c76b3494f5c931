#include "workbench/review/reviewer_name.h"

#include <catch2/catch.hpp>

using namespace vesselbench;

SCENARIO("Names are compared without case, blanks and ways to write them", "[review]") {
    CHECK(compared_name(" a.  KERN ") == compared_name("A. Kern"));
    CHECK(compared_name("A.\u00a0Kern") == compared_name("A. Kern"));         // no-break space
    CHECK(compared_name("M\u00fcller") == compared_name("Mu\u0308ller"));     // composed or not
    CHECK(compared_name("\uff21. Kern") == compared_name("A. Kern"));         // full-width letter
    CHECK(compared_name("A.\u200b Ke\u00adrn") == compared_name("A. Kern"));  // nothing to be seen
    CHECK(compared_name("Stra\u00dfer") == compared_name("STRASSER"));
    CHECK(compared_name("A. Kern") != compared_name("B. Kern"));
    CHECK(compared_name("M\u00fcller") != compared_name("Muller"));
}

SCENARIO("Names that an eye mistakes have one outline", "[review]") {
    CHECK(name_outline("A Kern") == name_outline("A. Kern"));
    CHECK(name_outline("\u0410. \u041aern") == name_outline("A. Kern"));  // Cyrillic
    CHECK(name_outline("M\u00fcller") == name_outline("Muller"));
    CHECK(name_outline("B. R0th") == name_outline("B. Roth"));
    CHECK(name_outline("B. Kern") != name_outline("A. Kern"));
    CHECK(name_outline(" .-").empty());
}

SCENARIO("Characters that show nothing are found", "[review][hostile]") {
    CHECK_FALSE(has_hidden_characters("Dr. \u00c9. M\u00fcller-L\u00fcdenscheidt"));
    CHECK_FALSE(has_hidden_characters("\u7530\u4e2d"));
    CHECK(has_hidden_characters("A. Kern\u200b"));  // zero-width space
    CHECK(has_hidden_characters("A. \u202enreK"));  // writes from right to left
    CHECK(has_hidden_characters("A. Kern\u2028"));  // line separator
    CHECK(has_hidden_characters("A. Kern\ue000"));  // private use
}
