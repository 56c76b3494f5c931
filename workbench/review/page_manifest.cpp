#include "workbench/review/page_manifest.h"

#include <algorithm>
#include <map>

#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/diagnostic_words.h"
#include "workbench/case/point_json.h"
#include "workbench/case/purposes.h"
#include "workbench/case/readable_name.h"
#include "workbench/case/version.h"
#include "workbench/project/project.h"
#include "workbench/project/utc_time.h"
#include "workbench/report/base64.h"
#include "workbench/report/log_json.h"
#include "workbench/review/known_operation.h"
#include "workbench/review/page_queue.h"
#include "workbench/review/provenance.h"
#include "workbench/review/review.h"
#include "workbench/review/review_json.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostNumbers = 12;  ///< longer lists are counted

/// With as many digits as people read.
struct ShownValue {
    std::string operator()(double number) const { return formatted(number); }

    std::string operator()(const Vec3& p) const {
        return formatted(p.x()) + ", " + formatted(p.y()) + ", " + formatted(p.z());
    }

    std::string operator()(const std::vector<double>& list) const {
        std::vector<std::string> texts;
        for (const double number : list) texts.push_back(formatted(number));
        return texts.size() <= kMostNumbers ? joined(texts) : counted(texts.size(), "number");
    }

    std::string operator()(const Records& records) const {
        return counted(records.list().size(), "record");
    }

    template <class Other>
    std::string operator()(const Other& other) const {
        return to_text(Value(other));
    }
};

std::string shown(const Value& value) {
    return std::visit(ShownValue{}, value);
}

/// Null: of another version.
const Parameter* parameter_named(const Operation* operation, const std::string& name) {
    if (operation == nullptr) return nullptr;
    const auto found = std::ranges::find(operation->parameters, name, &Parameter::name);
    return found == operation->parameters.end() ? nullptr : &*found;
}

std::string unit_of(const Operation* operation, const std::string& name) {
    const Parameter* parameter = parameter_named(operation, name);
    return parameter == nullptr || parameter->unit == "-" ? "" : parameter->unit;
}

Json row_of(const Operation* operation, const std::string& name, const Value& value,
            bool automatic) {
    return {{"name", readable(name)},
            {"value", shown(value)},
            {"unit", unit_of(operation, name)},
            {"automatic", automatic}};
}

Json given_json(const Operation* operation, const Arguments& given) {
    Json rows = Json::array();
    for (const auto& [name, value] : given.values())
        rows.push_back(row_of(operation, name, value, false));
    return rows;
}

/// What the operation chose: neither given nor a default.
Json decided_json(const Operation* operation, const Arguments& resolved, const Arguments& given) {
    Json rows = Json::array();
    for (const auto& [name, value] : resolved.values()) {
        const Parameter* parameter = parameter_named(operation, name);
        const bool is_default = parameter != nullptr && parameter->default_value == value;
        if (!given.has(name) && !is_default) rows.push_back(row_of(operation, name, value, true));
    }
    return rows;
}

Json figure_json(const char* name, const std::string& value, const char* unit) {
    return {{"name", name}, {"value", value}, {"unit", unit}};
}

/// Of the model that an edit made, not of what it changed.
Json model_json(const SurfaceChange& change) {
    Json rows = Json::array();
    if (change.volume_after)
        rows.push_back(figure_json("Volume", formatted(*change.volume_after), "mm\u00B3"));
    if (change.triangles_after > 0)
        rows.push_back(figure_json("Triangles", std::to_string(change.triangles_after), ""));
    return rows;
}

/// \param wall how the wall alone moved, which the queue says as well; none: not known
Json figures_json(const ResultRecord& result, const std::optional<WallChange>& wall) {
    Json rows = Json::array();
    const auto add = [&](const char* name, const std::string& value, const char* unit) {
        rows.push_back(figure_json(name, value, unit));
    };
    const SurfaceChange& change = result.change;
    if (change.volume_before) add("Volume before", formatted(*change.volume_before), "mm\u00B3");
    if (change.volume_after) add("Volume after", formatted(*change.volume_after), "mm\u00B3");
    if (wall)
        add("Largest deviation of the wall", formatted(wall->largest), "mm");
    else if (change.largest_deviation)
        add("Largest deviation", formatted(*change.largest_deviation), "mm");
    if (change.mean_deviation) add("Mean deviation", formatted(*change.mean_deviation), "mm");
    if (change.triangles_after > 0) add("Triangles", std::to_string(change.triangles_after), "");
    const Json report = reported(result);
    if (const auto line = report.find("headline"); line != report.end() && line->is_string())
        add("Result", line->get<std::string>(), "");
    return rows;
}

Json warnings_json(const ResultRecord& result) {
    Json rows = Json::array();
    for (const Diagnostic& warning : result.warnings) {
        Json row = {{"text", readable_sentence(worded(warning, {.window = true}))}};
        if (warning.place) row["place"] = point_json(*warning.place);
        rows.push_back(std::move(row));
    }
    return rows;
}

std::string status_word(EditStatus status) {
    return status == EditStatus::Done ? "applied" : to_string(status);
}

/// Where and how much; only what is known.
void add_model(const PageEditModel& model, Json& edit) {
    if (model.before) edit["before"] = *model.before;
    if (model.after) edit["after"] = *model.after;
    if (!model.slices.empty()) edit["slices"] = model.slices;
    if (!model.thumbnail.empty())
        edit["thumbnail"] = "data:image/png;base64," + base64(model.thumbnail);
    if (!model.deviation.is_null()) edit["deviation"] = model.deviation;
    if (model.place) {
        edit["place"] = point_json(*model.place);
        edit["outward"] = point_json(model.outward);
    }
    if (model.radius) edit["radius"] = *model.radius;
    if (!model.changed) return;
    edit["changed_box"] = point_json(model.changed->min);
    for (const double coordinate : model.changed->max) edit["changed_box"].push_back(coordinate);
}

Json edit_json(const LogEntry& entry, const ReviewedEdit* reviewed, const PageModels& models,
               const Operation* operation) {
    const EditRecord& edit = entry.edit;
    Json json = {{"id", edit.edit.id},
                 {"revision", edit.edit.revision},
                 {"hash", reviewed != nullptr ? reviewed->hash : ""},
                 {"step", to_string(edit.place.step)},
                 {"step_title", readable(to_string(edit.place.step))},
                 {"operation", edit.operation},
                 {"title", readable(edit.operation)},
                 {"author", edit.author},
                 {"time", edit.time},
                 {"status", status_word(entry.status)},
                 {"note", edit.note},
                 {"arguments", given_json(operation, edit.given)},
                 {"before", nullptr},
                 {"after", nullptr}};
    const auto model = models.edits.find(edit.edit.id);
    const bool modelled = model != models.edits.end();
    if (entry.result) {
        json["decided"] = decided_json(operation, entry.result->resolved, edit.given);
        json["figures"] = figures_json(*entry.result, modelled ? model->second.wall : std::nullopt);
        json["warnings"] = warnings_json(*entry.result);
    } else if (!entry.reason.empty()) {
        json["warnings"] = {{{"text", readable_sentence(entry.reason)}}};
    }
    if (reviewed != nullptr) json["verdicts"] = verdicts_json(reviewed->verdicts);
    if (modelled) add_model(model->second, json);
    return json;
}

/// The first file that the case was made from, with what its edit's report says of its resolution.
Json source_json(const Session& session, const std::vector<LogEntry>& log) {
    for (const LogEntry& entry : log) {
        const std::vector<SourceFile> files = session.project().sources(entry.edit.edit);
        if (files.empty()) continue;
        Json source = {{"file", files.front().name}, {"kind", "surface"}};
        const Json report = entry.result ? reported(*entry.result) : Json::object();
        if (report.contains("spacing_mm")) {
            source["kind"] = "image";
            source["spacing"] = report["spacing_mm"];
        }
        if (report.contains("size_voxels")) source["size"] = report["size_voxels"];
        return source;
    }
    return Json::object();
}

Json report_json(const std::vector<LogEntry>& log) {
    for (auto entry = log.rbegin(); entry != log.rend(); ++entry)
        if (entry->status == EditStatus::Done && entry->result)
            return model_json(entry->result->change);
    return Json::array();
}

/// What the page says that it holds.
Json held(const PageModels& models, PageImages images) {
    Json words = {"surface"};
    if (images != PageImages::None) words.push_back("contours");
    if (!models.slices.empty()) words.push_back("image slices");
    if (!models.neighbours.empty()) words.push_back("neighbours");
    return words;
}

}  // namespace

Json page_manifest(const Session& session, const std::string& variant,
                   const std::vector<LogEntry>& log, const PageModels& models, PageImages images,
                   const OperationLookup& find) {
    const Review review = review_of(session, variant);
    Json edits = Json::array(), neighbours = Json::array();
    for (const LogEntry& entry : log) {
        const auto reviewed = std::ranges::find(review.edits, entry.edit.edit, &ReviewedEdit::edit);
        edits.push_back(edit_json(entry, reviewed == review.edits.end() ? nullptr : &*reviewed,
                                  models, known_operation(find, entry.edit.operation)));
    }
    for (const auto& [name, state] : models.neighbours)
        neighbours.push_back({{"name", name}, {"state", state}});
    Json manifest = {{"format", "vesselbench-review"},
                     {"version", 1},
                     {"program", version()},
                     {"written", utc_now()},
                     {"chain_head", session.project().record_head()},
                     {"project",
                      {{"id", session.project().id()},
                       {"name", shown_name(session)},
                       {"purpose", model_title(variant)},
                       {"units", "mm"},
                       {"source", source_json(session, log)},
                       {"variant", variant}}},
                     {"holds", held(models, images)}};
    manifest.update(models.geometry.json());
    manifest["neighbours"] = neighbours;
    manifest["edits"] = edits;
    manifest["queue"] = queue_json(review_queue(log, models, find));
    manifest["report"] = report_json(log);
    return manifest;
}

}  // namespace vesselbench
