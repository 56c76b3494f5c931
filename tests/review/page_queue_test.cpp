#include "workbench/review/page_queue.h"

#include <algorithm>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/kernel/diagnostic.h"
#include "tests/session/small_operations.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

LogEntry done(EditId id, std::vector<Diagnostic> warnings = {}) {
    LogEntry entry;
    entry.edit.edit = {id, 1};
    entry.edit.operation = "bump";
    entry.status = EditStatus::Done;
    auto result = std::make_shared<ResultRecord>();
    result->warnings = std::move(warnings);
    result->resolved = {{"height", 0.1}};
    entry.result = std::move(result);
    return entry;
}

LogEntry stale(EditId id) {
    LogEntry entry = done(id);
    entry.status = EditStatus::Stale;
    entry.result = nullptr;
    return entry;
}

/// A change of the wall where the radius is 1 mm.
PageEditModel moved(double largest, double usual) {
    PageEditModel model;
    model.before = 0;
    model.after = 1;
    model.wall = WallChange{.largest = largest, .usual = usual, .place = {1, 2, 3}, .radius = 1.0};
    return model;
}

PageModels models_of(std::map<EditId, PageEditModel> edits) {
    return {.geometry = PageGeometry(Bounds{}), .edits = std::move(edits), .neighbours = {}};
}

std::vector<EditId> order(const std::vector<LogEntry>& log, const PageModels& models) {
    std::vector<EditId> edits;
    for (const QueueItem& item : review_queue(log, models, find_test_operation))
        if (std::ranges::count(edits, item.edit) == 0) edits.push_back(item.edit);
    return edits;
}

}  // namespace

SCENARIO("A change that stands out comes before one that is all over the wall", "[review]") {
    const PageModels models = models_of({{1, moved(0.2, 0.1)}, {2, moved(0.2, 0.01)}});
    CHECK(order({done(1), done(2)}, models) == std::vector<EditId>{2, 1});
}

SCENARIO("A lumen that is thinned by a fifth comes before warnings", "[review]") {
    const PageModels models = models_of({{3, moved(0.2, 0.02)}});
    const auto log = {done(1, {plain_text("one")}), done(2, {plain_text("two")}), done(3)};
    CHECK(order(log, models).front() == 3);
}

SCENARIO("What was decided against the program comes before a change of that size", "[review]") {
    PageEditModel tilted;
    tilted.others = {{.what = "a cut was turned", .doubt = 0.18, .place = {4, 5, 6}}};
    const PageModels models = models_of({{1, moved(0.18, 0.01)}, {2, tilted}});
    const auto queue = review_queue({done(1), done(2)}, models, find_test_operation);
    CHECK(queue.front().kind == "choice");
    CHECK(queue.front().place == Vec3(4, 5, 6));
}

SCENARIO("Edits that became stale behind another one do not hide what made them so", "[review]") {
    const PageModels models = models_of({{1, moved(3.0, 0.1)}});
    CHECK(order({done(1), stale(2), stale(3), stale(4), stale(5)}, models) ==
          std::vector<EditId>{2, 1, 3, 4, 5});
}

SCENARIO("The queue as JSON has what a reviewer reads", "[review]") {
    const PageModels models = models_of({{1, moved(0.2, 0.01)}});
    const auto json = queue_json(review_queue({done(1)}, models, find_test_operation));
    REQUIRE_FALSE(json.empty());
    for (const char* key : {"kind", "edit", "title", "why", "score", "place", "radius"})
        CHECK(json[0].contains(key));
}

SCENARIO("A change whose place a person chose comes before one of an operation", "[review]") {
    Operation brush = find_test_operation("bump");
    brush.name = "brush";
    brush.parameters.push_back(
        {.name = "dabs", .type = ParameterType::Records, .meaning = Meaning::Dabs});
    LogEntry painted = done(2);
    painted.edit.operation = "brush";
    painted.edit.given = {{"dabs", Records{}}};
    const auto find = [&](const std::string& name) -> const Operation& {
        return name == "brush" ? brush : find_test_operation(name);
    };
    const PageModels models = models_of({{1, moved(0.2, 0.01)}, {2, moved(0.2, 0.01)}});
    CHECK(review_queue({done(1), painted}, models, find).front().edit == 2);
}
