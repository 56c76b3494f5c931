#include "geometry/formats/file_parts.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "geometry/kernel/measure.h"
#include "geometry/kernel/plain_name.h"
#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

/// Largest distance from the best-fit plane over the square root of the area [-]: flat meshed caps
/// are far below it, pieces of vessel wall far above.
constexpr double kFlat = 0.02;

/// Flat parts with more than this fraction of the area [-] are not caps, but a body with flat
/// sides.
constexpr double kMostFlat = 0.5;

struct Part {
    int id = 0;
    std::string name;
    PatchKind kind = PatchKind::Wall;
};

std::vector<Part> parts_of(const RawSurface& raw) {
    const std::set<int> ids(raw.part_ids.begin(), raw.part_ids.end());
    std::vector<Part> parts;
    for (const int id : ids) {
        const auto name = raw.part_names.find(id);
        parts.push_back({id, name == raw.part_names.end() ? "" : name->second, PatchKind::Wall});
    }
    return parts;
}

bool all_named(const std::vector<Part>& parts) {
    return std::all_of(parts.begin(), parts.end(),
                       [](const Part& part) { return kind_of_name(part.name).has_value(); });
}

/// Each part as a separate patch, for measuring.
std::vector<PatchMeasures> measures_of(const Surface& surface, const RawSurface& raw,
                                       const std::vector<Part>& parts) {
    PatchLabels labels;
    for (const int id : raw.part_ids) {
        const auto at = std::find_if(parts.begin(), parts.end(),
                                     [&](const Part& part) { return part.id == id; });
        labels.push_back(static_cast<std::uint16_t>(at - parts.begin()));
    }
    return measure_patches(
        surface.with_patches(std::move(labels), std::vector<Patch>(parts.size())));
}

void classify_by_shape(std::vector<Part>& parts, const std::vector<PatchMeasures>& measures) {
    double flat_area = 0.0, whole_area = 0.0;
    int flat_parts = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const bool flat = measures[i].flatness < kFlat * std::sqrt(measures[i].area);
        parts[i].kind = flat ? PatchKind::Cut : PatchKind::Wall;
        flat_area += flat ? measures[i].area : 0.0;
        whole_area += measures[i].area;
        if (flat) parts[i].name = "cut_" + std::to_string(++flat_parts);
    }
    if (flat_area <= kMostFlat * whole_area) return;
    for (Part& part : parts) part.kind = PatchKind::Wall;
}

std::string note_of(const std::vector<Part>& parts, bool named) {
    const auto openings = std::count_if(
        parts.begin(), parts.end(), [](const Part& part) { return part.kind != PatchKind::Wall; });
    return counted(parts.size(), "part") + " in the file" +
           (named ? " (by name)" : " (distinguished by their flatness)") + ": " +
           std::to_string(parts.size() - static_cast<std::size_t>(openings)) + " wall, " +
           counted(static_cast<std::size_t>(openings), "opening");
}

/// Patch table: wall, inlets, outlets, cuts, each in the order of the part numbers.
Surface with_parts(const Surface& surface, const RawSurface& raw, std::vector<Part> parts,
                   PlainNames& names) {
    std::stable_sort(parts.begin(), parts.end(),
                     [](const Part& a, const Part& b) { return a.kind < b.kind; });
    std::vector<Patch> table = {{names.add("wall"), PatchKind::Wall}};
    std::map<int, std::uint16_t> label;
    for (const Part& part : parts) {
        label[part.id] = 0;
        if (part.kind == PatchKind::Wall) continue;
        label[part.id] = static_cast<std::uint16_t>(table.size());
        table.push_back({names.add(part.name), part.kind});
    }
    PatchLabels labels;
    labels.reserve(raw.part_ids.size());
    for (const int id : raw.part_ids) labels.push_back(label[id]);
    return surface.with_patches(std::move(labels), std::move(table));
}

}  // namespace

std::optional<PatchKind> kind_of_name(const std::string& name) {
    const std::string lower = lower_case(name);
    for (const PatchKind kind :
         {PatchKind::Wall, PatchKind::Inlet, PatchKind::Outlet, PatchKind::Cut})
        if (lower.rfind(to_string(kind), 0) == 0) return kind;
    return std::nullopt;
}

namespace {

void take_attributes(Surface& surface, RawSurface& raw, std::vector<std::string>& notes) {
    PlainNames names;
    for (auto& [name, values] : raw.attributes)
        surface.attributes[names.add(name)] =
            std::make_shared<const std::vector<double>>(std::move(values));
    if (!names.note().empty()) notes.push_back("attributes: " + names.note());
}

}  // namespace

Surface surface_from(RawSurface raw, std::vector<std::string>& notes) {
    Surface surface = make_surface(std::move(raw.positions), std::move(raw.triangles));
    take_attributes(surface, raw, notes);
    constexpr std::size_t kMostParts = 1000;
    if (raw.part_ids.size() != surface.triangle_count()) return surface;
    std::vector<Part> parts = parts_of(raw);
    if (parts.size() < 2 || parts.size() > kMostParts) return surface;
    const bool named = all_named(parts);
    if (named)
        for (Part& part : parts) part.kind = *kind_of_name(part.name);
    else
        classify_by_shape(parts, measures_of(surface, raw, parts));
    notes.push_back(note_of(parts, named));
    PlainNames names;
    Surface patched = with_parts(surface, raw, std::move(parts), names);
    if (!names.note().empty()) notes.push_back("openings: " + names.note());
    return patched;
}

}  // namespace vesselbench
