#include "workbench/case/former_arguments.h"

#include <catch2/catch.hpp>

#include "workbench/operations/table.h"

using namespace vesselbench;

SCENARIO("An edit stored before a parameter existed runs as it did", "[workbench][case]") {
    for (const std::string name : {"load-surface", "load-neighbour"}) {
        const Operation& load = find_operation(name);
        const Arguments stored = {{"file", std::string("a.stl")}, {"units", std::string("mm")}};
        CHECK(with_former_arguments(load, stored).text("space") == "lps");
        Arguments newer = stored;
        newer.set("space", std::string("ras"));
        CHECK(with_former_arguments(load, newer).text("space") == "ras");
    }
    const Arguments labels = {{"name", std::string("bone")}};
    CHECK_FALSE(with_former_arguments(find_operation("load-neighbour"), labels).has("space"));
    CHECK(with_former_arguments(find_operation("repair"), {}).values().empty());
}
