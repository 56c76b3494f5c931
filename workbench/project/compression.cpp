#include "workbench/project/compression.h"

#include <algorithm>
#include <memory>
#include <string>

#include <zstd.h>

#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

constexpr int kLevel = 1;  // Level 3 saves 2 % of a surface's positions for twice the time.

// Masks and patch labels are long runs of one value, of which zstd makes 4 bytes per 128 KiB. What
// is larger than such a part ever is (images are embedded up to 256 MiB) must not compress as well:
// a few KB in a file from a stranger could else demand any amount of memory.
constexpr std::uint64_t kLargestRatio = 40000;
constexpr std::uint64_t kLargestRun = std::uint64_t{256} << 20;  // [bytes]
constexpr std::uint64_t kLargestRatioAbove = 1000;

bool is_plausible(std::uint64_t size, std::uint64_t compressed) {
    return size / (size > kLargestRun ? kLargestRatioAbove : kLargestRatio) <= compressed;
}

struct FreeCompressor {
    void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
};

}  // namespace

Bytes compress(std::span<const std::byte> bytes) {
    const std::unique_ptr<ZSTD_CCtx, FreeCompressor> context(ZSTD_createCCtx());
    ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, kLevel);
    ZSTD_CCtx_setParameter(context.get(), ZSTD_c_checksumFlag, 1);
    Bytes blob(ZSTD_compressBound(bytes.size()));
    const std::size_t size =
        ZSTD_compress2(context.get(), blob.data(), blob.size(), bytes.data(), bytes.size());
    if (ZSTD_isError(size))
        throw AlgorithmFailure(std::string("cannot compress: ") + ZSTD_getErrorName(size));
    blob.resize(size);
    return blob;
}

Bytes decompress(std::span<const std::byte> blob, std::uint64_t size) {
    if (!is_plausible(size, blob.size()))
        throw InvalidInput("the stored data is damaged: " + std::to_string(blob.size()) +
                           " bytes announce a content of " + std::to_string(size));
    if (ZSTD_getFrameContentSize(blob.data(), blob.size()) != size)
        throw InvalidInput("the stored data is damaged: wrong size");
    Bytes bytes(static_cast<std::size_t>(size));
    const std::size_t got = ZSTD_decompress(bytes.data(), bytes.size(), blob.data(), blob.size());
    if (ZSTD_isError(got) || got != size)
        throw InvalidInput("the stored data is damaged: wrong checksum");
    return bytes;
}

Bytes shuffle(std::span<const std::byte> bytes, std::size_t word) {
    const std::size_t count = bytes.size() / word;
    Bytes result(bytes.begin(), bytes.end());
    for (std::size_t b = 0; b < word; ++b)
        for (std::size_t i = 0; i < count; ++i) result[b * count + i] = bytes[i * word + b];
    return result;
}

Bytes unshuffle(std::span<const std::byte> bytes, std::size_t word) {
    Bytes result(bytes.size());
    unshuffle(bytes, word, result);
    return result;
}

void unshuffle(std::span<const std::byte> bytes, std::size_t word, std::span<std::byte> result) {
    const std::size_t count = bytes.size() / word;
    for (std::size_t b = 0; b < word; ++b)
        for (std::size_t i = 0; i < count; ++i) result[i * word + b] = bytes[b * count + i];
    std::ranges::copy(bytes.subspan(count * word), result.begin() + count * word);
}

void require_plausible(std::uint64_t size, std::uint64_t file, std::uint64_t free,
                       std::uint64_t ratio) {
    if (size > free && size / ratio > file)
        throw InvalidInput("the stored data is damaged: a file of " + std::to_string(file) +
                           " bytes announces a content of " + std::to_string(size));
}

}  // namespace vesselbench
