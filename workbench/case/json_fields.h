#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/printable.h"
#include "workbench/case/json_text.h"

namespace vesselbench {

/// Values of JSON texts in a type that the program needs, with errors that name the place:
/// "imaging.size[2] must be an integer from 1 to 100, not 3.5".

[[noreturn]] inline void refuse_json(const nlohmann::ordered_json& json, const std::string& place,
                                     const std::string& wanted) {
    throw InvalidInput(place + " must be " + wanted + ", not " +
                       shortened(printable(text_from_json(json))));
}

template <class T>
[[nodiscard]] T json_integer(const nlohmann::ordered_json& json, const std::string& place) {
    constexpr T least = std::numeric_limits<T>::min(), most = std::numeric_limits<T>::max();
    if (json.is_number_unsigned() && std::in_range<T>(json.get<std::uint64_t>()))
        return static_cast<T>(json.get<std::uint64_t>());
    if (json.is_number_integer() && !json.is_number_unsigned() &&
        std::in_range<T>(json.get<std::int64_t>()))
        return static_cast<T>(json.get<std::int64_t>());
    refuse_json(json, place,
                "an integer from " + std::to_string(least) + " to " + std::to_string(most));
}

template <class T>
struct JsonValue;

/// \tparam T bool, an integer type, double, std::string, or a vector or array of these
/// \throw InvalidInput if the value is of another type, out of range or not finite
template <class T>
[[nodiscard]] T json_value(const nlohmann::ordered_json& json, const std::string& place) {
    return JsonValue<T>::from(json, place);
}

template <class T>
struct JsonValue {
    static T from(const nlohmann::ordered_json& json, const std::string& place) {
        if constexpr (std::is_same_v<T, bool>) {
            if (!json.is_boolean()) refuse_json(json, place, "true or false");
            return json.template get<bool>();
        } else if constexpr (std::is_integral_v<T>) {
            return json_integer<T>(json, place);
        } else if constexpr (std::is_floating_point_v<T>) {
            if (!json.is_number() || !std::isfinite(json.template get<T>()))
                refuse_json(json, place, "a number");
            return json.template get<T>();
        } else {
            static_assert(std::is_same_v<T, std::string>);
            if (!json.is_string()) refuse_json(json, place, "a text");
            return json.template get<std::string>();
        }
    }
};

template <class T>
struct JsonValue<std::vector<T>> {
    static std::vector<T> from(const nlohmann::ordered_json& json, const std::string& place) {
        if (!json.is_array()) refuse_json(json, place, "a list");
        std::vector<T> values;
        for (std::size_t i = 0; i < json.size(); ++i)
            values.push_back(json_value<T>(json[i], place + "[" + std::to_string(i) + "]"));
        return values;
    }
};

template <class T, std::size_t N>
struct JsonValue<std::array<T, N>> {
    static std::array<T, N> from(const nlohmann::ordered_json& json, const std::string& place) {
        if (!json.is_array() || json.size() != N)
            refuse_json(json, place, "a list of " + std::to_string(N) + " values");
        std::array<T, N> values{};
        for (std::size_t i = 0; i < N; ++i)
            values[i] = json_value<T>(json[i], place + "[" + std::to_string(i) + "]");
        return values;
    }
};

/// An object that is read field by field and knows its place in the text.
class JsonFields {
public:
    /// \throw InvalidInput unless it is an object
    JsonFields(const nlohmann::ordered_json& json, std::string place)
        : json_(json), place_(std::move(place)) {
        if (!json_.is_object()) refuse_json(json_, place_, "an object");
    }

    /// The field, or a null pointer.
    [[nodiscard]] const nlohmann::ordered_json* child(const char* key) {
        known_.emplace_back(key);
        const auto found = json_.find(key);
        return found == json_.end() ? nullptr : &*found;
    }

    /// \throw InvalidInput if the field is of another type
    template <class T>
    [[nodiscard]] std::optional<T> optional(const char* key) {
        const nlohmann::ordered_json* field = child(key);
        return field == nullptr ? std::nullopt
                                : std::optional(json_value<T>(*field, place_of(key)));
    }

    /// \throw InvalidInput also if there is no such field
    template <class T>
    [[nodiscard]] T required(const char* key) {
        const nlohmann::ordered_json* field = child(key);
        if (field == nullptr) throw InvalidInput(place_ + " has no \"" + key + "\"");
        return json_value<T>(*field, place_of(key));
    }

    /// Replaces the value if the field is there.
    template <class T>
    void read(const char* key, T& value) {
        if (auto found = optional<T>(key)) value = std::move(*found);
    }

    /// \throw InvalidInput that names the first field that was not asked for
    void refuse_unknown_keys() const {
        for (const auto& item : json_.items())
            if (std::find(known_.begin(), known_.end(), item.key()) == known_.end())
                throw InvalidInput(place_ + " has an unknown key '" +
                                   shortened(printable(item.key())) + "'");
    }

    [[nodiscard]] std::string place_of(const char* key) const { return place_ + "." + key; }

private:
    const nlohmann::ordered_json& json_;
    std::string place_;
    std::vector<std::string> known_;
};

}  // namespace vesselbench
