#include "workbench/project/part_codec.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "geometry/kernel/plain_name.h"
#include "workbench/project/compression.h"
#include "workbench/project/content_hash.h"

namespace vesselbench {

namespace {

constexpr std::uint16_t kMagic = 0x4256;  // "VB"
/// Volume meshes with layers have the second: earlier programs would read them without. All other
/// parts keep their bytes.
constexpr std::uint8_t kVersion = 1, kLayersVersion = 2;

// Kinds of parts; their numbers are in the file.
constexpr std::uint8_t kTopology = 0, kPositions = 1, kLabels = 2, kReals = 3, kVoxels = 4,
                       kVolumeMesh = 5;

/// Memory layout of a kind's elements.
struct Layout {
    std::size_t element;  ///< [bytes]
    std::size_t word;     ///< [bytes] of its numbers
};

constexpr Layout kLayouts[] = {{12, 4}, {24, 8}, {2, 2}, {8, 8}, {4, 4}, {1, 1}};

// With more than half of the elements changed, the whole part takes less than 64 bytes per moved
// vertex, and reading it needs no earlier blob.
constexpr std::size_t kLargestDifference = 2;

struct Header {
    std::uint16_t magic = kMagic;
    std::uint8_t version = kVersion;
    std::uint8_t kind = 0;
    std::uint8_t difference = 0;
    std::uint8_t zstd = 0;
    std::uint16_t unused = 0;
    std::uint64_t extra = 0;    ///< a topology's number of vertices
    std::uint64_t size = 0;     ///< [bytes] of the part's content
    std::uint64_t changed = 0;  ///< elements of a difference
    std::uint64_t payload = 0;  ///< [bytes] before compression
};

template <class T>
std::span<const std::byte> bytes_of(const std::vector<T>& values) {
    return std::as_bytes(std::span(values));
}

Bytes volume_mesh_bytes(const VolumeMesh& mesh) {
    ByteWriter writer;
    for (const std::size_t count :
         {mesh.points.size(), mesh.tetrahedra.size(), mesh.boundary.size(), mesh.patches.size()})
        writer.put<std::uint64_t>(count);
    for (const Patch& patch : mesh.patches) {
        writer.put_text(patch.name);
        writer.put(patch.kind);
    }
    writer.append(bytes_of(mesh.points));
    writer.append(bytes_of(mesh.tetrahedra));
    writer.append(bytes_of(mesh.boundary));
    writer.append(bytes_of(mesh.boundary_patches));
    if (mesh.prisms.empty()) return writer.take();
    // Follows where there are layers: meshes of tetrahedra alone keep their bytes.
    writer.put<std::uint64_t>(mesh.prisms.size());
    writer.put<std::uint64_t>(mesh.boundary_sides.size());
    writer.append(bytes_of(mesh.prisms));
    writer.append(bytes_of(mesh.boundary_sides));
    writer.append(bytes_of(mesh.side_patches));
    return writer.take();
}

template <class T>
std::vector<T> array_of(std::span<const std::byte> bytes) {
    std::vector<T> values(bytes.size() / sizeof(T));
    if (!values.empty())
        std::memcpy(static_cast<void*>(values.data()), bytes.data(), values.size() * sizeof(T));
    return values;
}

template <class T>
std::vector<T> read_array(ByteReader& reader, std::uint64_t count) {
    if (count > reader.left()) throw InvalidInput("the stored volume mesh is truncated");
    return array_of<T>(reader.get_bytes(count * sizeof(T)));
}

void check_volume_mesh(const VolumeMesh& mesh) {
    const auto check = [&](const auto& cells) {
        for (const auto& cell : cells)
            for (const VertexId v : cell)
                if (v >= mesh.points.size())
                    throw InvalidInput("the stored volume mesh refers to a missing point");
    };
    check(mesh.tetrahedra);
    check(mesh.boundary);
    check(mesh.prisms);
    check(mesh.boundary_sides);
    for (const PatchLabels* labels : {&mesh.boundary_patches, &mesh.side_patches})
        for (const auto label : *labels)
            if (label >= mesh.patches.size())
                throw InvalidInput("the stored volume mesh refers to a missing patch");
}

VolumeMesh volume_mesh_from(std::span<const std::byte> bytes) {
    ByteReader reader(bytes);
    VolumeMesh mesh;
    const auto points = reader.get<std::uint64_t>();
    const auto tetrahedra = reader.get<std::uint64_t>();
    const auto boundary = reader.get<std::uint64_t>();
    const auto patches = reader.get<std::uint64_t>();
    for (std::uint64_t i = 0; i < patches; ++i) {
        Patch patch;
        patch.name = reader.get_text();
        require_plain_name(patch.name, "a patch of the stored volume mesh");
        const auto kind = reader.get<std::uint8_t>();
        if (kind > static_cast<std::uint8_t>(PatchKind::Cut))
            throw InvalidInput("the stored volume mesh has an unknown kind of patch");
        patch.kind = static_cast<PatchKind>(kind);
        mesh.patches.push_back(std::move(patch));
    }
    mesh.points = read_array<Vec3>(reader, points);
    mesh.tetrahedra = read_array<Tetrahedron>(reader, tetrahedra);
    mesh.boundary = read_array<Triangle>(reader, boundary);
    mesh.boundary_patches = read_array<std::uint16_t>(reader, boundary);
    if (reader.left() > 0) {
        const auto prisms = reader.get<std::uint64_t>();
        const auto sides = reader.get<std::uint64_t>();
        mesh.prisms = read_array<Prism>(reader, prisms);
        mesh.boundary_sides = read_array<Quadrilateral>(reader, sides);
        mesh.side_patches = read_array<std::uint16_t>(reader, sides);
    }
    check_volume_mesh(mesh);
    return mesh;
}

/// A part's content as plain bytes; `own` holds them if they are not in one array.
struct Content {
    std::span<const std::byte> bytes;
    std::uint64_t extra = 0;
    Bytes own;
};

struct ContentOf {
    Content operator()(const std::shared_ptr<const Topology>& t) const {
        return {std::as_bytes(t->triangles()), t->vertex_count(), {}};
    }

    Content operator()(const std::shared_ptr<const VolumeMesh>& mesh) const {
        Content content;
        content.own = volume_mesh_bytes(*mesh);
        content.bytes = content.own;
        return content;
    }

    template <class T>
    Content operator()(const std::shared_ptr<const std::vector<T>>& array) const {
        return {bytes_of(*array), 0, {}};
    }
};

Content content_of(const ScenePart& part) {
    return std::visit(ContentOf{}, part);
}

void put_number(ByteWriter& writer, std::uint64_t number) {
    for (; number >= 128; number >>= 7) writer.put(static_cast<std::uint8_t>(number | 128));
    writer.put(static_cast<std::uint8_t>(number));
}

std::uint64_t get_number(ByteReader& reader) {
    std::uint64_t number = 0;
    for (int shift = 0; shift < 64; shift += 7) {
        const auto digit = reader.get<std::uint8_t>();
        number |= static_cast<std::uint64_t>(digit & 127) << shift;
        if (digit < 128) return number;
    }
    throw InvalidInput("a stored number is damaged");
}

/// Indices of the elements that differ from the base or are beyond its end; empty and false if
/// there are too many.
bool find_changes(std::span<const std::byte> bytes, std::span<const std::byte> base,
                  std::size_t element, std::vector<std::uint64_t>& changed) {
    const std::size_t count = bytes.size() / element, common = base.size() / element;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t at = i * element;
        if (i < common && std::memcmp(&bytes[at], &base[at], element) == 0) continue;
        changed.push_back(i);
        if (changed.size() * kLargestDifference > count) return false;
    }
    return true;
}

/// The changed elements, XORed with the old ones: similar numbers share their leading bytes, which
/// become zero and compress well.
Bytes changed_elements(std::span<const std::byte> bytes, std::span<const std::byte> base,
                       std::size_t element, const std::vector<std::uint64_t>& changed) {
    Bytes values(changed.size() * element);
    for (std::size_t k = 0; k < changed.size(); ++k)
        for (std::size_t b = 0; b < element; ++b) {
            const std::size_t at = changed[k] * element + b;
            values[k * element + b] = at < base.size() ? bytes[at] ^ base[at] : bytes[at];
        }
    return values;
}

/// Of a blob that is no difference.
Header whole_header(const ScenePart& part, const Content& content) {
    Header header;
    header.kind = static_cast<std::uint8_t>(part.index());
    header.extra = content.extra;
    header.size = content.bytes.size();
    const auto* mesh = std::get_if<kVolumeMesh>(&part);
    if (mesh != nullptr && !(*mesh)->prisms.empty()) header.version = kLayersVersion;
    return header;
}

Bytes blob_of(Header header, std::span<const std::byte> payload) {
    ByteWriter writer;
    header.payload = payload.size();
    writer.put(header);
    if (header.zstd != 0)
        writer.append(compress(payload));
    else
        writer.append(payload);
    return writer.take();
}

Header read_header(ByteReader& reader) {
    const auto header = reader.get<Header>();
    if (header.magic != kMagic || header.kind > kVolumeMesh)
        throw InvalidInput("the stored data is damaged: it is not a part of a scene");
    if (header.version > kLayersVersion)
        throw InvalidInput("the stored data has version " + std::to_string(header.version) +
                           "; this program reads up to " + std::to_string(kLayersVersion));
    return header;
}

Bytes read_payload(ByteReader& reader, const Header& header) {
    const auto rest = reader.get_bytes(reader.left());
    if (header.zstd != 0) return decompress(rest, header.payload);
    if (rest.size() != header.payload) throw InvalidInput("the stored data is truncated");
    return {rest.begin(), rest.end()};
}

}  // namespace

const void* identity(const ScenePart& part) {
    return std::visit([](const auto& shared) { return static_cast<const void*>(shared.get()); },
                      part);
}

std::size_t memory_bytes(const ScenePart& part) {
    if (const auto* topology = std::get_if<kTopology>(&part)) {
        // Triangles, and the one-rings (6 per vertex), triangles at vertices and boundary flags
        // that are built on use.
        const auto& t = **topology;
        return t.triangle_count() * (12 + 12 + 12) + t.vertex_count() * (4 + 4 + 1);
    }
    if (const auto* mesh = std::get_if<kVolumeMesh>(&part))
        return (*mesh)->points.size() * 24 + (*mesh)->tetrahedra.size() * 16 +
               (*mesh)->boundary.size() * 14 + (*mesh)->prisms.size() * 24 +
               (*mesh)->boundary_sides.size() * 18;
    return content_of(part).bytes.size();
}

std::string part_words(const ScenePart& part) {
    constexpr const char* kWords[] = {"triangles", "positions", "patch labels",
                                      "attribute", "voxels",    "volume mesh"};
    return kWords[part.index()];
}

std::string content_hash(const ScenePart& part) {
    const Content content = content_of(part);
    ByteWriter head;
    head.put(static_cast<std::uint64_t>(part.index()));
    head.put(content.extra);
    ContentHash hash;
    hash.add(head.bytes());
    hash.add(content.bytes);
    return hash.hex();
}

Bytes encode(const ScenePart& part, Compression compression) {
    const Content content = content_of(part);
    Header header = whole_header(part, content);
    header.zstd = compression == Compression::Zstd ? 1 : 0;
    if (header.zstd == 0) return blob_of(header, content.bytes);
    return blob_of(header, shuffle(content.bytes, kLayouts[header.kind].word));
}

void write_sized(const ScenePart& part, const ByteSink& sink) {
    const Content content = content_of(part);
    Header header = whole_header(part, content);
    header.payload = content.bytes.size();
    ByteWriter head;
    head.put<std::uint64_t>(sizeof(header) + content.bytes.size());
    head.put(header);
    sink(head.bytes());
    sink(content.bytes);
}

std::optional<Bytes> encode_difference(const ScenePart& part, const ScenePart& base) {
    if (part.index() != base.index() || part.index() == kVolumeMesh) return std::nullopt;
    const Content content = content_of(part), old = content_of(base);
    const Layout layout = kLayouts[part.index()];
    std::vector<std::uint64_t> changed;
    if (!find_changes(content.bytes, old.bytes, layout.element, changed)) return std::nullopt;
    ByteWriter payload;
    payload.append(
        shuffle(changed_elements(content.bytes, old.bytes, layout.element, changed), layout.word));
    std::uint64_t next = 0;
    for (const std::uint64_t i : changed) {
        put_number(payload, i - next);
        next = i + 1;
    }
    Header header;
    header.kind = static_cast<std::uint8_t>(part.index());
    header.difference = 1;
    header.zstd = 1;
    header.extra = content.extra;
    header.size = content.bytes.size();
    header.changed = changed.size();
    return blob_of(header, payload.bytes());
}

PartDecoder::PartDecoder(std::span<const std::byte> blob) {
    ByteReader reader(blob);
    const Header header = read_header(reader);
    if (header.difference != 0) throw InvalidInput("the base of a stored part is missing");
    kind_ = header.kind;
    extra_ = header.extra;
    content_ = read_payload(reader, header);
    shuffled_ = header.zstd != 0;  // put in order when the blob is gone: it may be as large
    if (content_.size() != header.size) throw InvalidInput("the stored data has the wrong size");
}

PartDecoder::PartDecoder(const ScenePart& known) : kind_(static_cast<std::uint8_t>(known.index())) {
    const Content content = content_of(known);
    extra_ = content.extra;
    content_.assign(content.bytes.begin(), content.bytes.end());
}

void PartDecoder::unshuffle_content() {
    if (shuffled_) content_ = unshuffle(content_, kLayouts[kind_].word);
    shuffled_ = false;
}

template <class T>
std::vector<T> PartDecoder::take() {
    std::vector<T> values(content_.size() / sizeof(T));
    const auto bytes = std::as_writable_bytes(std::span(values));
    if (shuffled_)
        unshuffle(content_, kLayouts[kind_].word, bytes);
    else
        std::ranges::copy(content_, bytes.begin());
    Bytes().swap(content_);
    return values;
}

void PartDecoder::apply_difference(std::span<const std::byte> blob) {
    ByteReader reader(blob);
    const Header header = read_header(reader);
    if (header.difference == 0 || header.kind != kind_ || kind_ == kVolumeMesh)
        throw InvalidInput("the stored data is damaged: a difference is expected");
    const Bytes payload = read_payload(reader, header);
    const Layout layout = kLayouts[kind_];
    if (header.changed > payload.size() / layout.element || header.size % layout.element != 0 ||
        header.size > content_.size() + header.changed * layout.element)
        throw InvalidInput("the stored difference has the wrong size");
    ByteReader parts(payload);
    const Bytes values = unshuffle(parts.get_bytes(header.changed * layout.element), layout.word);
    unshuffle_content();
    content_.reserve(header.size);  // resize alone would double it
    content_.resize(header.size);
    const std::uint64_t count = header.size / layout.element;
    std::uint64_t index = 0;
    for (std::uint64_t k = 0; k < header.changed; ++k, ++index) {
        const std::uint64_t gap = get_number(parts);
        if (gap >= count || index + gap >= count)
            throw InvalidInput("the stored difference refers to a missing element");
        index += gap;
        for (std::size_t b = 0; b < layout.element; ++b)
            content_[index * layout.element + b] ^= values[k * layout.element + b];
    }
    extra_ = header.extra;
}

ScenePart PartDecoder::finish() {
    if (content_.size() % kLayouts[kind_].element != 0)
        throw InvalidInput("the stored data has the wrong size");
    switch (kind_) {
        case kTopology:
            return std::make_shared<const Topology>(take<Triangle>(), extra_);
        case kPositions:
            return std::make_shared<const Positions>(take<Vec3>());
        case kLabels:
            return std::make_shared<const PatchLabels>(take<std::uint16_t>());
        case kReals:
            return std::make_shared<const std::vector<double>>(take<double>());
        case kVoxels:
            return std::make_shared<const std::vector<float>>(take<float>());
        default:
            unshuffle_content();
            return std::make_shared<const VolumeMesh>(volume_mesh_from(content_));
    }
}

}  // namespace vesselbench
