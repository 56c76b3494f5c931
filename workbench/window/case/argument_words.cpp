#include "workbench/window/case/argument_words.h"

#include <cstdint>
#include <variant>
#include <vector>

#include "geometry/kernel/wording.h"
#include "workbench/window/case/readable.h"

namespace vesselbench {

namespace {

/// "dabs" is "34 dabs", or "1 dab".
std::string counted_values(std::size_t count, const std::string& name) {
    const bool plural = name.ends_with('s');
    return plural ? counted(count, name.substr(0, name.size() - 1), name)
                  : name + ": " + counted(count, "value");
}

bool is_place(Meaning meaning) {
    using enum Meaning;
    return meaning == Place || meaning == Tip || meaning == Branch || meaning == Inlet;
}

/// A parameter with its value; `name` is written with blanks.
struct ValueWords {
    const Parameter& parameter;
    std::string name;

    [[nodiscard]] std::string with_unit(const std::string& number) const {
        const std::string unit = readable_unit(parameter.unit);
        return name + " " + number + (unit.empty() ? "" : " " + unit);
    }

    std::string operator()(bool value) const { return name + ": " + (value ? "yes" : "no"); }

    std::string operator()(std::int64_t value) const { return with_unit(std::to_string(value)); }

    std::string operator()(double value) const { return with_unit(readable_number(value)); }

    std::string operator()(const std::string& value) const {
        return name + " " + readable_variant(value);  // presets are called as what they are for
    }

    std::string operator()(const Vec3& value) const { return name + " " + place_text(value); }

    std::string operator()(const std::vector<double>& values) const {
        constexpr std::size_t kMostListed = 6;
        if (is_place(parameter.meaning) && values.size() % 3 == 0)
            return name + ": " + counted(values.size() / 3, "place");
        if (values.size() > kMostListed) return counted_values(values.size(), name);
        std::vector<std::string> numbers;
        for (const double value : values) numbers.push_back(readable_number(value));
        return with_unit(joined(numbers));
    }

    std::string operator()(const Records& records) const {
        return counted_values(records.list().size(), name);
    }
};

}  // namespace

std::string argument_words(const Operation& operation, const Arguments& arguments) {
    std::vector<std::string> words;
    for (const Parameter& parameter : operation.parameters) {
        const auto found = arguments.values().find(parameter.name);
        if (found == arguments.values().end() || found->second == parameter.default_value) continue;
        words.push_back(
            std::visit(ValueWords{parameter, with_blanks(parameter.name)}, found->second));
    }
    return joined(words);
}

}  // namespace vesselbench
