#include "geometry/kernel/content_key.h"

#include <algorithm>
#include <vector>

#include <tbb/parallel_for.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace vesselbench {

namespace {

constexpr std::size_t kPart = std::size_t{1} << 20;  ///< bytes per parallel task

ContentKey key_of(std::span<const std::byte> bytes) {
    const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
    return {hash.high64, hash.low64};
}

}  // namespace

ContentKey content_key(std::span<const std::byte> bytes) {
    if (bytes.size() <= kPart) return key_of(bytes);
    std::vector<ContentKey> parts((bytes.size() + kPart - 1) / kPart);
    tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) {
        parts[i] = key_of(bytes.subspan(i * kPart, std::min(kPart, bytes.size() - i * kPart)));
    });
    return key_of(std::as_bytes(std::span<const ContentKey>(parts)));
}

ContentKey content_key(std::initializer_list<ContentKey> parts) {
    return key_of(std::as_bytes(std::span<const ContentKey>(parts.begin(), parts.size())));
}

}  // namespace vesselbench
