#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "workbench/case/scene.h"
#include "workbench/project/bytes.h"

namespace vesselbench {

/// One of the shared arrays of a scene. Each is stored once, however many states share it. The
/// order of the alternatives is part of the blob format.
using ScenePart =
    std::variant<std::shared_ptr<const Topology>, std::shared_ptr<const Positions>,
                 std::shared_ptr<const PatchLabels>, std::shared_ptr<const std::vector<double>>,
                 std::shared_ptr<const std::vector<float>>, std::shared_ptr<const VolumeMesh>>;

/// The address that is equal for two scenes sharing the part.
[[nodiscard]] const void* identity(const ScenePart& part);

/// Bytes of the part in memory, including the neighbour arrays of a topology.
[[nodiscard]] std::size_t memory_bytes(const ScenePart& part);

/// What the part holds: "triangles", "positions", "voxels" ...
[[nodiscard]] std::string part_words(const ScenePart& part);

/// SHA-256 of the part's content, 64 hexadecimal digits.
[[nodiscard]] std::string content_hash(const ScenePart& part);

enum class Compression : std::uint8_t { None = 0, Zstd = 1 };

/// A part as a versioned blob, bit-exact. Compressed blobs carry a checksum.
[[nodiscard]] Bytes encode(const ScenePart& part, Compression compression);

/// Writes the size in bytes (8) of the uncompressed blob, then the blob, without a copy of arrays.
void write_sized(const ScenePart& part, const ByteSink& sink);

/// The part as its difference from another of the same kind: the elements that differ, bit-exact,
/// about 27 bytes per moved vertex. Empty if so many differ that the whole part makes the smaller
/// blob.
[[nodiscard]] std::optional<Bytes> encode_difference(const ScenePart& part, const ScenePart& base);

/// Reads parts back from a whole blob (or a known part) followed by any number of differences in
/// order.
class PartDecoder {
public:
    /// \throw InvalidInput if the blob is damaged, of a newer version, or a difference
    explicit PartDecoder(std::span<const std::byte> blob);
    explicit PartDecoder(const ScenePart& known);

    /// \throw InvalidInput if the blob is damaged or not a difference of this kind of part
    void apply_difference(std::span<const std::byte> blob);

    /// The part; the decoder is then empty. At no time are there more than two copies of it.
    /// \throw InvalidInput if the content is inconsistent (a triangle without its vertices...)
    [[nodiscard]] ScenePart finish();

private:
    void unshuffle_content();
    template <class T>
    [[nodiscard]] std::vector<T> take();

    std::uint8_t kind_ = 0;
    std::uint64_t extra_ = 0;  ///< a topology's number of vertices
    Bytes content_;
    bool shuffled_ = false;  ///< the content is still as it was compressed
};

}  // namespace vesselbench
