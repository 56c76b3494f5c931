#include "workbench/review/reporting_items.h"

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "geometry/kernel/wording.h"
#include "workbench/case/purposes.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

std::string text_at(const Json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

/// Texts of a list's elements, those that are not empty; none: nothing is stated.
std::optional<std::string> texts(const Json& list,
                                 const std::function<std::string(const Json&)>& text_of,
                                 const std::string& separator = ", ") {
    std::vector<std::string> found;
    for (const Json& element : list)
        if (std::string text = text_of(element); !text.empty()) found.push_back(std::move(text));
    if (found.empty()) return std::nullopt;
    return joined(found, separator);
}

std::string own_text(const Json& name) {
    return name.is_string() ? name.get<std::string>() : "";
}

std::string numbers_text(const Json& value) {
    std::vector<std::string> numbers;
    for (const Json& number : value)
        if (number.is_number()) numbers.push_back(formatted(number.get<double>(), "%.4g"));
    return joined(numbers, " x ");
}

/// "0.45 x 0.45 x 0.8 mm, 83 x 25 x 78 voxels"; of a surface "12400 triangles".
std::string resolution_of(const Json& source) {
    if (source.contains("spacing_mm") && source.contains("size_voxels"))
        return numbers_text(source["spacing_mm"]) + " mm, " + numbers_text(source["size_voxels"]) +
               " voxels";
    if (source.contains("triangles")) return source["triangles"].dump() + " triangles";
    return "";
}

/// A surface that was loaded was segmented elsewhere.
std::string segmentation_of(const Json& edit) {
    if (edit.value("loaded", false)) return "";
    const std::string arguments = text_at(edit, "arguments");
    return text_at(edit, "operation") + (arguments.empty() ? "" : " " + arguments);
}

std::string reviewer_of(const Json& reviewer) {
    const std::string role = text_at(reviewer, "role");
    const auto signatures = texts(reviewer.value("signatures", Json::array()), own_text);
    return text_at(reviewer, "name") + (role.empty() ? "" : " (" + role + ")") +
           (signatures ? ", " + *signatures : "");
}

std::string export_of(const Json& file) {
    return text_at(file, "file") + " SHA-256 " + text_at(file, "sha256");
}

/// Of the edits that moved the wall; what is cut off or added at openings is no error.
std::optional<std::string> editing_accuracy(const Json& edits) {
    std::optional<std::string> text;
    double largest = 0.0;
    for (const Json& edit : edits) {
        const Json change = edit.value("accuracy", Json::object());
        const Json deviation = change.value("largest_deviation_mm", Json());
        if (text_at(edit, "step") == "openings" || !deviation.is_number() ||
            (text && deviation.get<double>() <= largest))
            continue;
        largest = deviation.get<double>();
        text = "listed for each edit; largest deviation " + formatted(largest, "%.3g mm") +
               " by edit " + edit["edit"].dump() + " " + text_at(edit, "operation");
    }
    return text;
}

Json row(const char* item, const std::optional<std::string>& stated, const char* otherwise) {
    return {{"item", item},
            {"stated", stated.has_value()},
            {"text", stated ? *stated : std::string("not stated: ") + otherwise}};
}

}  // namespace

Json exports_json(std::span<const ChainEntry> entries) {
    Json files = Json::object();
    for (const ChainEntry& entry : entries) {
        if (entry.kind != "export") continue;
        const Json facts = Json::parse(entry.content, nullptr, false);
        if (!facts.is_object()) continue;
        const std::string variant = text_at(facts, "variant");
        files[entry.subject + "\n" + variant] = {{"file", entry.subject},
                                                 {"variant", variant},
                                                 {"time", entry.time},
                                                 {"sha256", text_at(facts, "sha256")}};
    }
    Json list = Json::array();
    for (const Json& file : files) list.push_back(file);
    return list;
}

Json reporting_items(const Json& statement) {
    const Json &sources = statement["sources"], &edits = statement["edits"];
    const std::optional<std::string> count =
        edits.empty() ? std::nullopt : std::optional(counted(edits.size(), "edit") + ", listed");
    const auto use = [](const Json& variant) { return model_title(own_text(variant)); };
    const auto file = [](const Json& source) { return text_at(source, "file"); };
    return {row("intended use", texts(statement["variants"], use), "no purpose was given"),
            row("source", texts(sources, file), "no file was read"),
            row("modality", {}, "of DICOM files only geometry and pixels are read"),
            row("resolution", texts(sources, resolution_of), "no source with a resolution"),
            row("image quality: noise, contrast, artifacts", {}, "it is not measured"),
            row("segmentation", texts(statement["segmentation"], segmentation_of, "; "),
                "the surface was made elsewhere"),
            row("edits", count, "there are none"),
            row("operators", texts(statement["operators"], own_text), "no edit has an author"),
            row("reviewers", texts(statement["reviewers"], reviewer_of), "not reviewed"),
            row("accuracy of the editing", editing_accuracy(edits), "no edit moved the surface"),
            row("accuracy of the segmentation", {}, "there is no reference"),
            row("unit and scale", "mm at scale 1:1; OpenFOAM cases and GLB files in m", ""),
            row("software and version", texts(statement["program_versions"], own_text),
                "no edit has run"),
            row("files", texts(statement["exports"], export_of), "nothing was exported"),
            row("printer, material and settings", {}, "they follow the export"),
            row("post-processing and accuracy of the print", {}, "they follow the export")};
}

}  // namespace vesselbench
