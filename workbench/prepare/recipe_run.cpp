#include "workbench/prepare/recipe_run.h"

#include <algorithm>
#include <cmath>

#include "geometry/kernel/amounts.h"
#include "geometry/kernel/catalogue.h"
#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "geometry/vessel/openings/vessel_check.h"
#include "workbench/case/diagnostic_words.h"
#include "workbench/case/purposes.h"
#include "workbench/operations/table.h"
#include "workbench/prepare/decided_entry.h"
#include "workbench/prepare/extraction_entry.h"
#include "workbench/prepare/vessel_question.h"
#include "workbench/report/log_json.h"
#include "workbench/session/surface_change.h"

namespace vesselbench {

namespace {

std::string entry_text(const LogEntry& entry) {
    const std::string seconds = duration_text(entry.result ? entry.result->duration : 0.0);
    const std::string change = entry.result ? effect_text(*entry.result) : "";
    return to_string(entry.edit.place.step) + ": " + entry.edit.operation + " (" + seconds + ")" +
           (change.empty() ? "" : ": " + change);
}

/// Where an operation that keeps the volume changes it by more than this [-], the surface is too
/// coarse for it.
constexpr double kNoticedChange = 0.03;

/// Where one takes more of it than this [-], the model is another one.
constexpr double kLargestLoss = 0.25;

/// Where its passes are made fewer, so many of them that it takes no more than this [-].
constexpr double kGoodLoss = 0.1;

/// The fraction of the volume [-] that an operation which keeps it took.
double lost_volume(const LogEntry& entry) {
    if (find_operation(entry.edit.operation).recipe.volume_remedies.empty() || !entry.result)
        return 0.0;
    return -volume_change(entry.result->change).value_or(0.0);
}

constexpr const char* kIterations = "iterations";

/// Passes of an edit; 0: it has none.
std::int64_t iterations_of(const LogEntry& entry) {
    const Arguments& ran = entry.result->resolved;
    return ran.has(kIterations) ? ran.integer(kIterations) : 0;
}

/// What the model's surface was made from: where voxels of labels alone decide about the inside, an
/// extraction has no threshold.
SurfaceOrigin source_of(const Session& session) {
    for (const LogEntry& entry : session.log()) {
        if (entry.edit.operation != extracting_operation().name || !entry.result) continue;
        const Arguments& ran = entry.result->resolved;
        return ran.has("threshold") || ran.has("iso") ? SurfaceOrigin::Intensities
                                                      : SurfaceOrigin::Mask;
    }
    return SurfaceOrigin::File;
}

bool is_for_flow(const std::string& variant) {
    return std::ranges::any_of(purposes(), [&](const Purpose& purpose) {
        return purpose.name == variant && purpose.simulates_flow;
    });
}

/// \throw UnusableSource if there is nothing that a model could be made of
void require_vessel(Session& session, const LogEntry& entry, const std::string& variant) {
    try {
        const Scene scene = session.scene_after(entry.edit.edit.id);
        const SurfaceOrigin source = source_of(session);
        require_lumen(surface_of(scene), source);
        if (is_for_flow(variant)) require_vessel_size(surface_of(scene), source);
    } catch (const InvalidInput& error) {
        throw UnusableSource(diagnostics_of(error));
    }
}

/// A change of the volume where there should be none.
std::optional<Diagnostic> volume_warning(const LogEntry& entry) {
    const auto& remedies = find_operation(entry.edit.operation).recipe.volume_remedies;
    if (remedies.empty() || !entry.result) return std::nullopt;
    const auto change = volume_change(entry.result->change);
    if (!change || std::abs(*change) <= kNoticedChange) return std::nullopt;
    return Diagnostic{.code = "volume-changed",
                      .figures = {{"volume_percent", 100.0 * *change}},
                      .remedies = remedies};
}

/// True for an edit of a variant's line, up to a step.
bool is_of(const EditPlace& place, const std::string& variant, Step last) {
    return place.step <= last && is_part_of(place, variant);
}

/// An operation's error text without the operation's name, which the sentence before it has.
std::string reason_of(const std::exception& error, const Operation& operation) {
    const std::string text = error.what(), name = operation.name + ": ";
    return text.starts_with(name) ? text.substr(name.size()) : text;
}

/// Most surfaces without an image do not show the direction of its slices.
bool lacks_stack_axis(const std::exception& error) {
    return diagnostics_of(error).front().code == "stack-axis-uncertain";
}

/// An error as one of another class, which decides the exit code.
template <class Error>
[[noreturn]] void throw_as(const std::exception& error) {
    if (const auto* diagnosed = dynamic_cast<const Diagnosed*>(&error))
        throw DiagnosedError<Error>(diagnosed->diagnostics());
    throw Error(error.what());
}

/// Share of an edit's progress for what its watcher does before it.
constexpr double kBeforeEdit = 0.05;

/// Applies entries and runs pending edits, and lets others know.
class RecipeRun {
public:
    RecipeRun(Session& session, const std::string& variant, const Teller& tell,
              const RecipeWatch& watch)
        : session_(session), variant_(variant), tell_(tell), watch_(watch) {}

    void apply(const RecipeEntry& entry, const Progress& progress) {
        if (watch_.before) watch_.before(step_of(entry), progress.part(0.0, kBeforeEdit));
        const VesselEntry as = vessel_entry(extraction_entry(entry, session_), session_);
        const DecidedEntry decided = decided_entry(as.entry, session_, variant_, progress.silent());
        const std::optional<LogEntry> done = made(decided.entry, progress.part(kBeforeEdit, 1.0));
        if (done && !decided.remark.empty()) tell_(done->edit.operation + ": " + decided.remark);
        if (done && as.warning) warn_of(*as.warning, as.entry, *done);
        if (done && watch_.after) watch_.after(*done);
    }

    void run_pending(Step last, const Progress& progress) {
        const auto is_next = [&](const LogEntry& entry) {
            return entry.status == EditStatus::Pending && is_of(entry.edit.place, variant_, last);
        };
        for (std::vector<LogEntry> log = session_.log();; log = session_.log()) {
            const auto next = std::ranges::find_if(log, is_next);
            if (next == log.end()) return;
            if (watch_.before)
                watch_.before(next->edit.place.step, progress.part(0.0, kBeforeEdit));
            const EditId id = next->edit.edit.id;
            static_cast<void>(session_.scene_after(id, progress.part(kBeforeEdit, 1.0)));
            for (const LogEntry& entry : session_.log()) {
                if (entry.edit.edit.id != id) continue;
                if (entry.status == EditStatus::Done) tell_(entry_text(entry));
                tell_warnings(entry);
                if (watch_.after) watch_.after(entry);
            }
        }
    }

private:
    void tell_warnings(const LogEntry& entry) const {
        for (const Diagnostic& warning : warnings_of(entry)) tell_.warn(warning);
    }

    /// The edit, which is told of; on triangles too coarse for it, with so few passes that it keeps
    /// the volume. \throw AlgorithmFailure if none does; the edit is undone
    LogEntry applied(RecipeEntry entry, const Progress& progress) const {
        std::optional<Diagnostic> warning;
        for (;;) {
            LogEntry done =
                session_.apply(entry.given, {.step = entry.step, .variant = variant_}, progress);
            const double lost = lost_volume(done);
            const std::int64_t iterations = iterations_of(done);
            const bool last = iterations <= 1 && lost <= kLargestLoss;
            if (last || lost <= (warning ? kGoodLoss : kLargestLoss)) {
                tell_(entry_text(done));
                if (warning) warn_of(std::move(*warning), entry, done);
                return done;
            }
            session_.undo();
            if (iterations <= 1)
                throw DiagnosedFailure({.code = "volume-lost",
                                        .operation = done.edit.operation,
                                        .figures = {{"volume_percent", 100.0 * lost}},
                                        .remedies = {{.arguments = {{kIterations, "0"}}}}});
            if (!warning)
                warning = Diagnostic{.code = "fewer-iterations",
                                     .operation = done.edit.operation,
                                     .figures = {{"before", static_cast<double>(iterations)},
                                                 {"volume_percent", 100.0 * lost}}};
            const auto fewer = iterations / 2;
            warning->figures["iterations"] = static_cast<double>(fewer);
            entry.given.set(kIterations, fewer);
        }
    }

    void warn_of(Diagnostic warning, const RecipeEntry& entry, const LogEntry& done) const {
        warning.edit = done.edit.edit.id;
        tell_.warn(warning);
        note({done.edit.operation, step_of(entry), done.edit.edit, std::move(warning),
              own_variant(entry)});
    }

    /// \return none: it was skipped
    std::optional<LogEntry> made(const RecipeEntry& entry, const Progress& progress) {
        const Operation& operation = entry.given.operation();
        try {
            const LogEntry done = applied(entry, progress);
            if (operation.recipe.proves_source) require_vessel(session_, done, variant_);
            tell_warnings(done);
            return done;
        } catch (const InvalidInput& error) {
            // The loaded data was accepted: from here on, the operation is to blame.
            if (operation.usual_step == Step::Source) throw;
            throw_as<AlgorithmFailure>(error);
        } catch (const AlgorithmFailure& error) {
            if (operation.recipe.proves_source) throw UnusableSource(diagnostics_of(error));
            if (entry.otherwise) return made_otherwise(entry, error, progress);
            if (!entry.optional) throw;
            warn({.operation = operation.name,
                  .step = step_of(entry),
                  .diagnostic = {.code = "step-skipped",
                                 .operation = operation.name,
                                 .words = {{"why", reason_of(error, operation)}}},
                  .variant = own_variant(entry)});
            return std::nullopt;
        }
    }

    std::optional<LogEntry> made_otherwise(const RecipeEntry& entry, const AlgorithmFailure& why,
                                           const Progress& progress) {
        RecipeEntry second = entry;
        second.otherwise.reset();
        second.given.set(*entry.otherwise);
        const Operation& operation = entry.given.operation();
        std::string changed;
        for (const auto& [argument, value] : (*entry.otherwise)->values())
            changed += (changed.empty() ? "" : " ") + argument + "=" + to_text(value);
        Diagnostic warning{.code = lacks_stack_axis(why) ? "made-without-stack" : "made-otherwise",
                           .operation = operation.name,
                           .words = {{"arguments", changed}, {"why", reason_of(why, operation)}}};
        tell_.warn(warning);
        std::optional<LogEntry> done = made(second, progress);
        if (done) warning.edit = done->edit.edit.id;
        note({operation.name, step_of(entry), done ? std::optional(done->edit.edit) : std::nullopt,
              std::move(warning), own_variant(entry)});
        return done;
    }

    [[nodiscard]] std::string own_variant(const RecipeEntry& entry) const {
        const auto now = session_.snapshot();
        return step_of(entry) < now->history->first_variant_step() ? "" : variant_;
    }

    void warn(const RecipeWarning& warning) const {
        tell_.warn(warning.diagnostic);
        note(warning);
    }

    void note(const RecipeWarning& warning) const {
        if (watch_.warned) watch_.warned(warning);
    }

    Session& session_;
    const std::string& variant_;
    const Teller& tell_;
    const RecipeWatch& watch_;
};

/// True for an edit that ran with these arguments, given or decided.
bool was_made(const LogEntry& edit, const GivenArguments& sought) {
    if (edit.edit.operation != sought.operation().name || !edit.result) return false;
    return std::ranges::all_of(sought->values(), [&](const auto& argument) {
        const Arguments& ran = edit.result->resolved;
        return ran.has(argument.first) && ran.values().at(argument.first) == argument.second;
    });
}

/// True if the surface has no border where an edit of this step would be made.
bool is_closed_before(Session& session, const std::string& variant, Step step) {
    EditId last = 0;
    for (const LogEntry& edit : session.log())
        if (is_of(edit.edit.place, variant, step)) last = edit.edit.edit.id;
    return last != 0 && surface_of(session.scene_after(last)).topology->boundary_loops().empty();
}

bool is_left_out(Session& session, const RecipeEntry& entry, const std::string& variant) {
    return is_replaced(entry, session.log(variant)) ||
           (entry.unless_closed && is_closed_before(session, variant, step_of(entry)));
}

}  // namespace

void Teller::warn(const Diagnostic& warning) const {
    if (warnings_)
        warnings_(warning);
    else
        lines_((is_note(warning) ? "note: " : "warning: ") + worded_with_operation(warning));
}

bool is_replaced(const RecipeEntry& entry, const std::vector<LogEntry>& log) {
    return std::ranges::any_of(entry.unless_made, [&](const GivenArguments& sought) {
        return std::ranges::any_of(log,
                                   [&](const LogEntry& edit) { return was_made(edit, sought); });
    });
}

std::vector<Diagnostic> warnings_of(const LogEntry& entry) {
    std::vector<Diagnostic> warnings;
    if (!entry.result) return warnings;
    warnings = entry.result->warnings;
    if (auto warning = volume_warning(entry)) warnings.push_back(std::move(*warning));
    for (Diagnostic& warning : warnings) {
        warning.operation = entry.edit.operation;
        warning.edit = entry.edit.edit.id;
    }
    return warnings;
}

void run_recipe(Session& session, const Recipe& recipe, const std::string& variant,
                const Teller& tell, const Progress& progress, const RecipeWatch& watch) {
    RecipeRun run(session, variant, tell, watch);
    const auto loading = std::ranges::find_if_not(recipe, [](const RecipeEntry& entry) {
        return entry.given.operation().recipe.loads.has_value();
    });
    const auto loaded = static_cast<std::size_t>(loading - recipe.begin());
    const double share = 1.0 / static_cast<double>(std::max<std::size_t>(recipe.size(), 1));
    for (std::size_t i = 0; i < recipe.size(); ++i) {
        const double from = share * static_cast<double>(i);
        const Progress part = progress.part(from, from + share);
        run.run_pending(step_of(recipe[i]), part);
        if (i == loaded) require_stated_vessel(std::span(recipe).subspan(i), session);
        if (!is_left_out(session, recipe[i], variant)) run.apply(recipe[i], part);
    }
}

void run_pending(Session& session, const std::string& variant, Step last, const Teller& tell,
                 const Progress& progress, const RecipeWatch& watch) {
    RecipeRun(session, variant, tell, watch).run_pending(last, progress);
}

}  // namespace vesselbench
