#include <cmath>
#include <limits>
#include <random>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "workbench/case/argument_texts.h"
#include "workbench/case/arguments_json.h"
#include "workbench/case/checked_value.h"
#include "workbench/case/parameter_texts.h"
#include "workbench/case/record_values.h"
#include "workbench/project/stored_text.h"

using namespace vesselbench;
using Catch::Matchers::Contains;

namespace {

using Numbers = std::vector<double>;

/// Records of all kinds of fields.
Operation example() {
    using enum ParameterType;
    return {
        .name = "mark",
        .summary = "for tests",
        .parameters = {
            {.name = "marks",
             .type = ParameterType::Records,
             .help = "what is marked",
             .fields =
                 {{.name = "place", .type = Point, .unit = "mm", .help = "where", .required = true},
                  {.name = "reach",
                   .unit = "mm",
                   .default_value = 1.5,
                   .help = "how far",
                   .minimum = 0.0,
                   .above_minimum = true},
                  {.name = "way",
                   .type = Choice,
                   .help = "how",
                   .choices = {"soft", "hard"},
                   .required = true},
                  {.name = "label",
                   .type = Text,
                   .help = "whose",
                   .required = true,
                   .meaning = Meaning::Name}}},
            {.name = "count", .type = Integer, .help = "how many"},
            {.name = "lengths", .type = List, .help = "how long"},
            {.name = "note", .type = Text, .help = "why"}}};
}

const Parameter& marks() {
    static const Operation operation = example();
    return operation.parameters.front();
}

Arguments mark(const Vec3& place, double reach, const std::string& way, const std::string& label) {
    return {{"place", place}, {"reach", reach}, {"way", way}, {"label", label}};
}

Value values_of(std::vector<Arguments> list) {
    return Records(std::move(list));
}

Value any_marks(std::mt19937& random) {
    std::uniform_int_distribution<int> count(0, 4), exponent(-300, 300);
    std::uniform_real_distribution<double> mantissa(-10.0, 10.0);
    const auto number = [&] { return mantissa(random) * std::pow(10.0, exponent(random)); };
    std::vector<Arguments> list;
    for (int left = count(random); left > 0; --left)
        list.push_back(mark({number(), number(), number()}, std::abs(number()) + 1e-300,
                            count(random) < 2 ? "soft" : "hard",
                            "m-" + std::to_string(count(random)) + "_" + std::to_string(left)));
    return values_of(std::move(list));
}

/// The values of all fields, one after the other.
std::string flat_text(const Value& value) {
    std::string text;
    for (const Arguments& record : std::get<Records>(value).list())
        for (const char* field : {"place", "reach", "way", "label"})
            text += (text.empty() ? "" : ",") + to_text(record.values().at(field));
    return text;
}

}  // namespace

SCENARIO("Records keep every bit as text, as JSON, flat and stored", "[workbench][records]") {
    const Operation operation = example();
    std::mt19937 random(7);
    for (int round = 0; round < 200; ++round) {
        const Value value = any_marks(random);
        const Arguments given = {{"marks", value}};
        REQUIRE(checked_value(marks(), value) == value);
        REQUIRE(checked_value(marks(), to_text(value)) == value);
        REQUIRE(checked_value(marks(), flat_text(value)) == value);
        const auto json = nlohmann::ordered_json::parse(to_json(given).dump());
        REQUIRE(arguments_from_json(operation, json) == given);
        REQUIRE(arguments_from_stored(stored_text(given)) == given);
    }
}

SCENARIO("Records are read from JSON and from lists of their values", "[workbench][records]") {
    const Value both =
        values_of({mark({1, 2, 3}, 0.5, "hard", "a"), mark({4, 5, 6}, 7, "soft", "b")});
    CHECK(checked_value(marks(), "1,2,3,0.5,hard,a,4,5,6,7,soft,b") == both);
    CHECK(checked_value(marks(), "1,2,3,0.5,1:a,4,5,6,7,0:b") == both);
    const std::string json = R"([{"label": "a", "way": "hard", "reach": 0.5, "place": [1, 2, 3]},
                                 {"label": "b", "way": "soft", "reach": 7, "place": [4, 5, 6]}])";
    CHECK(checked_value(marks(), json) == both);
    THEN("a field that is not given takes its default") {
        const Value one = values_of({mark({1, 2, 3}, 1.5, "soft", "a")});
        CHECK(checked_value(marks(), R"([{"place": [1, 2, 3], "way": "soft", "label": "a"}])") ==
              one);
    }
    THEN("there may be none") {
        for (const Value& none :
             {Value(Records()), Value(Numbers{}), Value(std::string()), Value(std::string("[]"))})
            CHECK(checked_value(marks(), none) == Value(Records()));
        CHECK(to_text(Value(Records())) == "[]");
    }
    THEN("lists of numbers that a project has stored become records, others stay") {
        Operation flat = example();
        std::vector<Parameter>& fields = flat.parameters.front().fields;
        fields.pop_back();  // a label is no number
        const Arguments stored = {{"marks", Numbers{1, 2, 3, 0.5, 1}}, {"lengths", Numbers{1, 2}}};
        Arguments record = mark({1, 2, 3}, 0.5, "hard", "");
        record.remove("label");
        const Arguments read = with_records(flat, stored);
        CHECK(read == Arguments{{"marks", values_of({record})}, {"lengths", Numbers{1, 2}}});
        CHECK(with_records(flat, read) == read);
        const Arguments odd = {{"marks", Numbers{1, 2}}, {"unknown", true}};
        CHECK(with_records(flat, odd) == odd);
    }
}

SCENARIO("A wrong record is refused with the names of parameter and field",
         "[workbench][records]") {
    const Operation operation = example();
    const auto refused = [&](const Arguments& second, const std::string& why) {
        INFO(why);
        const Value value = values_of({mark({1, 2, 3}, 1, "soft", "a"), second});
        CHECK_THROWS_AS(checked_value(marks(), value), UsageError);
        CHECK_THROWS_WITH(given_arguments(operation, {{"marks", value}}),
                          Contains("mark: parameter 'marks', record 2") && Contains(why));
        const auto json = to_json(Arguments{{"marks", value}});
        CHECK_THROWS_AS(arguments_from_json(operation, nlohmann::ordered_json::parse(json.dump())),
                        UsageError);
    };
    const auto changed = [](const char* field, const Value& value) {
        Arguments record = mark({1, 2, 3}, 1, "soft", "a");
        record.set(field, value);
        return record;
    };
    Arguments without = mark({1, 2, 3}, 1, "soft", "a");
    without.remove("way");
    refused(without, "field 'way' is required: how");
    refused(changed("reach", std::string("far")), "field 'reach' = 'far'");
    refused(changed("reach", std::numeric_limits<double>::quiet_NaN()), "field 'reach' = 'nan'");
    refused(changed("reach", 0.0), "above 0 mm");
    refused(changed("place", Vec3(1, std::numeric_limits<double>::infinity(), 0)), "field 'place'");
    refused(changed("place", Numbers{1, 2}), "three numbers x,y,z");
    refused(changed("way", std::string("sofd")), "did you mean 'soft'");
    refused(changed("way", true), "field 'way'");
    refused(changed("label", std::string("a b")), "field 'label'");
    refused(changed("label", Value(Records())), "field 'label'");
    refused(changed("lable", std::string("b")), "did you mean 'label'");
    for (const Value& other : {Value(true), Value(3.0), Value(Numbers{1, 2, 3, 4}),
                               Value(std::string("1,2")), Value(std::string("[1,2]"))})
        CHECK_THROWS_WITH(checked_value(marks(), other),
                          Contains("'marks'") && Contains(range_text(marks())));
    CHECK_THROWS_WITH(checked_value(marks(), std::string("[{")), Contains("'marks'"));
    CHECK_THROWS_WITH(checked_value(marks(), std::string("[{}, 1]")), Contains("record 2 = 1"));
    CHECK_THROWS_WITH(checked_value(marks(), std::string(R"([{"place": {}}])")),
                      Contains("record 1, field 'place'"));
    THEN("other parameters take no records") {
        for (const char* name : {"count", "lengths", "note"})
            CHECK_THROWS_AS(given_arguments(operation, {{name, Value(Records())}}), UsageError);
    }
}

SCENARIO("Texts about records are short", "[workbench][records]") {
    const Operation operation = example();
    const Arguments given = {
        {"marks", values_of({mark({1, 2, 3}, 1, "soft", "a"), mark({1, 2, 3}, 1, "soft", "a")})}};
    CHECK(argument_summary(operation, given) == "marks=(2 records)");
    CHECK(range_text(marks()) ==
          R"([{"place": ..., "reach": ..., "way": ..., "label": ...}, ...])");
}

SCENARIO("Copies of records share their list", "[workbench][records]") {
    const Records records({mark({1, 2, 3}, 1, "soft", "a")}), copy = records;
    CHECK(&copy.list() == &records.list());
    CHECK(records == Records({mark({1, 2, 3}, 1, "soft", "a")}));
    CHECK_FALSE(records == Records({mark({1, 2, 4}, 1, "soft", "a")}));
    CHECK(Records() == Records(std::vector<Arguments>()));
}
