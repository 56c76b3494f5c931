#include "meshing/products/glb.h"

#include <array>
#include <bit>

#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/plain_name.h"
#include "geometry/kernel/whole_file.h"
#include "meshing/products/text_buffer.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kFloat = 5126, kUnsignedInt = 5125, kArrayBuffer = 34962, kElementBuffer = 34963;

void put32(std::string& out, std::uint32_t value) {
    const auto bytes = std::bit_cast<std::array<char, 4>>(value);
    out.append(bytes.data(), bytes.size());
}

std::array<double, 4> colour_of(PatchKind kind) {
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

class GlbBuilder {
public:
    /// \throw Cancelled
    GlbBuilder(const Surface& surface, const LoopProgress& rows) : surface_(surface), rows_(rows) {
        document_ = {{"asset", {{"version", "2.0"}, {"generator", "vesselbench"}}},
                     {"scene", 0},
                     {"scenes", {{{"nodes", {0}}}}},
                     {"nodes",
                      {{{"name", "vessel"},
                        {"mesh", 0},
                        {"scale", {1e-3, 1e-3, 1e-3}},
                        {"rotation", {-0.70710678, 0.0, 0.0, 0.70710678}}}}}};
        add_vertices();
        for (std::size_t k = 0; k < surface.patches.size(); ++k) add_patch(k);
        document_["meshes"] = {{{"name", "vessel"}, {"primitives", parts_}}};
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
    void add_vectors(const Positions& values) {
        for (const Vec3& v : values) {
            rows_.step();
            for (int k = 0; k < 3; ++k)
                put32(data_, std::bit_cast<std::uint32_t>(static_cast<float>(v[k])));
        }
    }

    void add_view(std::size_t start, int target) {
        document_["bufferViews"].push_back({{"buffer", 0},
                                            {"byteOffset", start},
                                            {"byteLength", data_.size() - start},
                                            {"target", target}});
    }

    void add_vertices() {
        const Bounds box = bounds(surface_);
        const Vec3 half = 0.5 * (box.max - box.min);
        Positions centred = surface_.points();
        for (Vec3& p : centred) p -= box.centre();
        add_vectors(centred);
        add_view(0, kArrayBuffer);
        const std::size_t normals = data_.size();
        add_vectors(vertex_normals(surface_));
        add_view(normals, kArrayBuffer);
        const auto corner = [&](double sign) {
            return Json{static_cast<float>(sign * half.x()), static_cast<float>(sign * half.y()),
                        static_cast<float>(sign * half.z())};
        };
        document_["accessors"] = {{{"bufferView", 0},
                                   {"componentType", kFloat},
                                   {"count", centred.size()},
                                   {"type", "VEC3"},
                                   {"min", corner(-1.0)},
                                   {"max", corner(1.0)}},
                                  {{"bufferView", 1},
                                   {"componentType", kFloat},
                                   {"count", centred.size()},
                                   {"type", "VEC3"}}};
    }

    void add_patch(std::size_t patch) {
        const std::size_t start = data_.size();
        for (TriangleId t = 0; t < surface_.triangle_count(); ++t) {
            rows_.step();
            if ((*surface_.patch_labels)[t] == patch)
                for (const VertexId v : surface_.triangles()[t]) put32(data_, v);
        }
        if (data_.size() == start) return;
        add_view(start, kElementBuffer);
        document_["accessors"].push_back({{"bufferView", document_["bufferViews"].size() - 1},
                                          {"componentType", kUnsignedInt},
                                          {"count", (data_.size() - start) / 4},
                                          {"type", "SCALAR"}});
        document_["materials"].push_back(
            {{"name", surface_.patches[patch].name},
             {"pbrMetallicRoughness",
              {{"baseColorFactor", colour_of(surface_.patches[patch].kind)},
               {"metallicFactor", 0.0},
               {"roughnessFactor", 0.6}}}});
        parts_.push_back({{"attributes", {{"POSITION", 0}, {"NORMAL", 1}}},
                          {"indices", document_["accessors"].size() - 1},
                          {"material", document_["materials"].size() - 1}});
    }

    const Surface& surface_;
    LoopProgress rows_;
    Json document_;
    Json parts_ = Json::array();
    std::string data_;
};

}  // namespace

void write_glb(const Surface& surface, const std::string& path, const Progress& progress) {
    if (surface.empty()) throw InvalidInput("GLB: the surface has no triangles");
    require_plain_names(surface.patches);
    const LoopProgress rows(
        progress, 2 * surface.vertex_count() + surface.patches.size() * surface.triangle_count(),
        writing_text(path));
    write_file(path, GlbBuilder(surface, rows).bytes(), progress);
}

}  // namespace vesselbench
