#include "workbench/prepare/apply_recipe.h"

#include <algorithm>
#include <cmath>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "geometry/vessel/openings/vessel_check.h"
#include "workbench/operations/table.h"
#include "workbench/report/log_json.h"
#include "workbench/session/surface_change.h"

namespace vesselbench {

namespace {

std::string entry_text(const LogEntry& entry) {
    const std::string seconds = formatted(entry.result ? entry.result->duration : 0.0, "%.1f s");
    const std::string change = entry.result ? effect_text(*entry.result) : "";
    return to_string(entry.edit.place.step) + ": " + entry.edit.operation + " (" + seconds + ")" +
           (change.empty() ? "" : ": " + change);
}

/// Where an operation that keeps the volume changes it by more than this [-], the surface is too
/// coarse for it.
constexpr double kNoticedChange = 0.03;

/// Where one takes more of it than this [-], the model is another one.
constexpr double kLargestLoss = 0.25;

/// \throw AlgorithmFailure if an operation that keeps the volume took much of it; the edit is
/// undone
void require_volume(Session& session, const LogEntry& entry) {
    if (find_operation(entry.edit.operation).recipe.volume_remedy.empty() || !entry.result) return;
    const auto change = volume_change(entry.result->change);
    if (!change || *change >= -kLargestLoss) return;
    session.undo();
    throw AlgorithmFailure(
        entry.edit.operation + " would take " + formatted(-100.0 * *change, "%.0f") +
        " % of the volume: the triangles are too coarse for the vessel; make them finer with "
        "subdivide");
}

/// \throw UnusableSource if there is nothing that a model could be made of
void require_vessel(Session& session, const std::string& variant) {
    try {
        require_lumen(surface_of(session.scene(variant)));
    } catch (const InvalidInput& error) {
        throw UnusableSource(error.what());
    }
}

/// What a user should know of an edit beside its own warnings; else empty.
std::string noticed(const LogEntry& entry) {
    const std::string& remedy = find_operation(entry.edit.operation).recipe.volume_remedy;
    if (remedy.empty() || !entry.result) return "";
    const auto change = volume_change(entry.result->change);
    if (!change || std::abs(*change) <= kNoticedChange) return "";
    return entry.edit.operation + " changed the volume by " + formatted(100.0 * *change, "%.1f") +
           " %: " + remedy;
}

/// Applies one entry. \return a warning in addition to the edit's own; empty if there is none
std::string apply_entry(Session& session, const RecipeEntry& entry, const std::string& variant,
                        const Teller& tell, const Progress& progress) {
    const Operation& operation = entry.given.operation();
    try {
        const LogEntry done =
            session.apply(entry.given, {.step = entry.step, .variant = variant}, progress);
        require_volume(session, done);
        tell(entry_text(done));
        if (operation.recipe.proves_source) require_vessel(session, variant);
        if (done.result)
            for (const std::string& warning : done.result->warnings)
                tell("warning: " + operation.name + ": " + warning);
        const std::string warning = noticed(done);
        if (!warning.empty()) tell("warning: " + warning);
        return warning;
    } catch (const InvalidInput& error) {
        // The loaded data was accepted: from here on, the operation is to blame.
        if (operation.usual_step == Step::Source) throw;
        throw AlgorithmFailure(error.what());
    } catch (const AlgorithmFailure& error) {
        if (operation.recipe.proves_source) throw UnusableSource(error.what());
        if (entry.otherwise) {
            RecipeEntry second = entry;
            second.otherwise.reset();
            second.given.set(*entry.otherwise);
            std::string changed;
            for (const auto& [name, value] : (*entry.otherwise)->values())
                changed += (changed.empty() ? "" : " ") + name + "=" + to_text(value);
            const std::string warning =
                operation.name + " with " + changed + " instead: " + error.what();
            tell("warning: " + warning);
            const std::string more = apply_entry(session, second, variant, tell, progress);
            return more.empty() ? warning : warning + "; " + more;
        }
        if (!entry.optional) throw;
        const std::string warning = operation.name + " was skipped: " + error.what();
        tell("warning: " + warning);
        return warning;
    }
}

/// True for an edit that ran with these arguments, given or decided.
bool was_made(const LogEntry& edit, const GivenArguments& sought) {
    if (edit.edit.operation != sought.operation().name || !edit.result) return false;
    return std::ranges::all_of(sought->values(), [&](const auto& argument) {
        const Arguments& ran = edit.result->resolved;
        return ran.has(argument.first) && ran.values().at(argument.first) == argument.second;
    });
}

bool is_left_out(Session& session, const RecipeEntry& entry, const std::string& variant) {
    if (entry.unless_made && std::ranges::any_of(session.log(), [&](const LogEntry& edit) {
            return was_made(edit, *entry.unless_made);
        }))
        return true;
    return entry.unless_closed &&
           surface_of(session.scene(variant)).topology->boundary_loops().empty();
}

}  // namespace

std::vector<std::string> apply_recipe(Session& session, const Recipe& recipe,
                                      const std::string& variant, const Teller& tell,
                                      const Progress& progress) {
    std::vector<std::string> warnings;
    const double share = 1.0 / static_cast<double>(std::max<std::size_t>(recipe.size(), 1));
    for (std::size_t i = 0; i < recipe.size(); ++i) {
        if (is_left_out(session, recipe[i], variant)) continue;
        const double from = share * static_cast<double>(i);
        const std::string warning =
            apply_entry(session, recipe[i], variant, tell, progress.part(from, from + share));
        if (!warning.empty()) warnings.push_back(warning);
    }
    return warnings;
}

}  // namespace vesselbench
