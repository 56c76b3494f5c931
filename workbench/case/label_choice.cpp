#include "workbench/case/label_choice.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <set>
#include <utility>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/printable.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/near_names.h"
#include "workbench/case/scene.h"
#include "workbench/case/shell_text.h"

namespace vesselbench {

namespace {

/// Of a hundred labels, so many are offered as answers; all are listed.
constexpr std::size_t kMostAnswers = 20;

std::string without_blanks(std::string_view text) {
    const auto first = text.find_first_not_of(' '), last = text.find_last_not_of(' ');
    return first == std::string_view::npos ? "" : std::string(text.substr(first, last - first + 1));
}

std::vector<std::string> parts_of(std::string_view text) {
    std::vector<std::string> parts;
    while (true) {
        const auto end = std::min(text.find(','), text.size());
        parts.push_back(without_blanks(text.substr(0, end)));
        if (end == text.size()) return parts;
        text.remove_prefix(end + 1);
    }
}

std::optional<int> label_in(const std::string& text) {
    int label = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), label);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return label;
}

/// Looks up what a user calls a label.
class LabelNames {
public:
    LabelNames(const std::vector<Segment>& segments, const std::vector<int>& there)
        : segments_(segments), there_(there) {}

    /// As it is written, else in any case, else by its number; none: there is no such label.
    [[nodiscard]] std::vector<int> find(const std::string& name) const {
        for (const bool exact : {true, false}) {
            std::vector<int> found;
            for (const Segment& segment : segments_)
                if (exact ? segment.name == name : lower_case(segment.name) == lower_case(name))
                    found.push_back(segment.label);
            if (!found.empty()) return found;
        }
        const auto label = label_in(name);
        const bool known =
            label && (occurs(*label) || std::ranges::count(segments_, *label, &Segment::label) > 0);
        return known ? std::vector<int>{*label} : std::vector<int>();
    }

    [[nodiscard]] bool occurs(int label) const { return std::ranges::binary_search(there_, label); }

    [[noreturn]] void refuse(const std::string& name) const {
        std::vector<std::string> names, listed;
        for (const Segment& segment : segments_) names.push_back(segment.name);
        for (const int label : there_) {
            const std::string named = name_of_label(segments_, label);
            listed.push_back(named.starts_with("label ")
                                 ? std::to_string(label)
                                 : named + " (" + std::to_string(label) + ")");
        }
        throw UsageError("there is no label '" + shortened(printable(name)) + "'" +
                         did_you_mean(name, names) + "; the labels are " +
                         (listed.empty() ? "none" : shortened(joined(listed), 1000)));
    }

    [[noreturn]] void refuse_empty(int label) const {
        throw UsageError("the segment '" + name_of_label(segments_, label) +
                         "' is empty: no voxel has its label, " + std::to_string(label));
    }

private:
    const std::vector<Segment>& segments_;
    const std::vector<int>& there_;
};

std::string size_text(const Vec3& size) {
    return formatted(size.x()) + " x " + formatted(size.y()) + " x " + formatted(size.z()) + " mm";
}

/// Rows with columns of equal width; names may hold characters of several bytes.
std::string in_columns(const std::vector<std::vector<std::string>>& rows) {
    const auto width = [](const std::string& text) {
        return std::ranges::count_if(text, [](char c) { return (c & 0xc0) != 0x80; });
    };
    std::vector<std::ptrdiff_t> widths(rows.front().size());
    for (const auto& row : rows)
        for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], width(row[c]));
    std::string text;
    for (const auto& row : rows) {
        text += "\n ";
        for (std::size_t c = 0; c < row.size(); ++c) {
            text += " " + row[c];
            if (c + 1 < row.size())
                text += std::string(static_cast<std::size_t>(widths[c] - width(row[c]) + 1), ' ');
        }
    }
    return text;
}

/// What names a label: its name, or its number where a name would not do.
std::string option_of(const std::vector<Segment>& segments, int label) {
    const auto found = std::ranges::find(segments, label, &Segment::label);
    const bool plain = found != segments.end() && !found->name.empty() &&
                       found->name.find(',') == std::string::npos;
    return plain ? found->name : std::to_string(label);
}

}  // namespace

const Image& label_image(const Scene& scene) {
    return scene.mask ? *scene.mask : *scene.image;
}

std::vector<int> labels_named(const std::string& text, const std::vector<Segment>& segments,
                              const std::vector<int>& there) {
    if (without_blanks(text) == "all") return there;
    const LabelNames names(segments, there);
    std::set<int> labels;
    const auto take = [&](const std::vector<int>& found) {
        for (const int label : found) {
            if (!names.occurs(label)) names.refuse_empty(label);
            labels.insert(label);
        }
        return !found.empty();
    };
    // A name may hold a comma.
    if (!take(names.find(without_blanks(text))))
        for (const std::string& part : parts_of(text))
            if (!take(names.find(part))) names.refuse(part);
    return {labels.begin(), labels.end()};
}

std::string label_list(const std::vector<Segment>& segments,
                       const std::map<int, LabelSize>& sizes) {
    std::vector<std::vector<std::string>> rows = {{"label", "name", "volume", "size"}};
    for (const auto& [label, size] : sizes) {
        const auto found = std::ranges::find(segments, label, &Segment::label);
        rows.push_back({std::to_string(label), found == segments.end() ? "-" : found->name,
                        formatted(size.volume / 1000.0, "%.3g ml"), size_text(size.size)});
    }
    return in_columns(rows);
}

Diagnostic label_unchosen(const std::vector<Segment>& segments,
                          const std::map<int, LabelSize>& sizes) {
    std::vector<std::string> numbers;
    std::vector<Remedy> remedies;
    for (const auto& [label, size] : sizes) {
        if (numbers.size() < 2) numbers.push_back(std::to_string(label));
        if (remedies.size() == kMostAnswers) break;
        remedies.push_back({.arguments = {{"label", option_of(segments, label)}}});
    }
    // The largest one is no better guess than another: the first one is the example.
    const std::string& example = remedies.front().arguments.at("label");
    return {.code = "label-unchosen",
            .operation = "load-image",
            .figures = {{"labels", static_cast<double>(sizes.size())}},
            .words = {{"list", label_list(segments, sizes)},
                      {"option", "--label " + shell_quoted(example)},
                      {"several", joined(numbers, ",")}},
            .remedies = std::move(remedies)};
}

}  // namespace vesselbench
