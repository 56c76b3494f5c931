#include "tests/forest/truth.h"

#include <algorithm>
#include <array>

#include "tests/forest/ends.h"
#include "tests/forest/grow.h"

namespace vesselbench::forest {

namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Vec3& p) {
    return {p.x(), p.y(), p.z()};
}

Vec3 vec3_of(const Json& json) {
    return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

Json json_of(const Truth::TrueEnd& end) {
    return {{"branch", end.branch},
            {"kind", to_string(end.kind)},
            {"place_mm", json_of(end.place)},
            {"direction", json_of(end.direction)},
            {"rim_normal", end.rim_normal.isZero() ? Json() : json_of(end.rim_normal)},
            {"diameter_mm", 2.0 * end.radius},
            {"whole_to_mm", end.whole_to},
            {"inlet", end.inlet},
            {"openable", end.optional ? "optional" : "yes"},
            {"why", end.why}};
}

EndKind end_kind_from(const std::string& name) {
    for (const EndKind kind : {EndKind::Flat, EndKind::Oblique, EndKind::Ragged, EndKind::Furcation,
                               EndKind::Rounded, EndKind::Border})
        if (to_string(kind) == name) return kind;
    throw nlohmann::json::other_error::create(501, "unknown kind of end: " + name, nullptr);
}

Truth::TrueEnd end_from(const Json& json) {
    Truth::TrueEnd end;
    end.branch = json.at("branch");
    end.kind = end_kind_from(json.at("kind"));
    end.place = vec3_of(json.at("place_mm"));
    end.direction = vec3_of(json.at("direction"));
    if (!json.at("rim_normal").is_null()) end.rim_normal = vec3_of(json.at("rim_normal"));
    end.radius = 0.5 * json.at("diameter_mm").get<double>();
    end.whole_to = json.at("whole_to_mm");
    end.inlet = json.at("inlet");
    end.optional = json.at("openable") == "optional";
    end.why = json.at("why");
    return end;
}

Json json_of(const Truth::Branch& branch) {
    Json points = Json::array();
    for (const LinePoint& p : branch.line)
        points.push_back({p.at.x(), p.at.y(), p.at.z(), p.radius});
    return {{"end", branch.end ? Json(*branch.end) : Json()},
            {"length_mm", length_of(branch.line)},
            {"free_from_mm", branch.free_from},
            {"diameter_mm", branch.diameter()},
            {"resolved", branch.resolved},
            {"points_mm", points}};
}

Truth::Branch branch_from(const Json& json) {
    Truth::Branch branch;
    for (const Json& p : json.at("points_mm"))
        branch.line.push_back({vec3_of(p), p.at(3).get<double>()});
    if (!json.at("end").is_null()) branch.end = json.at("end").get<std::size_t>();
    branch.free_from = json.at("free_from_mm");
    branch.resolved = json.at("resolved");
    return branch;
}

/// STL, PLY, VTP, NRRD and MetaImage by turns.
std::string file_name(const Plan& plan) {
    static const std::array surfaces = {"surface.stl", "surface.ply", "surface.vtp"};
    static const std::array images = {"image.nrrd", "image.mha"};
    return is_image(plan.kind) ? images[plan.seed % images.size()]
                               : surfaces[plan.seed % surfaces.size()];
}

void add_branches(Truth& truth, const Tree& tree) {
    for (const Branch& branch : tree.branches) {
        if (branch.ghost) continue;
        Truth::Branch made{.line = part_of(branch.line, 0.0, branch.length),
                           .end = std::nullopt,
                           .free_from = branch.free_from,
                           .resolved = branch.resolved};
        if (branch.end) {
            made.end = truth.ends.size();
            Truth::TrueEnd end;
            static_cast<End&>(end) = *branch.end;
            end.branch = truth.branches.size();
            truth.ends.push_back(end);
        }
        truth.branches.push_back(std::move(made));
    }
}

}  // namespace

Truth truth_of(const Tree& tree, const Plan& plan) {
    Truth truth;
    truth.seed = plan.seed;
    truth.kind = to_string(plan.kind);
    truth.file = file_name(plan);
    if (!is_image(plan.kind)) truth.arguments = {"--units", "mm"};
    const Voxels voxels = voxels_for(plan, tree);
    truth.resolution = edge_for(plan, tree);
    if (is_image(plan.kind) || plan.kind == CaseKind::VoxelSurface)
        truth.resolution = 0.5 * Vec3(voxels.pixel, voxels.pixel, voxels.slice).norm();
    truth.genus = tree.loops;
    add_branches(truth, tree);
    truth.sacs = tree.sacs;
    truth.kisses = tree.kisses;
    truth.cfd = std::ranges::count(truth.ends, false, &Truth::TrueEnd::optional) >= 2;
    for (const auto& [name, present] :
         {std::pair{"loops", tree.loops > 0}, std::pair{"kisses", !tree.kisses.empty()},
          std::pair{"sacs", !tree.sacs.empty()}})
        if (present) truth.features += (truth.features.empty() ? "" : " ") + std::string(name);
    return truth;
}

Json to_json(const Truth& truth) {
    Json json = {{"seed", truth.seed},
                 {"kind", truth.kind},
                 {"features", truth.features},
                 {"file", truth.file},
                 {"unit", "mm"},
                 {"arguments", truth.arguments},
                 {"resolution_mm", truth.resolution},
                 {"genus", truth.genus},
                 {"expected", {{"cfd", truth.cfd}, {"rp", truth.rp}}}};
    for (const auto& end : truth.ends) json["ends"].push_back(json_of(end));
    for (const auto& branch : truth.branches) json["branches"].push_back(json_of(branch));
    json["sacs"] = json["kisses"] = Json::array();
    for (const Sac& sac : truth.sacs)
        json["sacs"].push_back({{"centre_mm", json_of(sac.centre)}, {"radius_mm", sac.radius}});
    for (const Kiss& kiss : truth.kisses)
        json["kisses"].push_back({{"place_mm", json_of(kiss.place)}, {"gap_mm", kiss.gap}});
    return json;
}

Truth truth_from(const Json& json) {
    Truth truth;
    truth.seed = json.at("seed");
    truth.kind = json.at("kind");
    truth.features = json.at("features");
    truth.file = json.at("file");
    truth.arguments = json.at("arguments").get<std::vector<std::string>>();
    truth.resolution = json.at("resolution_mm");
    truth.genus = json.at("genus");
    truth.cfd = json.at("expected").at("cfd");
    truth.rp = json.at("expected").at("rp");
    for (const Json& end : json.at("ends")) truth.ends.push_back(end_from(end));
    for (const Json& branch : json.at("branches")) truth.branches.push_back(branch_from(branch));
    for (const Json& sac : json.at("sacs"))
        truth.sacs.push_back({vec3_of(sac.at("centre_mm")), sac.at("radius_mm"), 0.0});
    for (const Json& kiss : json.at("kisses"))
        truth.kisses.push_back({0, 0, vec3_of(kiss.at("place_mm")), kiss.at("gap_mm")});
    return truth;
}

}  // namespace vesselbench::forest
