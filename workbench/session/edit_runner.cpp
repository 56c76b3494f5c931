#include "workbench/session/edit_runner.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include "geometry/kernel/diagnostic_text.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/stopwatch.h"
#include "geometry/kernel/surface_key.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/former_arguments.h"
#include "workbench/project/source_files.h"
#include "workbench/project/stored_text.h"
#include "workbench/session/guarded_run.h"
#include "workbench/session/surface_change.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

// Fraction of the progress for an edit's run; measuring the change and, for a pending edit, storing
// it take the rest.
constexpr double kRunShare = 0.9;

/// The part of a progress for the i-th of several equal tasks.
Progress part_of(const Progress& progress, std::size_t i, std::size_t count) {
    const auto whole = static_cast<double>(count);
    return progress.part(static_cast<double>(i) / whole, static_cast<double>(i + 1) / whole);
}

/// True if one of two amounts is more than twice the other, by more than a little.
bool differ_much(double a, double b, double little) {
    const double small = std::min(std::abs(a), std::abs(b));
    return std::max(std::abs(a), std::abs(b)) > 2.0 * small && std::abs(a - b) > little;
}

/// A warning about an amount of a change that differs.
struct DifferenceWarning {
    const char* code;
    const char* now;  ///< names of its figures
    const char* before;
    double unit = 1.0;    ///< of the figures, in that of the amounts
    double little = 0.0;  ///< a difference that is not worth a word
};

constexpr DifferenceWarning kVolume{"effect-on-volume-differs", "now_percent", "before_percent",
                                    100.0, 0.002};
constexpr DifferenceWarning kSurface{"effect-on-surface-differs", "now_mm", "before_mm", 1.0, 0.1};

/// None unless one is known to differ much from the other.
std::optional<Diagnostic> difference(const std::optional<double>& now,
                                     const std::optional<double>& before,
                                     const DifferenceWarning& warning) {
    if (!now || !before || !differ_much(*now, *before, warning.little)) return std::nullopt;
    return Diagnostic{
        .code = warning.code,
        .figures = {{warning.now, warning.unit * *now}, {warning.before, warning.unit * *before}}};
}

/// An edit that ran on other input may no longer do what it was made for, unnoticed.
void note_difference(ResultRecord& record, const Operation& operation,
                     const SurfaceChange& before) {
    const SurfaceChange& now = record.change;
    auto found = difference(volume_change(now), volume_change(before), kVolume);
    if (!found) found = difference(now.largest_deviation, before.largest_deviation, kSurface);
    if (!found) return;
    found->operation = operation.name;
    record.warnings.push_back(std::move(*found));
}

/// The result with which a revision made its choices; empty if none of its runs succeeded.
std::optional<ResultId> first_result(const History& history, EditRef edit) {
    const auto& results = history.results();
    const auto first = std::ranges::find_if(results, [&](const auto& result) {
        return result.second.edit == edit && result.second.stale_reason.empty();
    });
    return first == results.end() ? std::nullopt : std::optional(first->first);
}

/// True for an edit that chose places by itself.
bool chose_places(const Operation& operation, const Arguments& given, const Arguments& resolved) {
    return std::ranges::any_of(operation.parameters, [&](const Parameter& parameter) {
        return parameter.meaning == Meaning::Planes && resolved.has(parameter.name) &&
               !given.has(parameter.name);
    });
}

/// True for an edit of whatever openings there are: their names and diameters are the model's.
bool takes_all_openings(const Operation& operation, const Arguments& given) {
    return std::ranges::any_of(operation.parameters, [&](const Parameter& parameter) {
        return parameter.meaning == Meaning::Openings && !given.has(parameter.name);
    });
}

/// What an edit runs with on another input: what it decided before is kept, so that it does again
/// what the user has seen.
Arguments arguments_again(const Operation& operation, const Arguments& given,
                          const ResultRecord* before) {
    const bool decides = before == nullptr || takes_all_openings(operation, given);
    return decides ? given : with_former_arguments(operation, before->resolved);
}

/// A diagnostic's text without its figures.
std::string words_of(const Diagnostic& diagnostic) {
    std::string text = text_of(diagnostic);
    std::erase_if(text, [](char c) {
        return std::string_view("0123456789.+-").find(c) != std::string_view::npos;
    });
    return text;
}

/// An edit that is given the places it chose before does not look for others: what it found, and
/// warned of, when it chose is kept with them.
void keep_findings(ResultRecord& record, const ResultRecord& chosen) {
    std::vector<Diagnostic> warnings;
    for (const Diagnostic& warning : chosen.warnings)
        if (std::ranges::count(record.warnings, words_of(warning), words_of) == 0)
            warnings.push_back(warning);
    record.warnings.insert(record.warnings.begin(), warnings.begin(), warnings.end());
    Json report = Json::parse(record.report, nullptr, false);
    const Json before = Json::parse(chosen.report, nullptr, false);
    if (!report.is_object() || !before.is_object()) return;
    for (const auto& [key, value] : before.items())
        if (!report.contains(key)) report[key] = value;
    record.report = stored_text(report);
}

/// True for scenes whose surfaces have the same bits.
bool same_surfaces(const Scene& a, const Scene& b) {
    const auto empty = [](const Scene& scene) { return !scene.surface || scene.surface->empty(); };
    if (empty(a) || empty(b)) return empty(a) && empty(b);
    return shape_key(*a.surface) == shape_key(*b.surface);
}

EditRun run_guarded(const Operation& operation, Scene input, const CheckedArguments& located,
                    const WorkerOptions& worker, const Progress& progress,
                    const std::function<bool()>& repeats = {}) {
    const Stopwatch watch;
    Progress own = progress.part(0.0, kRunShare);
    Outcome outcome = run_operation(operation, input, located, own, worker);
    return guarded_run(operation, std::move(input), std::move(outcome), watch.seconds(),
                       progress.part(kRunShare, 1.0), repeats);
}

}  // namespace

EditRun EditRunner::run(const Operation& operation, Scene input, const CheckedArguments& located,
                        const Progress& progress) const {
    return run_guarded(operation, std::move(input), located, options_->worker, progress);
}

CheckedArguments EditRunner::located(const Operation& operation, EditRef edit,
                                     const Arguments& stored) const {
    require_bare_files(operation, stored);
    return checked_arguments(
        operation,
        with_found_files(operation, stored, store_->project().sources(edit), store_->files()));
}

EditRun EditRunner::run_pending(EditRef ref, Scene input, const Progress& progress) {
    const EditRecord edit = store_->edit(ref);
    const HistoryResult* earlier = store_->history().newest_result_of(ref);
    const auto record = earlier != nullptr ? store_->record(earlier->id) : nullptr;
    try {
        const Operation& operation = options_->find(edit.operation);
        const Arguments arguments = arguments_again(operation, edit.given, record.get());
        const auto repeats = [&] {
            return record && record->stale_reason.empty() &&
                   same_surfaces(load(record->input, progress.silent()), input);
        };
        EditRun done = run_guarded(operation, input, located(operation, ref, arguments),
                                   options_->worker, progress, repeats);
        if (!record) return done;
        const auto first = first_result(store_->history(), ref);
        if (first && chose_places(operation, edit.given, record->resolved))
            keep_findings(done.record, *store_->record(*first));
        if (record->stale_reason.empty()) note_difference(done.record, operation, record->change);
        return done;
    } catch (const AlgorithmFailure& error) {
        return stale_run(std::move(input), edit.operation, error);
    } catch (const InvalidInput& error) {
        return stale_run(std::move(input), edit.operation, error);
    } catch (const UsageError& error) {
        return stale_run(std::move(input), edit.operation, error);
    }
}

ResultId EditRunner::evaluate(const std::vector<HistoryEntry>& entries, const Progress& progress) {
    ResultId end = 0;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const HistoryResult* known = store_->history().result_of(entries[i].edit, end);
        if (known == nullptr) {
            const Progress part = part_of(progress, i, entries.size());
            EvaluatedLine line{.links = {{entries[i].edit, {}}}};
            line.links[0].run = run_pending(entries[i].edit, load(end, part), part);
            History next = store_->history();
            std::vector<NewResult> results;
            const ResultId after = enter(line, next, results, end);
            store_->commit_results(std::move(next), results);
            end = after;
        } else if (known->stale_reason.empty()) {
            end = known->id;
        }
    }
    return end;
}

EvaluatedLine EditRunner::evaluated(const std::vector<HistoryEntry>& entries,
                                    const Progress& progress) {
    EvaluatedLine line;
    bool loaded = true;  // the empty scene
    for (std::size_t i = 0; i < entries.size(); ++i) {
        EvaluatedLine::Link& link = line.links.emplace_back();
        link.edit = entries[i].edit;
        const HistoryResult* known =
            line.end ? store_->history().result_of(link.edit, *line.end) : nullptr;
        if (known != nullptr) {
            if (!known->stale_reason.empty()) continue;
            line.end = known->id;
            loaded = false;
            continue;
        }
        const Progress part = part_of(progress, i, entries.size());
        if (!std::exchange(loaded, true)) line.scene = load(*line.end, part);
        link.run = run_pending(link.edit, line.scene, part);
        if (!link.run->scene) continue;
        line.scene = *link.run->scene;
        line.end.reset();
    }
    if (!loaded) line.scene = load(*line.end, progress);
    return line;
}

ResultId enter(EvaluatedLine& line, History& next, std::vector<NewResult>& results,
               ResultId start) {
    ResultId end = start;
    for (EvaluatedLine::Link& link : line.links) {
        if (const HistoryResult* known = next.result_of(link.edit, end)) {
            if (known->stale_reason.empty()) end = known->id;
            continue;
        }
        if (!link.run)
            throw UsageError("edit " + std::to_string(link.edit.id) +
                             " followed other edits when this was previewed");
        ResultRecord& record = link.run->record;
        record.edit = link.edit;
        record.input = end;
        record.id = next.add_result(link.edit, end, record.stale_reason);
        results.push_back(
            {&record, link.run->scene ? &*link.run->scene : nullptr, &link.run->input});
        if (link.run->scene) end = record.id;
    }
    return end;
}

Scene EditRunner::load(ResultId id, const Progress& progress) {
    if (auto scene = store_->at_hand(id)) return *scene;
    progress.check_cancelled();
    const std::vector<Scene> recalled = recall(id, progress);
    Scene scene = store_->project().scene(id, progress);
    store_->keep(id, scene);
    return scene;
}

/// Recreates data that is only referenced: runs the first edit of the chain that lacks something.
/// \return scenes that must live until the result is loaded
std::vector<Scene> EditRunner::recall(ResultId id, const Progress& progress) {
    const ProjectFile& project = store_->project();
    std::vector<Scene> recalled;
    ResultId last = 0;
    while (project.needs_recall(id)) {
        ResultId first = id;
        for (ResultId at = id; at != 0; at = store_->history().results().at(at).input)
            if (project.needs_recall(at)) first = at;
        const HistoryResult& result = store_->history().results().at(first);
        if (first == last)
            throw InvalidInput("the image that edit " + std::to_string(result.edit.id) +
                               " made cannot be recreated: its source has changed");
        last = first;
        recalled.push_back(rerun(result, progress.silent()).scene);
        project.recall(recalled.back());
    }
    return recalled;
}

Outcome EditRunner::rerun(const HistoryResult& result, const Progress& progress) {
    const EditRecord edit = store_->edit(result.edit);
    const Operation& operation = options_->find(edit.operation);
    const CheckedArguments arguments =
        located(operation, result.edit,
                with_former_arguments(operation, store_->record(result.id)->resolved));
    Progress own = progress;
    return run_operation(operation, load(result.input, progress), arguments, own, options_->worker);
}

std::string EditRunner::excess(const HistoryResult& result, const Outcome& outcome,
                               const Progress& progress) {
    const Operation& operation = options_->find(store_->edit(result.edit).operation);
    if (operation.may_change == nullptr) return "";
    const auto found = overreach_of(operation, load(result.input, progress), outcome, progress);
    return found ? text_of(*found) : "";
}

}  // namespace vesselbench
