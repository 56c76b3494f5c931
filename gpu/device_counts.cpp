#include "gpu/device_counts.h"

namespace vesselbench {

DeviceCounts since(const DeviceCounts& before, const DeviceCounts& now) {
    return {.dispatches = now.dispatches - before.dispatches,
            .barriers = now.barriers - before.barriers,
            .allocations = now.allocations - before.allocations,
            .compiles = now.compiles - before.compiles,
            .reads = now.reads - before.reads,
            .uploaded = now.uploaded - before.uploaded,
            .read_back = now.read_back - before.read_back,
            .copied = now.copied - before.copied};
}

std::string text_of(const DeviceCounts& counts) {
    return std::to_string(counts.dispatches) + " dispatches, " + std::to_string(counts.barriers) +
           " barriers, " + std::to_string(counts.allocations) + " allocations, " +
           std::to_string(counts.compiles) + " compiles, " + std::to_string(counts.reads) +
           " reads; bytes: " + std::to_string(counts.uploaded) + " up, " +
           std::to_string(counts.read_back) + " read, " + std::to_string(counts.copied) + " copied";
}

}  // namespace vesselbench
