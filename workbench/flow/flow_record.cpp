#include "workbench/flow/flow_record.h"

#include <algorithm>
#include <cmath>
#include <span>

#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/whole_file.h"
#include "geometry/vessel/sac/sac_regions.h"
#include "meshing/products/openfoam_case.h"
#include "meshing/products/openfoam_mesh.h"
#include "workbench/case/json_fields.h"
#include "workbench/case/json_text.h"
#include "workbench/case/measure_json.h"
#include "workbench/case/point_json.h"
#include "workbench/project/content_hash.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// By their names, whatever else a solver's tools leave beside them.
constexpr std::array kMeshFiles = {"boundary", "faces", "neighbour", "owner", "points"};

std::string mesh_digest(const fs::path& folder) {
    ContentHash hash;
    for (const char* name : kMeshFiles) {
        const std::string bytes = file_content(folder / "constant" / "polyMesh" / name);
        hash.add(std::as_bytes(std::span(bytes)));
    }
    return hash.hex();
}

RecordedOpening recorded(const PatchMeasures& patch, const FlowSummary& summary) {
    RecordedOpening opening{.name = foam_word(patch.name),
                            .kind = patch.kind,
                            .area = patch.area,
                            .diameter = diameter_of_area(patch.area)};
    const auto inlet = std::ranges::find(summary.inlets, patch.name, &InletFlow::name);
    if (inlet == summary.inlets.end()) return opening;
    opening.flow = inlet->flow;
    opening.reynolds = inlet->reynolds;
    return opening;
}

std::optional<RecordedWaveform> recorded_waveform(const CfdParameters& parameters) {
    if (!parameters.waveform) return std::nullopt;
    return RecordedWaveform{.synthetic = parameters.waveform->synthetic,
                            .period = parameters.waveform->period(),
                            .periods = parameters.periods,
                            .steps = parameters.steps};
}

FlowRecord flow_record_of(const fs::path& folder, const VolumeMesh& mesh,
                          const CfdParameters& parameters, const FlowOrigin& origin) {
    const Surface surface = boundary_surface(mesh);
    const FlowSummary summary = flow_summary(surface, parameters);
    FlowRecord record{.provenance = origin.provenance,
                      .mesh = mesh_digest(folder),
                      .cells = mesh.cell_count(),
                      .bounds = bounds(mesh.points),
                      .density = parameters.density,
                      .viscosity = viscosity_at_shear(parameters),
                      .carreau = parameters.viscosity_model == ViscosityModel::Carreau,
                      .given_outflows = !summary.outflows.empty(),
                      .outflow_rule = outlets_text(parameters),
                      .parabolic = parameters.profile == InflowProfile::Parabolic,
                      .walls = {},
                      .openings = {},
                      .ends = origin.ends,
                      .neck = origin.neck,
                      .waveform = recorded_waveform(parameters)};
    if (record.neck) record.neck->inlet = inlet_place(surface);
    for (const PatchMeasures& patch : measure_patches(surface)) {
        if (patch.kind == PatchKind::Wall) record.walls.push_back(foam_word(patch.name));
        if (patch.kind == PatchKind::Inlet || patch.kind == PatchKind::Outlet)
            record.openings.push_back(recorded(patch, summary));
    }
    return record;
}

Json neck_json(const RecordedNeck& recorded) {
    const SacNeck& neck = recorded.neck;
    Json json = {{"dome_mm", point_json(neck.dome)},
                 {"at_mm", point_json(neck.plane.point)},
                 {"normal", point_json(neck.plane.normal)},
                 {"reach", recorded.reach}};
    if (recorded.inlet) json["inlet_mm"] = point_json(*recorded.inlet);
    return json;
}

Json to_json(const FlowRecord& record) {
    const auto& [least, most] = record.bounds;
    Json openings = Json::array(), ends = Json::array();
    for (const MadeEnd& end : record.ends)
        ends.push_back({{"centre_mm", point_json(end.centre)},
                        {"outward", point_json(end.outward)},
                        {"diameter_mm", end.diameter}});
    for (const RecordedOpening& opening : record.openings) {
        Json row = {{"name", opening.name},
                    {"kind", to_string(opening.kind)},
                    {"area_mm2", opening.area},
                    {"diameter_mm", opening.diameter}};
        if (opening.flow) row["flow_cm3_s"] = *opening.flow;
        if (opening.reynolds) row["reynolds"] = *opening.reynolds;
        openings.push_back(std::move(row));
    }
    Json json = {{"provenance", record.provenance},
                 {"mesh_sha256", record.mesh},
                 {"cells", record.cells},
                 {"bounds_mm", {least.x(), least.y(), least.z(), most.x(), most.y(), most.z()}},
                 {"density_kg_m3", record.density},
                 {"viscosity_pa_s", record.viscosity},
                 {"viscosity_model", record.carreau ? "Carreau" : "Newtonian"},
                 {"outflows_given", record.given_outflows},
                 {"outflow_rule", record.outflow_rule},
                 {"profile", record.parabolic ? "parabolic" : "plug"},
                 {"walls", record.walls},
                 {"openings", openings},
                 {"ends", ends}};
    if (record.neck) json["neck"] = neck_json(*record.neck);
    if (record.waveform)
        json["waveform"] = {{"synthetic", record.waveform->synthetic},
                            {"period_s", record.waveform->period},
                            {"periods", record.waveform->periods},
                            {"steps", record.waveform->steps}};
    return json;
}

RecordedOpening opening_from(const Json& json, const std::string& place) {
    JsonFields fields(json, place);
    return {.name = fields.required<std::string>("name"),
            .kind = patch_kind_from(fields.required<std::string>("kind")),
            .area = fields.required<double>("area_mm2"),
            .diameter = fields.required<double>("diameter_mm"),
            .flow = fields.optional<double>("flow_cm3_s"),
            .reynolds = fields.optional<double>("reynolds")};
}

Vec3 vector_from(const std::array<double, 3>& xyz) {
    return {xyz[0], xyz[1], xyz[2]};
}

MadeEnd made_end_from(const Json& json, const std::string& place) {
    JsonFields fields(json, place);
    return {.centre = vector_from(fields.required<std::array<double, 3>>("centre_mm")),
            .outward = vector_from(fields.required<std::array<double, 3>>("outward")),
            .diameter = fields.required<double>("diameter_mm")};
}

RecordedNeck neck_from(const Json& json, const std::string& place) {
    JsonFields fields(json, place);
    const auto point = [&](const char* key) {
        return vector_from(fields.required<std::array<double, 3>>(key));
    };
    RecordedNeck recorded{.neck = {point("dome_mm"), {point("at_mm"), point("normal")}},
                          .reach = fields.required<double>("reach")};
    if (const auto inlet = fields.optional<std::array<double, 3>>("inlet_mm"))
        recorded.inlet = vector_from(*inlet);
    return recorded;
}

RecordedWaveform waveform_from(const Json& json, const std::string& place) {
    JsonFields fields(json, place);
    const RecordedWaveform wave{.synthetic = fields.required<bool>("synthetic"),
                                .period = fields.required<double>("period_s"),
                                .periods = fields.required<int>("periods"),
                                .steps = fields.required<int>("steps")};
    if (!(wave.period > 0.0) || wave.periods < 1 || wave.steps < 1)
        throw InvalidInput(place + " is not a waveform of this program");
    return wave;
}

/// The entries of a list, each read by `read`; none if there is no list.
template <class Entry>
std::vector<Entry> list_from(JsonFields& fields, const char* key,
                             Entry (*read)(const Json&, const std::string&)) {
    std::vector<Entry> entries;
    const Json* list = fields.child(key);
    if (list != nullptr && list->is_array())
        for (const Json& entry : *list) entries.push_back(read(entry, fields.place_of(key)));
    return entries;
}

FlowRecord flow_record_from(const Json& json) {
    JsonFields fields(json, kFlowRecordFile);
    const auto box = fields.required<std::array<double, 6>>("bounds_mm");
    FlowRecord record{.provenance = fields.optional<std::string>("provenance").value_or(""),
                      .mesh = fields.required<std::string>("mesh_sha256"),
                      .cells = fields.required<std::size_t>("cells"),
                      .bounds = {Vec3(box[0], box[1], box[2]), Vec3(box[3], box[4], box[5])},
                      .density = fields.required<double>("density_kg_m3"),
                      .viscosity = fields.required<double>("viscosity_pa_s"),
                      .carreau = fields.required<std::string>("viscosity_model") == "Carreau",
                      .given_outflows = fields.required<bool>("outflows_given"),
                      .outflow_rule = fields.optional<std::string>("outflow_rule").value_or(""),
                      .parabolic = fields.required<std::string>("profile") == "parabolic",
                      .walls = fields.required<std::vector<std::string>>("walls"),
                      .openings = list_from(fields, "openings", &opening_from),
                      .ends = list_from(fields, "ends", &made_end_from)};
    if (const Json* neck = fields.child("neck"))
        record.neck = neck_from(*neck, fields.place_of("neck"));
    if (const Json* wave = fields.child("waveform"))
        record.waveform = waveform_from(*wave, fields.place_of("waveform"));
    if (record.walls.empty() || record.openings.empty())
        throw InvalidInput(std::string(kFlowRecordFile) + " lists no wall, or no openings");
    return record;
}

}  // namespace

int FlowRecord::steps_until(double time) const {
    return static_cast<int>(std::lround(time / step()));
}

void write_flow_record(const fs::path& folder, const VolumeMesh& mesh,
                       const CfdParameters& parameters, const FlowOrigin& origin) {
    const FlowRecord record = flow_record_of(folder, mesh, parameters, origin);
    write_file(folder / kFlowRecordFile, text_from_json(to_json(record), 2) + "\n");
}

FlowRecord read_flow_record(const fs::path& folder) {
    if (!fs::is_regular_file(folder / kFlowRecordFile))
        throw InvalidInput("'" + bare_name(folder) + "' has no " + kFlowRecordFile +
                           ", as cases of this version have: export it again");
    return flow_record_from(json_from_file(folder / kFlowRecordFile));
}

void require_recorded_mesh(const fs::path& folder, const FlowRecord& record) {
    if (mesh_digest(folder) != record.mesh)
        throw InvalidInput("'" + bare_name(folder) + "' holds another mesh than the one that it " +
                           "was exported with: export it again, and run it");
}

}  // namespace vesselbench
