#include "workbench/phantoms/phantom_json.h"

#include <array>

#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/plain_name.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/json_fields.h"
#include "workbench/case/json_text.h"
#include "workbench/case/near_names.h"
#include "workbench/phantoms/builtin.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

void read_vector(JsonFields& node, const char* key, Vec3& value) {
    if (const auto numbers = node.optional<std::array<double, 3>>(key))
        value = Vec3((*numbers)[0], (*numbers)[1], (*numbers)[2]);
}

/// Three numbers, or one for all.
void read_along_axes(JsonFields& node, const char* key, Vec3& value) {
    const Json* field = node.child(key);
    if (field != nullptr && field->is_number())
        value = Vec3::Constant(json_value<double>(*field, node.place_of(key)));
    else
        read_vector(node, key, value);
}

/// Calls read(item, place) for each item of a list; nothing if there is none.
template <class Read>
void for_each_item(JsonFields& node, const char* key, Read read) {
    const Json* list = node.child(key);
    if (list == nullptr) return;
    const std::string place = node.place_of(key);
    if (!list->is_array()) refuse_json(*list, place, "a list");
    for (std::size_t i = 0; i < list->size(); ++i)
        read((*list)[i], place + "[" + std::to_string(i) + "]");
}

VesselShape vessel_from(const Json& json, const std::string& place) {
    JsonFields node(json, place);
    VesselShape vessel;
    std::vector<std::array<double, 4>> knots;
    node.read("points", knots);
    for (const auto& [x, y, z, radius] : knots) {
        vessel.points.emplace_back(x, y, z);
        vessel.radii.push_back(radius);
    }
    node.read("flat_ends", vessel.flat_ends);
    node.refuse_unknown_keys();
    return vessel;
}

SphereShape sphere_from(const Json& json, const std::string& place) {
    JsonFields node(json, place);
    SphereShape sphere;
    read_vector(node, "centre", sphere.centre);
    node.read("radius", sphere.radius);
    node.refuse_unknown_keys();
    return sphere;
}

BoxShape box_from(const Json& json, const std::string& place) {
    JsonFields node(json, place);
    BoxShape box;
    read_vector(node, "centre", box.centre);
    read_vector(node, "half_size", box.half_size);
    node.refuse_unknown_keys();
    return box;
}

TorusShape torus_from(const Json& json, const std::string& place) {
    JsonFields node(json, place);
    TorusShape torus;
    read_vector(node, "centre", torus.centre);
    read_vector(node, "axis", torus.axis);
    node.read("ring_radius", torus.ring_radius);
    node.read("tube_radius", torus.tube_radius);
    node.refuse_unknown_keys();
    return torus;
}

PhantomPart part_from(const Json& json, const std::string& place) {
    JsonFields node(json, place);
    PhantomPart part;
    node.read("name", part.name);
    node.read("blend", part.blend);
    int shapes = 0;
    const auto take = [&](const char* key, auto read) {
        if (const Json* child = node.child(key)) {
            part.shape = read(*child, place + "." + key);
            ++shapes;
        }
    };
    take("vessel", vessel_from);
    take("sphere", sphere_from);
    take("box", box_from);
    take("torus", torus_from);
    if (shapes != 1) throw InvalidInput(place + " needs one of vessel, sphere, box, torus");
    node.refuse_unknown_keys();
    return part;
}

std::vector<PhantomPart> parts_from(JsonFields& node, const char* key) {
    std::vector<PhantomPart> parts;
    for_each_item(node, key, [&](const Json& part, const std::string& place) {
        parts.push_back(part_from(part, place));
    });
    return parts;
}

Deletion deletion_from(const Json& json, const std::string& place) {
    JsonFields node(json, place);
    Deletion deletion;
    node.read("from", deletion.from);
    node.read("to", deletion.to);
    node.refuse_unknown_keys();
    return deletion;
}

KeptApart kept_apart_from(const Json& json, const std::string& place) {
    JsonFields node(json, place);
    KeptApart pair;
    node.read("first", pair.first);
    node.read("second", pair.second);
    node.read("gap", pair.gap);
    node.refuse_unknown_keys();
    return pair;
}

ContrastDip dip_from(const Json& json, const std::string& place) {
    JsonFields node(json, place);
    ContrastDip dip;
    node.read("part", dip.part);
    read_vector(node, "centre", dip.centre);
    node.read("reach", dip.reach);
    node.read("core", dip.core);
    node.read("wall", dip.wall);
    node.refuse_unknown_keys();
    return dip;
}

PhantomImaging imaging_from(const Json& json, const std::string& place) {
    JsonFields node(json, place);
    PhantomImaging imaging;
    read_vector(node, "spacing", imaging.spacing);
    imaging.size = node.optional<std::array<int, 3>>("size");
    node.read("margin", imaging.margin);
    node.read("inside", imaging.inside);
    node.read("outside", imaging.outside);
    read_along_axes(node, "blur", imaging.blur);
    node.read("noise", imaging.noise);
    node.read("inhomogeneity", imaging.inhomogeneity);
    node.read("mask_slice_step", imaging.mask_slice_step);
    node.read("mask_jitter", imaging.mask_jitter);
    for_each_item(node, "deletions", [&](const Json& item, const std::string& at) {
        imaging.deletions.push_back(deletion_from(item, at));
    });
    for_each_item(node, "dips", [&](const Json& item, const std::string& at) {
        imaging.dips.push_back(dip_from(item, at));
    });
    for_each_item(node, "kept_apart", [&](const Json& item, const std::string& at) {
        imaging.kept_apart.push_back(kept_apart_from(item, at));
    });
    node.refuse_unknown_keys();
    return imaging;
}

PhantomDescription description_from(const Json& json) {
    JsonFields node(json, "phantom");
    PhantomDescription description;
    std::string about;
    node.read("name", description.name);
    node.read("about", about);
    node.read("seed", description.seed);
    node.read("surface_edge", description.surface_edge);
    node.read("surface_noise", description.surface_noise);
    description.parts = parts_from(node, "parts");
    description.neighbours = parts_from(node, "neighbours");
    if (const Json* imaging = node.child("imaging"))
        description.imaging = imaging_from(*imaging, node.place_of("imaging"));
    node.refuse_unknown_keys();
    if (!description.name.empty()) require_plain_name(description.name, "the phantom");
    for (const PhantomPart& part : description.neighbours)  // files are called after both
        if (!part.name.empty()) require_plain_name(part.name, "a neighbour of the phantom");
    return description;
}

}  // namespace

PhantomDescription phantom_from_json(const std::string& text) {
    return description_from(json_from_text(text, "the phantom's description"));
}

std::vector<std::string> phantom_names() {
    std::vector<std::string> names;
    for (const auto& [name, text] : builtin_phantom_texts()) names.push_back(name);
    return names;
}

PhantomDescription phantom_named(const std::string& name) {
    if (name.ends_with(".json")) return description_from(json_from_file(name));
    return builtin_phantom(name);
}

PhantomDescription builtin_phantom(const std::string& name) {
    const auto& texts = builtin_phantom_texts();
    if (const auto found = texts.find(name); found != texts.end())
        return phantom_from_json(found->second);
    const std::vector<std::string> names = phantom_names();
    throw UsageError("there is no phantom '" + name + "'" + did_you_mean(name, names) +
                     " (the phantoms are " + joined(names) + ")");
}

}  // namespace vesselbench
