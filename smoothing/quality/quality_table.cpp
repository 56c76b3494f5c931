#include "smoothing/quality/quality_table.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <tbb/parallel_for.h>

namespace vesselbench {

namespace {

constexpr int kStrong = 50;  // iterations (6.5.3)

int iterations_of(const ParameterSet& set) {
    return static_cast<int>(std::lround(set.back()));
}

/// True if the filter leaves the surface as it is.
bool moves_nothing(const FilterParameters& filter) {
    return std::visit([](const auto& p) { return p.lambda == 0.0; }, filter) &&
           !std::holds_alternative<LaplaceHcParameters>(filter);
}

}  // namespace

QualityTable::QualityTable(std::shared_ptr<const SmoothingEngine> engine, Chooser chooser,
                           std::size_t kept_bytes, Fidelity fidelity)
    : engine_(std::move(engine)),
      chooser_(std::move(chooser)),
      most_standing_(kept_bytes / std::max<std::size_t>(1, engine_->run_bytes())),
      fidelity_(fidelity) {}

bool QualityTable::knows(const ParameterSet& set) const {
    const auto at = columns_.find(ParameterSet(set.begin(), set.end() - 1));
    return at != columns_.end() &&
           (!at->second.choice || at->second.known.contains(iterations_of(set)));
}

QualityTable::Column& QualityTable::column_of(const ParameterSet& set) {
    const ParameterSet key(set.begin(), set.end() - 1);
    const auto [at, is_new] = columns_.try_emplace(key);
    if (is_new) at->second.choice = chooser_(key);
    return at->second;
}

std::vector<QualityTable::Task> QualityTable::tasks_for(std::span<const ParameterSet> sets) {
    std::vector<Task> tasks;
    std::map<const Column*, std::size_t> task_of;
    for (const ParameterSet& set : sets) {
        Column& column = column_of(set);
        const int iterations = iterations_of(set);
        if (!column.choice || column.known.contains(iterations)) continue;
        if (iterations == 0 || moves_nothing(column.choice->filter)) {
            column.known[iterations] = engine_->original();
            continue;
        }
        const auto [at, is_new] = task_of.try_emplace(&column, tasks.size());
        if (is_new) tasks.push_back({&column, {}, {}});
        tasks[at->second].wanted.push_back(iterations);
    }
    for (Task& task : tasks) {
        std::ranges::sort(task.wanted);
        const auto [first, last] = std::ranges::unique(task.wanted);
        task.wanted.erase(first, last);
    }
    return tasks;
}

/// A run that has not passed any of the wanted iterations.
std::unique_ptr<MeasuredRun> QualityTable::run_before(Task& task) const {
    const Column& column = *task.column;
    const auto before = column.standing.upper_bound(task.wanted.front());
    if (before != column.standing.begin()) return std::prev(before)->second->copy();
    ++task.work.runs;
    return fidelity_ == Fidelity::Full ? engine_->start(*column.choice)
                                       : engine_->start_estimate(*column.choice);
}

void QualityTable::run(Task& task, std::size_t may_stand, const Progress& progress) const {
    Column& column = *task.column;
    auto run = run_before(task);
    std::map<int, std::optional<QualityMeasures>> found;
    bool bounded = true;
    const auto measure = [&](std::span<const int> wanted) {
        for (const int iterations : wanted) found[iterations] = std::nullopt;
        if (!bounded) return;
        task.work.sweeps += static_cast<std::size_t>(wanted.back() - run->iterations());
        const auto measures = run->measure_at(wanted, progress);
        for (std::size_t i = 0; i < measures.size(); ++i) found[wanted[i]] = measures[i];
        task.work.evaluations += wanted.size();
        bounded = measures.size() == wanted.size();
    };
    std::span<const int> wanted = task.wanted;
    if (may_stand > 1 && wanted.size() > 1) {
        measure(wanted.first(1));
        if (bounded) column.standing[wanted.front()] = run->copy();
        wanted = wanted.subspan(1);
    }
    measure(wanted);
    if (may_stand > 0 && bounded) column.standing[wanted.back()] = std::move(run);
    column.known.merge(found);
}

void QualityTable::find(std::span<const ParameterSet> sets, const Progress& progress) {
    std::vector<Task> tasks = tasks_for(sets);
    std::size_t standing = 0;
    for (const auto& [key, column] : columns_) standing += column.standing.size();
    const std::size_t room = most_standing_ > standing ? most_standing_ - standing : 0;
    const auto run_one = [&](std::size_t i) {
        progress.check_cancelled();
        run(tasks[i], room / tasks.size(), progress.silent());
    };
    const auto count_work = [&] {
        for (const Task& task : tasks) {
            work_.evaluations += task.work.evaluations;
            work_.runs += task.work.runs;
            work_.sweeps += task.work.sweeps;
        }
    };
    try {
        if (engine_->concurrent())
            tbb::parallel_for(std::size_t{0}, tasks.size(), run_one);
        else
            for (std::size_t i = 0; i < tasks.size(); ++i) run_one(i);
    } catch (...) {
        count_work();
        throw;
    }
    count_work();
}

std::optional<QualityMeasures> QualityTable::at(const ParameterSet& set, const Progress& progress) {
    find({&set, 1}, progress);
    const Column& column = column_of(set);
    if (!column.choice) return std::nullopt;
    return column.known.at(iterations_of(set));
}

const QualityMeasures& QualityTable::strong(const Progress& progress) {
    if (strong_) return *strong_;
    const auto run = engine_->start({LaplaceParameters{1.0}, nullptr});
    run->advance_to(kStrong, progress);
    strong_ = run->measure();
    return *strong_;
}

std::string QualityTable::strong_name() const {
    return std::to_string(kStrong) + " iterations of laplace with lambda 1";
}

}  // namespace vesselbench
