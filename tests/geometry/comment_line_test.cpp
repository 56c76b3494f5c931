#include "geometry/formats/comment_line.h"

#include <catch2/catch.hpp>

#include "geometry/kernel/printable.h"

using namespace vesselbench;

SCENARIO("A text is safe in a file's comment", "[geometry][comment-line]") {
    CHECK(comment_line("project a-1, accepted by A. Kern (2)") ==
          "project a-1, accepted by A. Kern (2)");
    CHECK(comment_line("M\u00FCller") == "M\u00FCller");
    CHECK(comment_line("a\nv 1 2 3") == "a_v 1 2 3");
    CHECK(comment_line("UNITS=m */ #codeStream <x> \"q\"") == "UNITS_m __ _codeStream _x_ _q_");
    for (const char* hostile : {"\x1b[31m", "\xe4", "\xe2\x80\xae", "\r", "\x7f"}) {
        const std::string line = comment_line(hostile);
        CHECK(is_utf8(line));
        CHECK(line == printable(line));
        CHECK(line.find_first_of("\n\t\r=#*/\\<>\"") == std::string::npos);
    }
    THEN("it is cut off at a character") {
        CHECK(comment_line("abc\u00FC", 4) == "abc");
        CHECK(comment_line("abc\u00FC", 5) == "abc\u00FC");
        CHECK(comment_line(std::string(1000, 'x')).size() == 200);
    }
}
