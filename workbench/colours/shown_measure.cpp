#include "workbench/colours/shown_measure.h"

#include <algorithm>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/near_names.h"
#include "workbench/colours/colourings.h"

namespace vesselbench {

namespace {

using enum ColouringKind;

bool is_of_vertices(const ColouringInfo& info) {
    return info.kind != Patches && info.kind != Deviation && info.kind != TetrahedraQuality;
}

/// \param offers which of them, by their kind
template <class Offers>
std::vector<std::string> measure_names(const Offers& offers) {
    std::vector<std::string> names;
    for (const ColouringInfo& info : colourings())
        if (is_of_vertices(info) && offers(info.kind)) names.emplace_back(info.name);
    return names;
}

ShownMeasure attribute_measure(const std::string& name, const std::vector<double>& values) {
    return {.name = name, .label = name, .unit = {}, .values = values, .scale = scale_for(values)};
}

}  // namespace

ShownMeasure shown_measure(const Scene& scene, const std::string& name, const Progress& progress) {
    const Surface& surface = surface_of(scene);
    if (const auto found = surface.attributes.find(name); found != surface.attributes.end())
        return attribute_measure(name, *found->second);
    for (const ColouringInfo& info : colourings()) {
        if (name != info.name || !is_of_vertices(info)) continue;
        ColourValues found = colour_values(info.kind, scene, progress);
        return {.name = name,
                .label = info.label,
                .unit = info.unit == std::string("-") ? "" : info.unit,
                .values = std::move(found.values),
                .scale = {ColourMap::Ordered, found.range.least, found.range.most}};
    }
    std::vector<std::string> known;
    for (const auto& [attribute, values] : surface.attributes) known.push_back(attribute);
    const auto of_scene = [&](ColouringKind kind) { return why_no_colours(kind, scene).empty(); };
    for (const std::string& measure : measure_names(of_scene)) known.push_back(measure);
    throw InvalidInput("--colour: the surface has no measure or vertex attribute '" + name + "'" +
                       did_you_mean(name, known) + " (it has " + joined(known) +
                       "; smooth keep_weights=true adds attributes, and VTP and PLY files keep "
                       "them)");
}

std::string measure_title(const ShownMeasure& measure) {
    return measure.label + (measure.unit.empty() ? "" : " [" + measure.unit + "]");
}

std::string measure_names_text() {
    return joined(measure_names([](ColouringKind) { return true; }));
}

std::string surface_measure_names_text() {
    return joined(measure_names([](ColouringKind kind) { return kind != NeighbourDistance; }));
}

}  // namespace vesselbench
