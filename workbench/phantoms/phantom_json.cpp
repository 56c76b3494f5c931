#include "workbench/phantoms/phantom_json.h"

#include <algorithm>
#include <utility>

#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/whole_file.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/near_names.h"
#include "workbench/phantoms/builtin.h"

namespace vesselbench {

namespace {

using Json = nlohmann::json;

/// An object of the description that knows its place in it, for error texts, and rejects unknown
/// keys.
class Node {
public:
    Node(const Json& json, std::string place) : json_(json), place_(std::move(place)) {
        if (!json_.is_object()) throw InvalidInput(place_ + " must be an object");
    }

    template <class T>
    void read(const char* key, T& value) {
        known_.emplace_back(key);
        if (!json_.contains(key)) return;
        try {
            value = json_.at(key).get<T>();
        } catch (const Json::exception&) {
            throw InvalidInput(place_ + "." + key + " has the wrong type: " + json_.at(key).dump());
        }
    }

    void read_vector(const char* key, Vec3& value) {
        std::vector<double> numbers = {value.x(), value.y(), value.z()};
        read(key, numbers);
        if (numbers.size() != 3) throw InvalidInput(place_ + "." + key + " needs three numbers");
        value = Vec3(numbers[0], numbers[1], numbers[2]);
    }

    /// Three numbers, or one for all.
    void read_along_axes(const char* key, Vec3& value) {
        if (!json_.contains(key) || !json_.at(key).is_number()) return read_vector(key, value);
        double number = 0.0;
        read(key, number);
        value = Vec3::Constant(number);
    }

    [[nodiscard]] const Json* child(const char* key) {
        known_.emplace_back(key);
        return json_.contains(key) ? &json_.at(key) : nullptr;
    }

    void refuse_unknown_keys() const {
        for (const auto& item : json_.items())
            if (std::find(known_.begin(), known_.end(), item.key()) == known_.end())
                throw InvalidInput(place_ + " has an unknown key '" + item.key() + "'");
    }

    [[nodiscard]] const std::string& place() const { return place_; }

private:
    const Json& json_;
    std::string place_;
    std::vector<std::string> known_;
};

VesselShape vessel_from(const Json& json, const std::string& place) {
    Node node(json, place);
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
    Node node(json, place);
    SphereShape sphere;
    node.read_vector("centre", sphere.centre);
    node.read("radius", sphere.radius);
    node.refuse_unknown_keys();
    return sphere;
}

BoxShape box_from(const Json& json, const std::string& place) {
    Node node(json, place);
    BoxShape box;
    node.read_vector("centre", box.centre);
    node.read_vector("half_size", box.half_size);
    node.refuse_unknown_keys();
    return box;
}

TorusShape torus_from(const Json& json, const std::string& place) {
    Node node(json, place);
    TorusShape torus;
    node.read_vector("centre", torus.centre);
    node.read_vector("axis", torus.axis);
    node.read("ring_radius", torus.ring_radius);
    node.read("tube_radius", torus.tube_radius);
    node.refuse_unknown_keys();
    return torus;
}

PhantomPart part_from(const Json& json, const std::string& place) {
    Node node(json, place);
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

std::vector<PhantomPart> parts_from(const Json* json, const std::string& place) {
    std::vector<PhantomPart> parts;
    if (json == nullptr) return parts;
    for (const Json& part : *json)
        parts.push_back(part_from(part, place + "[" + std::to_string(parts.size()) + "]"));
    return parts;
}

PhantomImaging imaging_from(const Json& json) {
    Node node(json, "imaging");
    PhantomImaging imaging;
    node.read_vector("spacing", imaging.spacing);
    if (const Json* size = node.child("size")) imaging.size = size->get<std::array<int, 3>>();
    node.read("margin", imaging.margin);
    node.read("inside", imaging.inside);
    node.read("outside", imaging.outside);
    node.read_along_axes("blur", imaging.blur);
    node.read("noise", imaging.noise);
    node.read("inhomogeneity", imaging.inhomogeneity);
    node.read("mask_slice_step", imaging.mask_slice_step);
    node.read("mask_jitter", imaging.mask_jitter);
    if (const Json* list = node.child("deletions"))
        for (const Json& item : *list) {
            Node deletion(item, "imaging.deletions");
            Deletion& added = imaging.deletions.emplace_back();
            deletion.read("from", added.from);
            deletion.read("to", added.to);
            deletion.refuse_unknown_keys();
        }
    if (const Json* list = node.child("kept_apart"))
        for (const Json& item : *list) {
            Node pair(item, "imaging.kept_apart");
            KeptApart& added = imaging.kept_apart.emplace_back();
            pair.read("first", added.first);
            pair.read("second", added.second);
            pair.read("gap", added.gap);
            pair.refuse_unknown_keys();
        }
    node.refuse_unknown_keys();
    return imaging;
}

PhantomDescription description_from(const Json& json) {
    Node node(json, "phantom");
    PhantomDescription description;
    std::string about;
    node.read("name", description.name);
    node.read("about", about);
    node.read("seed", description.seed);
    node.read("surface_edge", description.surface_edge);
    node.read("surface_noise", description.surface_noise);
    description.parts = parts_from(node.child("parts"), "parts");
    description.neighbours = parts_from(node.child("neighbours"), "neighbours");
    if (const Json* imaging = node.child("imaging")) description.imaging = imaging_from(*imaging);
    node.refuse_unknown_keys();
    return description;
}

}  // namespace

PhantomDescription phantom_from_json(const std::string& text) {
    try {
        return description_from(Json::parse(text));
    } catch (const Json::exception& error) {
        throw InvalidInput(std::string("the phantom's description cannot be used: ") +
                           error.what());
    }
}

std::vector<std::string> phantom_names() {
    std::vector<std::string> names;
    for (const auto& [name, text] : builtin_phantom_texts()) names.push_back(name);
    return names;
}

PhantomDescription phantom_named(const std::string& name) {
    if (name.ends_with(".json")) return phantom_from_json(file_content(name));
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
