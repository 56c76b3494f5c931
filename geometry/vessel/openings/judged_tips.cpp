#include "geometry/vessel/openings/judged_tips.h"

#include "geometry/vessel/ends/stub_lines.h"
#include "geometry/vessel/openings/frayed_trunks.h"

namespace vesselbench {

std::vector<JudgedTip> judged_tips(const Surface& surface, const CenterlineGraph& graph,
                                   const std::vector<Stub>& stubs,
                                   const std::optional<ImageBox>& image, const Progress& progress) {
    const LinesWithoutFrays lines = without_frays(surface, graph, stubs);
    const std::vector<SurfaceEnd> ends = find_surface_ends(surface, lines.graph);
    const std::vector<Stub> apart = stubs_apart(stubs, lines.graph, ends);
    const EndChoice choice = choose_ends({.surface = surface,
                                          .graph = lines.graph,
                                          .image = image,
                                          .border_cuts = image.has_value()},
                                         ends, apart, progress);
    std::vector<JudgedTip> judged;
    for (std::size_t e = 0; e < ends.size(); ++e)
        if (ends[e].tip && !ends[e].is_visible())
            judged.push_back({lines.graph.nodes[*ends[e].tip].position, choice.ends[e]});
    for (std::size_t s = 0; s < apart.size(); ++s)
        judged.push_back({apart[s].tip, choice.stubs[s]});
    return judged;
}

}  // namespace vesselbench
