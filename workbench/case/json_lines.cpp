#include "workbench/case/json_lines.h"

#include <cstdint>
#include <iterator>
#include <vector>

#include <nlohmann/json.hpp>

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

/// The line in which the next character is, and that of the last one.
struct LineCount {
    std::size_t now = 1, before = 1;
};

/// Characters of a text, which counts the lines that were read.
class CountingCharacters {
public:
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = const char&;

    CountingCharacters(const char* at, LineCount* lines) : at_(at), lines_(lines) {}

    reference operator*() const { return *at_; }

    CountingCharacters& operator++() {
        lines_->before = lines_->now;
        if (*at_++ == '\n') ++lines_->now;
        return *this;
    }

    CountingCharacters operator++(int) {
        CountingCharacters before = *this;
        ++*this;
        return before;
    }

    bool operator==(const CountingCharacters& other) const { return at_ == other.at_; }

private:
    const char* at_;
    LineCount* lines_;
};

/// Notes the line at which the parser is when it reports something. It has read one character more
/// after a number, which ends where the next character is none of it.
class LineNotes : public nlohmann::json_sax<Json> {
public:
    explicit LineNotes(const LineCount& count) : count_(count) {}

    std::map<std::string, std::size_t> lines;

    bool null() override { return value(count_.now); }

    bool boolean(bool) override { return value(count_.now); }

    bool number_integer(std::int64_t) override { return value(count_.before); }

    bool number_unsigned(std::uint64_t) override { return value(count_.before); }

    bool number_float(double, const std::string&) override { return value(count_.before); }

    bool string(std::string&) override { return value(count_.now); }

    bool binary(Json::binary_t&) override { return value(count_.now); }

    bool start_object(std::size_t) override { return begin(false); }

    bool start_array(std::size_t) override { return begin(true); }

    bool end_object() override { return end(); }

    bool end_array() override { return end(); }

    bool key(std::string& name) override {
        levels_.back().key = name;
        lines.emplace(place(), count_.now);
        return true;
    }

    bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override {
        return false;
    }

private:
    struct Level {
        bool is_list = false;
        std::size_t index = 0;
        std::string key = {};
    };

    [[nodiscard]] std::string place() const {
        std::string place;
        for (const Level& level : levels_)
            place += "/" + (level.is_list ? std::to_string(level.index) : level.key);
        return place;
    }

    /// A value that is no key's is noted by its own line.
    bool value(std::size_t line) {
        if (levels_.empty() || !levels_.back().is_list) return true;
        lines.emplace(place(), line);
        ++levels_.back().index;
        return true;
    }

    bool begin(bool list) {
        lines.emplace(place(), count_.now);
        levels_.push_back({.is_list = list});
        return true;
    }

    bool end() {
        levels_.pop_back();
        return value(count_.now);
    }

    const LineCount& count_;
    std::vector<Level> levels_;
};

}  // namespace

std::map<std::string, std::size_t> json_lines(std::string_view text) {
    LineCount count;
    LineNotes notes(count);
    const CountingCharacters first(text.data(), &count), last(text.data() + text.size(), &count);
    Json::sax_parse(first, last, &notes, Json::input_format_t::json, true, true);
    return std::move(notes.lines);
}

std::size_t line_at(const std::map<std::string, std::size_t>& lines, std::string place) {
    for (;;) {
        const auto found = lines.find(place);
        if (found != lines.end()) return found->second;
        if (place.empty()) return 0;
        place.resize(place.find_last_of('/'));
    }
}

}  // namespace vesselbench
