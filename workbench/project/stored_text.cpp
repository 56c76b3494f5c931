#include "workbench/project/stored_text.h"

#include <cmath>
#include <limits>

#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/printable.h"
#include "workbench/case/json_fields.h"
#include "workbench/case/json_text.h"
#include "workbench/project/compression.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

// Below this size zstd's own frame cancels its saving.
constexpr std::size_t kShortText = 200;

/// JSON has no infinities: they and NaN are written as {"real": "inf"}.
Json number_to_json(double number) {
    if (std::isfinite(number)) return number;
    return {{"real", std::isnan(number) ? "nan" : number > 0.0 ? "inf" : "-inf"}};
}

double number_from_json(const Json& json) {
    if (json.is_number()) return json.get<double>();
    const auto text = JsonFields(json, "a stored number").required<std::string>("real");
    if (text == "nan") return std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    return text == "inf" ? infinity : -infinity;
}

/// File names may consist of any bytes: those that are no UTF-8 are written as {"bytes": "..."}
/// with a character for each byte, U+0000 to U+00FF.
std::string as_characters(const std::string& bytes) {
    std::string text;
    for (const char c : bytes) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte >= 0x80) text += static_cast<char>(0xc0U | (byte >> 6U));
        text += static_cast<char>(byte < 0x80 ? byte : 0x80U | (byte & 0x3fU));
    }
    return text;
}

std::string bytes_from_json(const Json& json) {
    const auto text = JsonFields(json, "a stored text").required<std::string>("bytes");
    std::string bytes;
    for (std::size_t i = 0; i < text.size(); ++i) {
        auto byte = static_cast<unsigned char>(text[i]);
        if (byte > 0xc3) refuse_json(json, "a stored text", "of characters up to U+00FF");
        if (byte >= 0x80)  // the first of two bytes, as in all UTF-8 up to there
            byte = static_cast<unsigned char>((byte << 6U) |
                                              (static_cast<unsigned char>(text[++i]) & 0x3fU));
        bytes += static_cast<char>(byte);
    }
    return bytes;
}

struct ToJson {
    Json operator()(bool flag) const { return flag; }

    Json operator()(std::int64_t number) const { return number; }

    Json operator()(double number) const { return number_to_json(number); }

    Json operator()(const std::string& text) const {
        if (is_utf8(text)) return text;
        return {{"bytes", as_characters(text)}};
    }

    Json operator()(const Vec3& p) const {
        return {{"x", number_to_json(p.x())},
                {"y", number_to_json(p.y())},
                {"z", number_to_json(p.z())}};
    }

    Json operator()(const std::vector<double>& list) const {
        Json json = Json::array();
        for (const double number : list) json.push_back(number_to_json(number));
        return json;
    }

    Json operator()(const Records& records) const {
        Json list = Json::array();
        for (const Arguments& record : records.list()) list.push_back(stored_json(record));
        return {{"records", std::move(list)}};
    }

    static Json stored_json(const Arguments& arguments) {
        Json json = Json::object();
        for (const auto& [name, value] : arguments.values())
            json[name] = std::visit(ToJson{}, value);
        return json;
    }
};

Arguments arguments_from_json(const Json& json);

Records records_from_json(const Json& json) {
    if (!json.is_array()) refuse_json(json, "stored records", "a list");
    std::vector<Arguments> records;
    for (const Json& record : json) records.push_back(arguments_from_json(record));
    return Records(std::move(records));
}

Value value_from_json(const Json& json) {
    if (json.is_boolean()) return json.get<bool>();
    if (json.is_number_integer()) return json_integer<std::int64_t>(json, "a stored number");
    if (json.is_string()) return json.get<std::string>();
    if (json.is_object() && json.contains("bytes")) return bytes_from_json(json);
    if (json.is_object() && json.contains("records")) return records_from_json(json["records"]);
    if (json.is_object() && json.contains("x")) {
        JsonFields point(json, "a stored point");
        const auto number = [&](const char* key) {
            const Json* field = point.child(key);
            return number_from_json(field == nullptr ? Json() : *field);
        };
        return Vec3(number("x"), number("y"), number("z"));
    }
    if (json.is_array()) {
        std::vector<double> list;
        for (const Json& number : json) list.push_back(number_from_json(number));
        return list;
    }
    return number_from_json(json);
}

Arguments arguments_from_json(const Json& json) {
    if (!json.is_object()) refuse_json(json, "the stored arguments", "an object");
    Arguments arguments;
    for (const auto& [name, value] : json.items()) arguments.set(name, value_from_json(value));
    return arguments;
}

}  // namespace

std::string stored_text(const Arguments& arguments) {
    return stored_text(ToJson::stored_json(arguments));
}

std::string stored_text(const Json& report) {
    return text_from_json(report);
}

Arguments arguments_from_stored(const std::string& text) {
    return arguments_from_json(json_from_text(text, "the stored arguments", kLargestStoredJson));
}

Bytes pack_text(const std::string& text) {
    ByteWriter writer;
    const auto bytes = std::as_bytes(std::span(text));
    const bool zstd = text.size() > kShortText;
    writer.put<std::uint8_t>(zstd ? 1 : 0);
    writer.put<std::uint64_t>(text.size());
    if (zstd)
        writer.append(compress(bytes));
    else
        writer.append(bytes);
    return writer.take();
}

std::string unpack_text(std::span<const std::byte> blob) {
    ByteReader reader(blob);
    const auto zstd = reader.get<std::uint8_t>();
    const auto size = reader.get<std::uint64_t>();
    const auto rest = reader.get_bytes(reader.left());
    const Bytes bytes = zstd != 0 ? decompress(rest, size) : Bytes(rest.begin(), rest.end());
    if (bytes.size() != size) throw InvalidInput("a stored text is truncated");
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace vesselbench
