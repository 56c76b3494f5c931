#include "workbench/project/serialization.h"

#include <algorithm>
#include <map>
#include <utility>

#include "geometry/kernel/plain_name.h"

namespace vesselbench {

namespace {

/// A scene without names of segments is written as version 1, whose bytes stay what they were.
constexpr std::uint8_t kWithoutSegments = 1, kManifestVersion = 2;
constexpr std::uint32_t kNone = ~std::uint32_t{0};

/// Lists parts and gives their indices.
class PartList {
public:
    template <class T>
    std::uint32_t index_of(const std::shared_ptr<const T>& part) {
        if (!part) return kNone;
        parts_.emplace_back(part);
        return static_cast<std::uint32_t>(parts_.size() - 1);
    }

    std::vector<ScenePart> take() { return std::move(parts_); }

private:
    std::vector<ScenePart> parts_;
};

void put_surface(ByteWriter& writer, PartList& list, const Surface& surface) {
    writer.put(list.index_of(surface.topology));
    writer.put(list.index_of(surface.positions));
    writer.put(list.index_of(surface.patch_labels));
    writer.put<std::uint64_t>(surface.patches.size());
    for (const Patch& patch : surface.patches) {
        writer.put_text(patch.name);
        writer.put(patch.kind);
    }
    writer.put<std::uint64_t>(surface.attributes.size());
    for (const auto& [name, values] : surface.attributes) {
        writer.put_text(name);
        writer.put(list.index_of(values));
    }
}

void put_image(ByteWriter& writer, PartList& list, const Image& image) {
    writer.put(image.size);
    for (int i = 0; i < 16; ++i) writer.put(image.index_to_patient.data()[i]);
    writer.put(list.index_of(image.voxels));
}

void put_sampling(ByteWriter& writer, const Sampling& sampling) {
    for (int i = 0; i < 9; ++i) writer.put(sampling.axes.data()[i]);
    for (int i = 0; i < 3; ++i) writer.put(sampling.spacing[i]);
    writer.put(sampling.confidence);
}

void put_segmentation(ByteWriter& writer, const Segmentation& segmentation) {
    writer.put<std::uint64_t>(segmentation.segments.size());
    for (const Segment& segment : segmentation.segments) {
        writer.put<std::int32_t>(segment.label);
        writer.put_text(segment.name);
        writer.put<bool>(segment.colour.has_value());
        if (segment.colour) writer.put(*segment.colour);
    }
    writer.put<std::uint64_t>(segmentation.vessel.size());
    for (const int label : segmentation.vessel) writer.put<std::int32_t>(label);
}

template <class T>
std::shared_ptr<const T> part_at(const std::vector<ScenePart>& parts, std::uint32_t index) {
    if (index == kNone) return nullptr;
    if (index >= parts.size() || !std::holds_alternative<std::shared_ptr<const T>>(parts[index]))
        throw InvalidInput("the stored scene refers to a missing part");
    return std::get<std::shared_ptr<const T>>(parts[index]);
}

PatchKind get_patch_kind(ByteReader& reader) {
    const auto kind = reader.get<std::uint8_t>();
    if (kind > static_cast<std::uint8_t>(PatchKind::Cut))
        throw InvalidInput("the stored scene has an unknown kind of patch");
    return static_cast<PatchKind>(kind);
}

std::string get_name(ByteReader& reader) {
    std::string name = reader.get_text();
    require_plain_name(name, "something in the stored scene");
    return name;
}

void check_surface(const Surface& surface) {
    if (!surface.topology && !surface.positions) return;
    if (!surface.topology || !surface.positions || !surface.patch_labels)
        throw InvalidInput("the stored surface is incomplete");
    bool fits = surface.positions->size() == surface.vertex_count() &&
                surface.patch_labels->size() == surface.triangle_count() &&
                std::all_of(surface.patch_labels->begin(), surface.patch_labels->end(),
                            [&](auto label) { return label < surface.patches.size(); });
    for (const auto& [name, values] : surface.attributes)
        fits = fits && values && values->size() == surface.vertex_count();
    if (!fits) throw InvalidInput("the stored surface's arrays are inconsistent");
}

Surface get_surface(ByteReader& reader, const std::vector<ScenePart>& parts) {
    Surface surface;
    surface.topology = part_at<Topology>(parts, reader.get<std::uint32_t>());
    surface.positions = part_at<Positions>(parts, reader.get<std::uint32_t>());
    surface.patch_labels = part_at<PatchLabels>(parts, reader.get<std::uint32_t>());
    surface.patches.clear();
    for (auto left = reader.get<std::uint64_t>(); left > 0; --left) {
        std::string name = get_name(reader);
        surface.patches.push_back({std::move(name), get_patch_kind(reader)});
    }
    for (auto left = reader.get<std::uint64_t>(); left > 0; --left) {
        const std::string name = get_name(reader);
        surface.attributes[name] = part_at<std::vector<double>>(parts, reader.get<std::uint32_t>());
    }
    check_surface(surface);
    return surface;
}

Image get_image(ByteReader& reader, const std::vector<ScenePart>& parts) {
    Image image;
    image.size = reader.get<std::array<int, 3>>();
    for (int i = 0; i < 16; ++i) image.index_to_patient.data()[i] = reader.get<double>();
    image.voxels = part_at<std::vector<float>>(parts, reader.get<std::uint32_t>());
    if (std::any_of(image.size.begin(), image.size.end(), [](int n) { return n < 0; }) ||
        image.voxel_count() != (image.voxels ? image.voxels->size() : 0))
        throw InvalidInput("the stored image's size does not match its voxels");
    return image;
}

Sampling get_sampling(ByteReader& reader) {
    Sampling sampling;
    for (int i = 0; i < 9; ++i) sampling.axes.data()[i] = reader.get<double>();
    for (int i = 0; i < 3; ++i) sampling.spacing[i] = reader.get<double>();
    sampling.confidence = reader.get<double>();
    return sampling;
}

Segmentation get_segmentation(ByteReader& reader) {
    Segmentation segmentation;
    for (auto left = reader.get<std::uint64_t>(); left > 0; --left) {
        Segment segment{.label = reader.get<std::int32_t>(), .name = reader.get_text()};
        if (reader.get<std::uint8_t>() != 0)
            segment.colour = reader.get<std::array<std::uint8_t, 3>>();
        segmentation.segments.push_back(std::move(segment));
    }
    for (auto left = reader.get<std::uint64_t>(); left > 0; --left)
        segmentation.vessel.push_back(reader.get<std::int32_t>());
    return segmentation;
}

std::map<const void*, std::uint32_t> places_of(const std::vector<ScenePart>& parts) {
    std::map<const void*, std::uint32_t> places;
    for (std::uint32_t i = 0; i < parts.size(); ++i) places.try_emplace(identity(parts[i]), i);
    return places;
}

}  // namespace

SceneParts take_apart(const Scene& scene) {
    PartList list;
    ByteWriter writer;
    const bool segmented = !scene.segmentation.empty();
    writer.put(segmented ? kManifestVersion : kWithoutSegments);
    writer.put<bool>(scene.surface.has_value());
    if (scene.surface) put_surface(writer, list, *scene.surface);
    writer.put<bool>(scene.image.has_value());
    if (scene.image) put_image(writer, list, *scene.image);
    writer.put<bool>(scene.mask.has_value());
    if (scene.mask) put_image(writer, list, *scene.mask);
    writer.put<bool>(scene.sampling.has_value());
    if (scene.sampling) put_sampling(writer, *scene.sampling);
    writer.put<std::uint64_t>(scene.neighbours.size());
    for (const auto& [name, surface] : scene.neighbours) {
        writer.put_text(name);
        put_surface(writer, list, surface);
    }
    writer.put(list.index_of(scene.volume_mesh));
    if (segmented) put_segmentation(writer, scene.segmentation);
    return {writer.take(), list.take()};
}

Scene put_together(std::span<const std::byte> manifest, const std::vector<ScenePart>& parts) {
    ByteReader reader(manifest);
    const auto version = reader.get<std::uint8_t>();
    if (version < kWithoutSegments || version > kManifestVersion)
        throw InvalidInput("the stored scene has version " + std::to_string(version) +
                           "; this program reads up to version " +
                           std::to_string(kManifestVersion));
    Scene scene;
    if (reader.get<std::uint8_t>() != 0) scene.surface = get_surface(reader, parts);
    if (reader.get<std::uint8_t>() != 0) scene.image = get_image(reader, parts);
    if (reader.get<std::uint8_t>() != 0) scene.mask = get_image(reader, parts);
    if (reader.get<std::uint8_t>() != 0) scene.sampling = get_sampling(reader);
    for (auto left = reader.get<std::uint64_t>(); left > 0; --left) {
        const std::string name = get_name(reader);
        scene.neighbours[name] = get_surface(reader, parts);
    }
    scene.volume_mesh = part_at<VolumeMesh>(parts, reader.get<std::uint32_t>());
    if (version == kManifestVersion) scene.segmentation = get_segmentation(reader);
    return scene;
}

void write_scene(const Scene& scene, const std::vector<ScenePart>& known, const ByteSink& sink) {
    const SceneParts taken = take_apart(scene);
    const auto put = [&](const auto& number) { sink(std::as_bytes(std::span(&number, 1))); };
    auto places = places_of(known);
    put(std::uint64_t{taken.manifest.size()});
    sink(taken.manifest);
    put(std::uint64_t{taken.parts.size()});
    auto next = static_cast<std::uint32_t>(known.size());
    for (const ScenePart& part : taken.parts) {
        const auto [place, fresh] = places.try_emplace(identity(part), next);
        put(fresh ? kNone : place->second);
        if (!fresh) continue;
        ++next;
        write_sized(part, sink);
    }
}

Bytes encode_scene(const Scene& scene, const std::vector<ScenePart>& known) {
    ByteWriter writer;
    write_scene(scene, known, [&](std::span<const std::byte> bytes) { writer.append(bytes); });
    return writer.take();
}

Scene decode_scene(std::span<const std::byte> blob, const std::vector<ScenePart>& known,
                   const Progress& progress) {
    ByteReader reader(blob);
    const auto manifest = reader.get_bytes(reader.get<std::uint64_t>());
    std::vector<ScenePart> have = known, parts;
    for (auto left = reader.get<std::uint64_t>(); left > 0; --left) {
        auto place = reader.get<std::uint32_t>();
        if (place == kNone) {
            progress.check_cancelled();
            place = static_cast<std::uint32_t>(have.size());
            have.push_back(PartDecoder(reader.get_bytes(reader.get<std::uint64_t>())).finish());
        }
        if (place >= have.size()) throw InvalidInput("the stored scene refers to a missing part");
        parts.push_back(have[place]);
    }
    return put_together(manifest, parts);
}

}  // namespace vesselbench
