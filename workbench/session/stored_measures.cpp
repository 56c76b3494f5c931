#include "workbench/session/stored_measures.h"

#include <algorithm>
#include <array>

#include "geometry/kernel/errors.h"
#include "workbench/case/json_fields.h"
#include "workbench/case/json_text.h"
#include "workbench/case/point_json.h"
#include "workbench/session/stored_texts.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

template <class Value>
struct Named {
    Value value;
    const char* name;
};

constexpr std::array<Named<MeasureKind>, 2> kKinds = {
    {{MeasureKind::Distance, "distance"}, {MeasureKind::Diameter, "diameter"}}};

constexpr std::array<Named<MeasuredOn>, 5> kPlaces = {
    {{MeasuredOn::Surface, "surface"},
     {MeasuredOn::Preview, "preview"},
     {MeasuredOn::AxialSlice, "axial-slice"},
     {MeasuredOn::CoronalSlice, "coronal-slice"},
     {MeasuredOn::SagittalSlice, "sagittal-slice"}}};

std::string name_in(const auto& table, auto value) {
    return std::ranges::find_if(table, [&](const auto& row) { return row.value == value; })->name;
}

auto value_in(const auto& table, const std::string& name, const std::string& place) {
    const auto row = std::ranges::find_if(table, [&](const auto& at) { return name == at.name; });
    if (row == table.end()) throw InvalidInput(place + " is unknown: '" + name + "'");
    return row->value;
}

Json json_of(const KeptMeasure& measure) {
    Json points = Json::array();
    for (const Vec3& point : measure.points) points.push_back(point_json(point));
    return {{"name", measure.name},
            {"kind", to_string(measure.kind)},
            {"points", points},
            {"length", measure.length},
            {"area", measure.area},
            {"equivalent", measure.equivalent},
            {"on", to_string(measure.on)},
            {"state", measure.state},
            {"variant", measure.variant},
            {"time", measure.time}};
}

KeptMeasure measure_from(const Json& json, const std::string& place) {
    JsonFields fields(json, place);
    KeptMeasure measure{
        .name = fields.required<std::string>("name"),
        .kind = value_in(kKinds, fields.required<std::string>("kind"), place + ".kind"),
        .length = fields.required<double>("length"),
        .area = fields.required<double>("area"),
        .equivalent = fields.required<double>("equivalent"),
        .on = value_in(kPlaces, fields.required<std::string>("on"), place + ".on"),
        .state = fields.required<StateId>("state"),
        .variant = fields.required<std::string>("variant"),
        .time = fields.required<std::string>("time")};
    for (const auto& point : fields.required<std::vector<std::array<double, 3>>>("points"))
        measure.points.emplace_back(point[0], point[1], point[2]);
    const std::size_t least = measure.kind == MeasureKind::Distance ? 2 : 1;
    if (measure.points.size() < least) throw InvalidInput(place + ".points has too few points");
    return measure;
}

}  // namespace

std::string to_string(MeasureKind kind) {
    return name_in(kKinds, kind);
}

std::string to_string(MeasuredOn on) {
    return name_in(kPlaces, on);
}

void store_measures(const std::filesystem::path& project,
                    const std::vector<KeptMeasure>& measures) {
    Json list = Json::array();
    for (const KeptMeasure& measure : measures) list.push_back(json_of(measure));
    store_text(project, StoredText::Measures, text_from_json(list));
}

std::vector<KeptMeasure> stored_measures(const std::filesystem::path& project) {
    const std::string text = stored_text(project, StoredText::Measures);
    std::vector<KeptMeasure> measures;
    if (text.empty()) return measures;
    const Json list = json_from_text(text, "the stored measures");
    if (!list.is_array()) refuse_json(list, "measures", "a list");
    for (std::size_t i = 0; i < list.size(); ++i)
        measures.push_back(measure_from(list[i], "measures[" + std::to_string(i) + "]"));
    return measures;
}

}  // namespace vesselbench
