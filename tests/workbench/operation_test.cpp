#include "workbench/case/operation.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "tests/support/operation_examples.h"
#include "tests/support/paths.h"
#include "tests/support/shapes.h"
#include "workbench/case/arguments_json.h"
#include "workbench/case/checked_value.h"
#include "workbench/case/near_names.h"
#include "workbench/operations/table.h"

using namespace vesselbench;
using Catch::Matchers::Contains;
using vesselbench::test::icosphere;

namespace {

Operation example() {
    return {
        .name = "cut-example",
        .usual_step = Step::Openings,
        .allowed = {Step::Openings},
        .summary = "for tests",
        .parameters = {
            {.name = "length",
             .unit = "mm",
             .default_value = Value(5.0),
             .help = "how long",
             .minimum = 0.0,
             .maximum = 20.0,
             .above_minimum = true},
            {.name = "rounds", .type = ParameterType::Integer, .help = "how often", .minimum = 1},
            {.name = "profile",
             .type = ParameterType::Choice,
             .default_value = Value(std::string("keep")),
             .help = "which shape",
             .choices = {"keep", "circle"}},
            {.name = "place", .type = ParameterType::Point, .unit = "mm", .help = "where"},
            {.name = "labels", .type = ParameterType::List, .help = "which labels"},
            {.name = "flip", .type = ParameterType::Flag, .help = "other side"},
            {.name = "name", .type = ParameterType::Text, .help = "whose", .required = true}}};
}

const Parameter& parameter(const Operation& operation, const std::string& name) {
    for (const Parameter& p : operation.parameters)
        if (p.name == name) return p;
    throw UsageError(name);
}

}  // namespace

SCENARIO("Arguments given as text are read in the parameter's own type", "[workbench][operation]") {
    const Operation operation = example();
    CHECK(checked_value(parameter(operation, "length"), "2.5") == Value(2.5));
    CHECK(checked_value(parameter(operation, "length"), "3") == Value(3.0));
    CHECK(checked_value(parameter(operation, "rounds"), "3") == Value(std::int64_t{3}));
    CHECK(checked_value(parameter(operation, "place"), "1,-2.5,3e2") == Value(Vec3(1, -2.5, 300)));
    CHECK(checked_value(parameter(operation, "labels"), "1,2") == Value(std::vector<double>{1, 2}));
    CHECK(checked_value(parameter(operation, "labels"), to_text(Value(std::vector<double>()))) ==
          Value(std::vector<double>()));
    CHECK(checked_value(parameter(operation, "flip"), "true") == Value(true));
    CHECK(checked_value(parameter(operation, "name"), "") == Value(std::string()));
}

SCENARIO("A value that is not allowed is refused with its name and range",
         "[workbench][operation]") {
    const Operation operation = example();
    const auto refused = [&](const std::string& name, const std::string& text,
                             const std::string& why) {
        INFO(name << "=" << text);
        CHECK_THROWS_AS(checked_value(parameter(operation, name), text), UsageError);
        CHECK_THROWS_WITH(
            checked_value(parameter(operation, name), text),
            Contains("'" + name + "'") && Contains("'" + text + "'") && Contains(why));
    };
    refused("length", "0", "above 0 and at most 20 mm");
    refused("length", "20.5", "at most 20 mm");
    refused("length", "nan", "a number");
    refused("length", "inf", "a number");
    refused("length", "2mm", "a number");
    refused("length", "", "a number");
    refused("rounds", "0", "at least 1");
    refused("rounds", "1.5", "an integer");
    refused("profile", "circel", "did you mean 'circle'");
    refused("place", "1,2", "x,y,z");
    refused("place", "1,2,", "x,y,z");
    refused("labels", "1,,2", "numbers separated by commas");
    refused("flip", "yes", "true or false");
}

SCENARIO("Checked arguments have their defaults and no unknown names", "[workbench][operation]") {
    const Operation operation = example();
    WHEN("only the needed one is given") {
        const CheckedArguments checked =
            checked_arguments(operation, {{"name", std::string("left")}});
        THEN("defaults are filled in and what the operation decides stays absent") {
            CHECK(checked->real("length") == 5.0);
            CHECK(checked->text("profile") == "keep");
            CHECK_FALSE(checked->has("place"));
        }
    }
    static_assert(!std::is_constructible_v<CheckedArguments, Arguments>);
    CHECK_THROWS_WITH(checked_arguments(operation, {}),
                      Contains("cut-example") && Contains("'name' is required"));
    CHECK_THROWS_WITH(checked_arguments(operation, {{"lenght", 2.0}}),
                      Contains("did you mean 'length'") && Contains("rounds"));
    CHECK_THROWS_AS(checked_arguments(operation, {{"name", std::string("a")}, {"flip", 1.0}}),
                    UsageError);
    WHEN("arguments are added to others") {
        const Arguments more = given_arguments(operation, {{"length", std::string("2")}});
        THEN("they are checked, and nothing is filled in") {
            CHECK(more == Arguments{{"length", 2.0}});
            CHECK_THROWS_AS(given_arguments(operation, {{"length", 21.0}}), UsageError);
            CHECK_THROWS_AS(given_arguments(operation, {{"width", 1.0}}), UsageError);
        }
    }
}

SCENARIO("Given arguments are checked one by one", "[workbench][operation]") {
    const Operation operation = example();
    GivenArguments given(operation), more(operation);
    given.set("length", std::string("2"));
    CHECK_THROWS_WITH(given.set("length", 21.0), Contains("cut-example: parameter 'length'"));
    CHECK_THROWS_WITH(given.set("width", 1.0), Contains("no parameter 'width'"));
    CHECK_THROWS_WITH(check_complete(given), Contains("'name' is required"));
    more.set("length", 3.0);
    more.set("name", std::string("left"));
    given.set(more);
    CHECK_NOTHROW(check_complete(given));
    CHECK(checked_arguments(given)->real("length") == 3.0);
}

SCENARIO("Arguments survive JSON", "[workbench][operation]") {
    const Operation operation = example();
    const Arguments given = {{"length", 0.1},
                             {"rounds", std::int64_t{7}},
                             {"place", Vec3(1.0 / 3.0, 2, 3)},
                             {"labels", std::vector<double>{3, 1, 2}},
                             {"flip", true},
                             {"name", std::string("a b")}};
    const auto text = to_json(given).dump();
    const Arguments read = arguments_from_json(operation, nlohmann::ordered_json::parse(text));
    CHECK(read == given);
    CHECK_THROWS_AS(arguments_from_json(operation, {{"length", {{"a", 1}}}}), UsageError);
}

SCENARIO("An unknown operation's text names the near ones", "[workbench][operation]") {
    CHECK_THROWS_AS(find_operation("no-such-operation"), UsageError);
    CHECK_THROWS_WITH(find_operation("xyz"), Contains("vesselbench operations"));
    const std::vector<std::string> names = {"clip-opening", "extrude-opening", "smooth"};
    CHECK(near_names("clip-openings", names) == std::vector<std::string>{"clip-opening"});
    CHECK(near_names("clip", names) == std::vector<std::string>{"clip-opening"});
    CHECK(near_names("smoth", names) == std::vector<std::string>{"smooth"});
    CHECK(near_names("tetrahedralize", names).empty());
}

SCENARIO("Every operation of the table is fully described", "[workbench][operation]") {
    std::set<std::string> names;
    Step last = Step::Source;
    for (const Operation& operation : operation_table()) {
        INFO(operation.name);
        CHECK(names.insert(operation.name).second);
        CHECK(operation.usual_step >= last);
        last = operation.usual_step;
        CHECK(std::ranges::count(operation.allowed, operation.usual_step) == 1);
        CHECK_FALSE(operation.summary.empty());
        // The batch form is a function of its own, or the live form from start to outcome.
        CHECK((operation.run == nullptr) != (operation.start == nullptr));
        std::set<std::string> parameters;
        for (const Parameter& p : operation.parameters) {
            INFO(p.name);
            CHECK(parameters.insert(p.name).second);
            CHECK(p.help.size() > 10);
            // A point or a number may be a word, too: stack_axis=all, threshold=local.
            const bool chosen = p.type == ParameterType::Choice;
            CHECK((chosen || p.type == ParameterType::Point || p.type == ParameterType::Real ||
                   p.choices.empty()));
            CHECK_FALSE((chosen && p.choices.empty()));
            if (p.default_value) CHECK_NOTHROW(checked_value(p, to_text(*p.default_value)));
            // What is decided has no default; records have fields, each given or with a default.
            CHECK_FALSE((p.use == Use::Decision && (p.required || p.default_value)));
            CHECK((p.type == ParameterType::Records) == !p.fields.empty());
            for (const Parameter& field : p.fields) {
                INFO(field.name);
                CHECK(field.required != field.default_value.has_value());
                CHECK_FALSE(field.help.empty());
                CHECK(field.type != ParameterType::Records);
            }
        }
    }
}

SCENARIO("Operations declare what others ask of them", "[workbench][operation]") {
    for (const InputKind kind : {InputKind::Surface, InputKind::Image}) {
        const auto loads = [&](const Operation& o) { return o.recipe.loads == kind; };
        REQUIRE(std::ranges::count_if(operation_table(), loads) == 1);
        CHECK_NOTHROW(find_parameter(loading_operation(kind), "file"));
    }
    for (const Operation& operation : operation_table()) {
        INFO(operation.name);
        const OperationSearch& search = operation.search;
        CHECK_FALSE((search.parameters != nullptr && search.smoothing != nullptr));
        CHECK((search.smoothing != nullptr) == !search.filter_parameter.empty());
        if (search.smoothing != nullptr)
            CHECK_NOTHROW(find_parameter(operation, search.filter_parameter));
        if (search.parameters == nullptr) continue;
        for (const bool all : {false, true})
            for (const SearchedParameter& searched : search.parameters(icosphere(5.0, 3), all)) {
                INFO(searched.name);
                CHECK_NOTHROW(find_parameter(operation, searched.name));
                CHECK(std::ranges::is_sorted(searched.values));
            }
        for (const std::string& rival : search.rivals)
            CHECK_NOTHROW(find_parameter(operation, rival));
    }
}

SCENARIO("Nobody but the operations asks for an operation by its name", "[workbench][operation]") {
    namespace fs = std::filesystem;
    const fs::path workbench = fs::path(test::source_folder()) / "workbench";
    std::size_t files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(workbench)) {
        const fs::path& file = entry.path();
        if (file.extension() != ".cpp" && file.extension() != ".h") continue;
        if (file.parent_path().string().starts_with((workbench / "operations").string())) continue;
        ++files;
        std::ifstream stream(file);
        const std::string text((std::istreambuf_iterator<char>(stream)), {});
        INFO(file);
        for (const Operation& operation : operation_table())
            for (const std::string before : {"== ", "!= ", "find_operation("})
                CHECK(text.find(before + '"' + operation.name + '"') == std::string::npos);
    }
    CHECK(files > 50);
}

SCENARIO("Every operation declares an example that its parameters allow", "[workbench]") {
    const test::ExampleGround ground{.radius = 2.0,
                                     .files = {{InputKind::Surface, "surface.stl"},
                                               {InputKind::Image, "image.nii"},
                                               {InputKind::Neighbour, "neighbour.stl"}}};
    for (const Operation& operation : operation_table()) {
        CAPTURE(operation.name);
        Arguments arguments = test::example_arguments(operation, ground);
        const Arguments changes = test::example_changes(operation, ground);
        CHECK_NOTHROW(checked_arguments(operation, arguments));
        const Arguments given = arguments;
        for (const auto& [name, value] : changes.values()) arguments.set(name, value);
        CHECK(arguments != given);
        CHECK_NOTHROW(checked_arguments(operation, arguments));
    }
    THEN("lengths are in radii of the vessel at hand") {
        CHECK(test::example_arguments(find_operation("crop"), ground).real("radius") == 6.0);
    }
}
