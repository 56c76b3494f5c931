#include "workbench/prepare/vessel_question.h"

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>

#include "geometry/kernel/diagnosed_error.h"
#include "workbench/case/checked_arguments.h"
#include "workbench/operations/clip_opening/parameters.h"
#include "workbench/operations/table.h"
#include "workbench/prepare/venous_name.h"

namespace vesselbench {

namespace {

constexpr const char* kVessel = "vessel";

/// A name like a vein's, and whose it is.
struct NamedVein {
    std::string source;  ///< "the label 'portal vein'", "the file's name"
    VenousName name;
};

std::optional<NamedVein> named(const std::string& source, const std::string& name) {
    const auto venous = venous_name(name);
    return venous ? std::optional(NamedVein{source, *venous}) : std::nullopt;
}

/// Names of the labels that are the vessel; empty: they have none.
std::vector<std::string> label_names(const Segmentation& segmentation) {
    std::vector<std::string> names;
    for (const Segment& segment : segmentation.segments) {
        const bool chosen = segmentation.vessel.empty()
                                ? segmentation.segments.size() == 1
                                : std::ranges::count(segmentation.vessel, segment.label) > 0;
        if (chosen && !segment.name.empty()) names.push_back(segment.name);
    }
    return names;
}

/// \param given of the edit that loaded the file \param scene after it
std::optional<NamedVein> vein_in(const Arguments& given, const Scene& scene) {
    if (const auto labels = label_names(scene.segmentation); !labels.empty()) {
        for (const std::string& label : labels)
            if (auto found = named("the label '" + label + "'", label)) return found;
        return std::nullopt;
    }
    const auto file_name = [&](const char* parameter) {
        return std::filesystem::path(given.text(parameter)).filename().string();
    };
    if (given.has("mask")) return named("the name of the mask's file", file_name("mask"));
    if (scene.surface)
        for (const Patch& patch : scene.surface->patches)
            if (auto found = named("the patch '" + patch.name + "'", patch.name)) return found;
    return named("the file's name", file_name("file"));
}

std::optional<NamedVein> vein_in(Session& session) {
    for (const LogEntry& entry : session.log()) {
        const auto kind = find_operation(entry.edit.operation).recipe.loads;
        if (kind != InputKind::Image && kind != InputKind::Surface) continue;
        return vein_in(entry.edit.given, session.scene_after(entry.edit.edit.id));
    }
    return std::nullopt;
}

/// The value of `vessel` that the name says.
std::string vessel_of(const NamedVein& vein) {
    return vein.name.portal ? kPortalVein : kVein;
}

Diagnostic diagnostic_of(const NamedVein& vein, const Operation& operation) {
    return {
        .code = "vessel-unstated",
        .operation = operation.name,
        .words = {{"source", vein.source},
                  {"word", vein.name.word},
                  {"kind", vein.name.portal ? "a portal vein, whose blood enters at the trunk, too"
                                            : "a vein, whose blood leaves at the trunk"}},
        .remedies = {{.arguments = {{kVessel, vessel_of(vein)}}},
                     {.arguments = {{kVessel, kArtery}}}}};
}

/// It opens ends for a flow, and nothing says what vessel it is.
bool leaves_vessel_open(const GivenArguments& given) {
    if (!given.operation().recipe.cuts_ends || given->has(kVessel) || given->has("planes"))
        return false;
    return checked_arguments(given)->text("check") == "flow";
}

bool accepts_doubts(const GivenArguments& given) {
    return checked_arguments(given)->flag("accept_doubts");
}

}  // namespace

std::optional<Diagnostic> vessel_doubt(const GivenArguments& given, Session& session) {
    if (!leaves_vessel_open(given)) return std::nullopt;
    const auto vein = vein_in(session);
    return vein ? std::optional(diagnostic_of(*vein, given.operation())) : std::nullopt;
}

void require_stated_vessel(std::span<const RecipeEntry> rest, Session& session) {
    const auto cut = std::ranges::find_if(
        rest, [](const RecipeEntry& entry) { return entry.given.operation().recipe.cuts_ends; });
    if (cut == rest.end() || accepts_doubts(cut->given)) return;
    if (auto doubt = vessel_doubt(cut->given, session)) throw DiagnosedFailure(std::move(*doubt));
}

VesselEntry vessel_entry(const RecipeEntry& entry, Session& session) {
    VesselEntry made{.entry = entry, .warning = std::nullopt};
    if (!leaves_vessel_open(entry.given) || !accepts_doubts(entry.given)) return made;
    made.warning = vessel_doubt(entry.given, session);
    if (!made.warning) return made;
    made.warning->code = "vessel-taken";
    made.entry.given.set(kVessel, made.warning->remedies.front().arguments.at(kVessel));
    made.warning->remedies.erase(made.warning->remedies.begin());
    return made;
}

CfdParameters flow_in_vessel(CfdParameters flow, const std::vector<LogEntry>& log) {
    const bool vein = std::ranges::any_of(log, [](const LogEntry& entry) {
        return find_operation(entry.edit.operation).recipe.cuts_ends && gathers(entry.edit.given);
    });
    if (vein && !flow.split) flow.split = FlowSplit::Cubes;
    return flow;
}

}  // namespace vesselbench
