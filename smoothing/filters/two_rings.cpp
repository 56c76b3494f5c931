#include "smoothing/filters/two_rings.h"

#include <algorithm>

namespace vesselbench {

CompressedRows two_rings(const Topology& topology) {
    const CompressedRows& rings = topology.rings();
    CompressedRows wide;
    wide.offsets.assign(1, 0);
    wide.offsets.reserve(topology.vertex_count() + 1);
    std::vector<VertexId> around;
    for (VertexId v = 0; v < topology.vertex_count(); ++v) {
        around.assign(rings.row(v).begin(), rings.row(v).end());
        for (const VertexId u : rings.row(v))
            around.insert(around.end(), rings.row(u).begin(), rings.row(u).end());
        std::sort(around.begin(), around.end());
        around.erase(std::unique(around.begin(), around.end()), around.end());
        for (const VertexId u : around)
            if (u != v) wide.values.push_back(u);
        wide.offsets.push_back(static_cast<std::uint32_t>(wide.values.size()));
    }
    return wide;
}

}  // namespace vesselbench
