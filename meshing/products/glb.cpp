#include "meshing/products/glb.h"

#include <bit>
#include <cmath>

#include <nlohmann/json.hpp>

#include "geometry/formats/comment_line.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/plain_name.h"
#include "geometry/kernel/whole_file.h"
#include "meshing/products/text_buffer.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kFloat = 5126, kUnsignedInt = 5125, kUnsignedShort = 5123;
constexpr int kArrayBuffer = 34962, kElementBuffer = 34963;
constexpr std::size_t kModel = 0, kVessel = 1;  ///< nodes

using Rgba = std::array<double, 4>;

/// Of neighbours, one after the other, apart for any colour vision (hues of Okabe and Ito); seen
/// through, as the vessel matters. Linear values, as GLB asks for, of NEIGHBOURS in
/// workbench/review/page/src/colours.js: a structure has one colour in a GLB file and on a page.
constexpr std::array<Rgba, 6> kNeighbourColours = {{{0.275, 0.275, 0.527, 0.4},
                                                    {0.665, 0.112, 0.000, 0.4},
                                                    {0.000, 0.342, 0.171, 0.4},
                                                    {0.604, 0.191, 0.386, 0.4},
                                                    {0.093, 0.456, 0.815, 0.4},
                                                    {0.871, 0.776, 0.054, 0.4}}};

Rgba colour_of(PatchKind kind) {
    switch (kind) {
        case PatchKind::Inlet:
            return {0.20, 0.45, 0.85, 1.0};
        case PatchKind::Outlet:
            return {0.25, 0.65, 0.35, 1.0};
        case PatchKind::Cut:
            return {0.60, 0.60, 0.60, 1.0};
        case PatchKind::Wall:
            break;
    }
    return {0.80, 0.25, 0.22, 1.0};
}

void put32(std::string& out, std::uint32_t value) {
    const auto bytes = std::bit_cast<std::array<char, 4>>(value);
    out.append(bytes.data(), bytes.size());
}

void put16(std::string& out, std::uint16_t value) {
    const auto bytes = std::bit_cast<std::array<char, 2>>(value);
    out.append(bytes.data(), bytes.size());
}

std::uint16_t rounded_share(float share) {
    return static_cast<std::uint16_t>(std::lround(std::clamp(share, 0.0F, 1.0F) * 65535.0F));
}

Bounds box_of(const GlbModel& model) {
    Positions corners;
    const auto add = [&](const Surface& surface) {
        const Bounds box = bounds(surface);
        corners.insert(corners.end(), {box.min, box.max});
    };
    add(model.surface);
    for (const auto& [name, neighbour] : model.neighbours) add(neighbour);
    return bounds(corners);
}

Json point_of(const Vec3& p) {
    return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
}

Json legend_of(const GlbColours& colours) {
    Json map = Json::array();
    for (const auto& colour : colours.map) map.push_back(colour);
    return {{"name", colours.name},   {"label", colours.label}, {"unit", colours.unit},
            {"least", colours.least}, {"most", colours.most},   {"colours", map}};
}

class GlbBuilder {
public:
    /// \throw Cancelled
    GlbBuilder(const GlbModel& model, const LoopProgress& rows)
        : rows_(rows), centre_(box_of(model).centre()) {
        document_ = {{"asset", {{"version", "2.0"}, {"generator", "vesselbench"}}},
                     {"scene", 0},
                     {"scenes", {{{"nodes", {kModel}}}}}};
        document_["nodes"] = {{{"name", "model"},
                               {"children", {kVessel}},
                               {"scale", {1e-3, 1e-3, 1e-3}},
                               {"rotation", {-0.70710678, 0.0, 0.0, 0.70710678}},
                               {"extras", {{"centre_mm", point_of(centre_)}}}},
                              {{"name", "vessel"}, {"children", Json::array()}}};
        if (!model.provenance.empty())
            document_["asset"]["extras"] = {{"provenance", comment_line(model.provenance)}};
        add_vessel(model);
        if (!model.neighbours.empty()) add_neighbours(model.neighbours);
        document_["buffers"] = {{{"byteLength", data_.size()}}};
    }

    [[nodiscard]] std::string bytes() const {
        std::string json = document_.dump();
        json.resize((json.size() + 3) / 4 * 4, ' ');
        std::string out;
        for (const auto word : {std::uint32_t{0x46546C67}, std::uint32_t{2},
                                static_cast<std::uint32_t>(28 + json.size() + data_.size()),
                                static_cast<std::uint32_t>(json.size()), std::uint32_t{0x4E4F534A}})
            put32(out, word);
        out += json;
        put32(out, static_cast<std::uint32_t>(data_.size()));
        put32(out, 0x004E4942);
        return out + data_;
    }

private:
    /// Of what is in the buffer from `start` on.
    std::size_t add_accessor(std::size_t start, int target, Json accessor) {
        document_["bufferViews"].push_back({{"buffer", 0},
                                            {"byteOffset", start},
                                            {"byteLength", data_.size() - start},
                                            {"target", target}});
        accessor["bufferView"] = document_["bufferViews"].size() - 1;
        document_["accessors"].push_back(std::move(accessor));
        return document_["accessors"].size() - 1;
    }

    std::size_t add_vectors(const Positions& values, Json accessor) {
        const std::size_t start = data_.size();
        for (const Vec3& v : values) {
            rows_.step();
            for (int k = 0; k < 3; ++k)
                put32(data_, std::bit_cast<std::uint32_t>(static_cast<float>(v[k])));
        }
        accessor.update({{"componentType", kFloat}, {"count", values.size()}, {"type", "VEC3"}});
        return add_accessor(start, kArrayBuffer, std::move(accessor));
    }

    /// Attributes of a surface's primitives.
    Json add_vertices(const Surface& surface) {
        Positions centred = surface.points();
        for (Vec3& p : centred) p -= centre_;
        const Bounds box = bounds(surface);
        const Json range = {{"min", point_of(box.min - centre_)},
                            {"max", point_of(box.max - centre_)}};
        Json attributes = {{"POSITION", add_vectors(centred, range)}};
        attributes["NORMAL"] = add_vectors(vertex_normals(surface), Json::object());
        return attributes;
    }

    std::size_t add_colours(const std::vector<std::array<float, 3>>& colours) {
        const std::size_t start = data_.size();
        for (const auto& colour : colours) {
            for (const float share : colour) put16(data_, rounded_share(share));
            put16(data_, rounded_share(1.0F));  // elements begin at multiples of four bytes
        }
        return add_accessor(start, kArrayBuffer,
                            {{"componentType", kUnsignedShort},
                             {"normalized", true},
                             {"count", colours.size()},
                             {"type", "VEC4"}});
    }

    std::size_t add_material(const std::string& name, const Rgba& colour) {
        Json material = {
            {"name", name},
            {"pbrMetallicRoughness",
             {{"baseColorFactor", colour}, {"metallicFactor", 0.0}, {"roughnessFactor", 0.6}}},
            {"doubleSided", true}};
        if (colour[3] < 1.0) material["alphaMode"] = "BLEND";
        document_["materials"].push_back(std::move(material));
        return document_["materials"].size() - 1;
    }

    /// A node with triangles, below another one. \return its number; none: there are no triangles
    template <class Belongs>
    std::optional<std::size_t> add_part(std::size_t parent, const std::string& name,
                                        const Surface& surface, const Belongs& belongs,
                                        const Json& attributes, const Rgba& colour) {
        const std::size_t start = data_.size();
        for (TriangleId t = 0; t < surface.triangle_count(); ++t) {
            rows_.step();
            if (belongs(t))
                for (const VertexId v : surface.triangles()[t]) put32(data_, v);
        }
        const std::size_t corners = (data_.size() - start) / 4;
        if (corners == 0) return std::nullopt;
        const std::size_t indices =
            add_accessor(start, kElementBuffer,
                         {{"componentType", kUnsignedInt}, {"count", corners}, {"type", "SCALAR"}});
        document_["meshes"].push_back({{"name", name},
                                       {"primitives",
                                        {{{"attributes", attributes},
                                          {"indices", indices},
                                          {"material", add_material(name, colour)}}}}});
        const std::size_t node = document_["nodes"].size();
        document_["nodes"].push_back({{"name", name}, {"mesh", document_["meshes"].size() - 1}});
        document_["nodes"][parent]["children"].push_back(node);
        return node;
    }

    void add_vessel(const GlbModel& model) {
        const Surface& surface = model.surface;
        const Json attributes = add_vertices(surface);
        Json coloured = attributes;
        if (model.colours) coloured["COLOR_0"] = add_colours(model.colours->vertices);
        for (std::size_t k = 0; k < surface.patches.size(); ++k) {
            const Patch& patch = surface.patches[k];
            const bool measured = model.colours && patch.kind == PatchKind::Wall;
            const auto belongs = [&](TriangleId t) { return (*surface.patch_labels)[t] == k; };
            const auto node =
                add_part(kVessel, patch.name, surface, belongs, measured ? coloured : attributes,
                         measured ? Rgba{1.0, 1.0, 1.0, 1.0} : colour_of(patch.kind));
            if (node && measured) document_["nodes"][*node]["extras"] = legend_of(*model.colours);
        }
    }

    void add_neighbours(const std::map<std::string, Surface>& neighbours) {
        const std::size_t group = document_["nodes"].size();
        document_["nodes"].push_back({{"name", "neighbours"}, {"children", Json::array()}});
        document_["nodes"][kModel]["children"].push_back(group);
        std::size_t number = 0;
        for (const auto& [name, surface] : neighbours)
            add_part(
                group, name, surface, [](TriangleId) { return true; }, add_vertices(surface),
                kNeighbourColours[number++ % kNeighbourColours.size()]);
    }

    LoopProgress rows_;
    Vec3 centre_;
    Json document_;
    std::string data_;
};

std::size_t rows_of(const GlbModel& model) {
    const auto of = [](const Surface& surface, std::size_t parts) {
        return 2 * surface.vertex_count() + parts * surface.triangle_count();
    };
    std::size_t rows = of(model.surface, model.surface.patches.size());
    for (const auto& [name, surface] : model.neighbours) rows += of(surface, 1);
    return rows;
}

}  // namespace

void write_glb(const GlbModel& model, const std::string& path, const Progress& progress) {
    if (model.surface.empty()) throw InvalidInput("GLB: the surface has no triangles");
    if (model.colours && model.colours->vertices.size() != model.surface.vertex_count())
        throw InvalidInput("GLB: " + std::to_string(model.colours->vertices.size()) +
                           " colours for " + std::to_string(model.surface.vertex_count()) +
                           " vertices");
    require_plain_names(model.surface.patches);
    GlbModel shown = model;
    std::erase_if(shown.neighbours, [](const auto& entry) { return entry.second.empty(); });
    const LoopProgress rows(progress, rows_of(shown), writing_text(path));
    write_file(path, GlbBuilder(shown, rows).bytes(), progress);
}

}  // namespace vesselbench
