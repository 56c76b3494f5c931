#include "geometry/kernel/amounts.h"

#include <catch2/catch.hpp>

using namespace vesselbench;

SCENARIO("Times and sizes are said in the unit that keeps them short", "[kernel][amounts]") {
    CHECK(duration_text(0.0) == "0.0 s");
    CHECK(duration_text(9.94) == "9.9 s");
    CHECK(duration_text(9.96) == "10 s");
    CHECK(duration_text(119.0) == "119 s");
    CHECK(duration_text(120.0) == "2 min");
    CHECK(duration_text(7200.0) == "2.0 h");
    CHECK(size_text(0) == "0 B");
    CHECK(size_text(1023) == "1023 B");
    CHECK(size_text(1024) == "1 KiB");
    CHECK(size_text(3U << 20U) == "3 MiB");
    CHECK(size_text((3U << 20U) + (1U << 18U)) == "3.2 MiB");
    CHECK(size_text(std::uint64_t{64} << 30U) == "64 GiB");
    CHECK(mebibytes_text(1536.0) == "1.5 GiB");
}
