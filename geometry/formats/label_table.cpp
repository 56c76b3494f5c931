#include "geometry/formats/label_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include <nlohmann/json.hpp>

#include "geometry/formats/image_bytes.h"
#include "geometry/formats/segment_name.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/label_table_places.h"
#include "geometry/kernel/whole_file.h"
#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using Colour = std::array<std::uint8_t, 3>;
using Words = std::vector<std::string>;

/// A larger file is no table of labels.
constexpr std::uintmax_t kLargestTable = std::uintmax_t{4} << 20;

std::optional<int> label_in(std::string_view text) {
    const auto number = number_in(text);
    if (!number || *number != std::floor(*number) || *number < 0.0 || *number > 1e6)
        return std::nullopt;
    return static_cast<int>(*number);
}

/// Three numbers from 0 to 255 among the words.
std::optional<Colour> colour_in(const Words& words, std::size_t first) {
    if (words.size() < first + 3) return std::nullopt;
    Colour colour{};
    for (std::size_t c = 0; c < 3; ++c) {
        const auto number = label_in(words[first + c]);
        if (!number || *number > 255) return std::nullopt;
        colour[c] = static_cast<std::uint8_t>(*number);
    }
    return colour;
}

/// "#ff0000"
std::optional<Colour> hexadecimal_colour(std::string_view text) {
    if (text.size() != 7 || text.front() != '#') return std::nullopt;
    Colour colour{};
    for (std::size_t c = 0; c < 3; ++c) {
        const char* const first = text.data() + 1 + 2 * c;
        const auto [end, error] = std::from_chars(first, first + 2, colour[c], 16);
        if (error != std::errc() || end != first + 2) return std::nullopt;
    }
    return colour;
}

std::vector<std::string_view> lines_of(std::string_view text) {
    std::vector<std::string_view> lines;
    while (!text.empty()) {
        const auto end = std::min(text.find('\n'), text.size());
        const auto line = trimmed(text.substr(0, end));
        if (!line.empty() && !line.starts_with('#')) lines.push_back(line);
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return lines;
}

/// The text between the first and the last quotation mark.
std::optional<std::string_view> quoted(std::string_view line) {
    const auto first = line.find('"'), last = line.rfind('"');
    if (first == std::string_view::npos || last <= first) return std::nullopt;
    return line.substr(first + 1, last - first - 1);
}

/// 1  255 0 0  1 1 1  "aorta"
std::optional<Segment> snap_line(std::string_view line) {
    const auto name = quoted(line);
    const Words words = words_of(line.substr(0, line.find('"')));
    const auto label = words.size() == 7 ? label_in(words[0]) : std::nullopt;
    if (!name || !label) return std::nullopt;
    return Segment{*label, segment_name(*name), colour_in(words, 1)};
}

/// 1  aorta  255 0 0 255; a name may hold blanks.
std::optional<Segment> colour_table_line(std::string_view line) {
    const Words words = words_of(line);
    const auto label = words.size() >= 6 ? label_in(words[0]) : std::nullopt;
    const auto colour = words.size() >= 6 ? colour_in(words, words.size() - 4) : std::nullopt;
    if (!label || !colour) return std::nullopt;
    const Words name(words.begin() + 1, words.end() - 4);
    return Segment{*label, segment_name(joined(name, " ")), colour};
}

/// A table of which every line has the form.
std::vector<Segment> table_of(const std::vector<std::string_view>& lines,
                              std::optional<Segment> (*read)(std::string_view)) {
    std::vector<Segment> segments;
    for (const std::string_view line : lines) {
        auto segment = read(line);
        if (!segment) return {};
        segments.push_back(std::move(*segment));
    }
    return segments;
}

Words cells_of(std::string_view line, char separator) {
    Words cells;
    while (true) {
        const auto end = std::min(line.find(separator), line.size());
        std::string_view cell = trimmed(line.substr(0, end));
        if (cell.size() > 1 && cell.front() == '"' && cell.back() == '"')
            cell = cell.substr(1, cell.size() - 2);
        cells.emplace_back(cell);
        if (end == line.size()) return cells;
        line.remove_prefix(end + 1);
    }
}

/// Columns index (or label, value, id), name and perhaps color.
std::vector<Segment> columns_table(const std::vector<std::string_view>& lines) {
    if (lines.empty()) return {};
    const char separator = lines[0].find('\t') != std::string_view::npos ? '\t' : ',';
    Words head = cells_of(lines[0], separator);
    for (std::string& cell : head) cell = lower_case(cell);
    const auto column = [&](const Words& names) {
        const auto at = std::ranges::find_first_of(head, names);
        return static_cast<std::size_t>(at - head.begin());
    };
    const std::size_t label = column({"index", "label", "value", "id"});
    const std::size_t name = column({"name"}), colour = column({"color", "colour"});
    if (std::max(label, name) >= head.size()) return {};
    std::vector<Segment> segments;
    for (std::size_t l = 1; l < lines.size(); ++l) {
        const Words cells = cells_of(lines[l], separator);
        const auto number = cells.size() == head.size() ? label_in(cells[label]) : std::nullopt;
        if (!number) return {};
        segments.push_back(
            {*number, segment_name(cells[name]),
             colour < head.size() ? hexadecimal_colour(cells[colour]) : std::nullopt});
    }
    return segments;
}

std::optional<int> label_of(const Json& json) {
    if (json.is_string()) return label_in(json.get<std::string>());
    if (json.is_number_integer()) return label_in(json.dump());
    return std::nullopt;
}

/// {"1": "aorta"} or {"aorta": 1}
std::vector<Segment> pairs_in(const Json& json) {
    std::vector<Segment> segments;
    for (const auto& [key, value] : json.items()) {
        const bool by_label = value.is_string() && label_in(key).has_value();
        const auto label = by_label ? label_in(key) : label_of(value);
        if (!label) return {};
        segments.push_back({*label, segment_name(by_label ? value.get<std::string>() : key)});
    }
    return segments;
}

/// [{"label": 1, "name": "aorta"}]
std::vector<Segment> records_in(const Json& json) {
    std::vector<Segment> segments;
    for (const Json& record : json) {
        std::optional<int> label;
        for (const char* key : {"label", "value", "id", "index"})
            if (!label && record.is_object() && record.contains(key)) label = label_of(record[key]);
        if (!label || !record.contains("name") || !record["name"].is_string()) return {};
        segments.push_back({*label, segment_name(record["name"].get<std::string>())});
    }
    return segments;
}

std::vector<Segment> json_table(const Json& json) {
    for (const char* key : {"labels", "segments"})
        if (json.is_object() && json.contains(key) && json[key].is_structured())
            return json[key].is_array() ? records_in(json[key]) : pairs_in(json[key]);
    if (json.is_array()) return records_in(json);
    return json.is_object() ? pairs_in(json) : std::vector<Segment>();
}

/// Each label once, ascending, without the background.
std::vector<Segment> in_order(const std::vector<Segment>& read) {
    std::map<int, Segment> by_label;
    for (const Segment& segment : read)
        if (segment.label > 0 && !segment.name.empty())
            by_label.try_emplace(segment.label, segment);
    std::vector<Segment> segments;
    for (auto& [label, segment] : by_label) segments.push_back(std::move(segment));
    return segments;
}

}  // namespace

bool has_label_table(const fs::path& image) {
    std::error_code ignored;
    return std::ranges::any_of(label_table_places(image), [&](const fs::path& place) {
        return fs::is_regular_file(place, ignored);
    });
}

std::vector<Segment> label_table_in(std::string_view text) {
    if (const auto start = trimmed(text); start.starts_with('{') || start.starts_with('['))
        return in_order(json_table(Json::parse(text, nullptr, false)));
    const auto lines = lines_of(text);
    for (const auto read : {snap_line, colour_table_line})
        if (auto segments = in_order(table_of(lines, read)); !segments.empty()) return segments;
    return in_order(columns_table(lines));
}

std::vector<Segment> label_table_beside(const std::string& image, std::vector<std::string>& notes) {
    for (const fs::path& place : label_table_places(image)) {
        std::error_code error;
        if (!fs::is_regular_file(place, error) || fs::file_size(place, error) > kLargestTable)
            continue;
        std::vector<Segment> segments;
        try {
            segments = label_table_in(file_content(place.string()));
        } catch (const IoError&) {  // what cannot be read names no labels
            continue;
        }
        if (segments.empty()) continue;
        notes.push_back("the labels' names are those of '" + place.filename().string() +
                        "' beside the file");
        return segments;
    }
    return {};
}

}  // namespace vesselbench
