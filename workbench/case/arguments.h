#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "geometry/kernel/vec3.h"

namespace vesselbench {

class Arguments;

/// A list of records, each of named values: the dabs of a stroke. An immutable value that copies
/// share, so that edits, logs and snapshots may hold long ones.
class Records {
public:
    Records() = default;
    explicit Records(std::vector<Arguments> list);

    [[nodiscard]] const std::vector<Arguments>& list() const;

    bool operator==(const Records& other) const;

private:
    std::shared_ptr<const std::vector<Arguments>> list_;  ///< null: empty
};

/// One argument's value. Its text form is the command line's: true|false, 12, 0.5, text, x,y,z,
/// 1,2,3, and JSON for records: [{"place":[1.0,2.0,3.0],"way":"wall"}].
using Value =
    std::variant<bool, std::int64_t, double, std::string, Vec3, std::vector<double>, Records>;

/// Named values of an operation, by parameter name. An absent one takes its default or is decided
/// by the operation.
class Arguments {
public:
    Arguments() = default;

    Arguments(std::initializer_list<std::pair<const std::string, Value>> values)
        : values_(values) {}

    [[nodiscard]] bool has(const std::string& name) const { return values_.contains(name); }

    void set(const std::string& name, Value value) { values_[name] = std::move(value); }

    void remove(const std::string& name) { values_.erase(name); }

    /// \throw UsageError if the argument is missing or of another type (an integer is accepted as a
    /// real number)
    [[nodiscard]] bool flag(const std::string& name) const;
    [[nodiscard]] std::int64_t integer(const std::string& name) const;
    [[nodiscard]] double real(const std::string& name) const;
    [[nodiscard]] const std::string& text(const std::string& name) const;
    [[nodiscard]] Vec3 point(const std::string& name) const;
    [[nodiscard]] const std::vector<double>& list(const std::string& name) const;
    [[nodiscard]] const Records& records(const std::string& name) const;

    /// As above, but empty when absent (the operation decides by itself).
    [[nodiscard]] std::optional<double> optional_real(const std::string& name) const;
    [[nodiscard]] std::optional<Vec3> optional_point(const std::string& name) const;
    [[nodiscard]] std::optional<std::string> optional_text(const std::string& name) const;

    /// The argument is given, and is this text.
    [[nodiscard]] bool is_word(const std::string& name, std::string_view word) const;

    [[nodiscard]] const std::map<std::string, Value>& values() const { return values_; }

    bool operator==(const Arguments&) const = default;

private:
    std::map<std::string, Value> values_;
};

/// The command line's text of a value, with enough digits to read it back exactly.
[[nodiscard]] std::string to_text(const Value& value);

/// JSON form of a value: true|false, number, text, [x,y,z], [1,2,3], [{"name": value, ...}, ...].
[[nodiscard]] nlohmann::ordered_json to_json(const Value& value);

/// The value that a JSON form gives, of no parameter's type: points are lists of numbers.
/// \param called the value in error texts: "parameter 'planes'"
/// \throw UsageError if it is no value's form
[[nodiscard]] Value value_from_json(const std::string& called, const nlohmann::ordered_json& json);

/// JSON object of the arguments, by parameter name.
[[nodiscard]] nlohmann::ordered_json to_json(const Arguments& arguments);

}  // namespace vesselbench
