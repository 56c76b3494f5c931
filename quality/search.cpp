#include "quality/search.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/errors.h"

namespace vesselbench {

namespace {

/// Scores that are this close are equal: rounding must not decide.
constexpr double kEqualScores = 1e-12;

bool better(const Suggestion& a, const Suggestion& b) {
    if (std::abs(a.score - b.score) > kEqualScores) return a.score < b.score;
    if (a.values.back() != b.values.back()) return a.values.back() < b.values.back();
    return a.values < b.values;
}

/// Calls visit for every combination of one element of each row.
template <class Row, class Visit>
void for_each_combination(const std::vector<Row>& rows, const Visit& visit) {
    std::vector<std::size_t> at(rows.size(), 0);
    for (bool more = true; more;) {
        visit(at);
        more = false;
        for (std::size_t i = rows.size(); i-- > 0 && !more;) {
            if (++at[i] < rows[i].size())
                more = true;
            else
                at[i] = 0;
        }
    }
}

std::vector<double> chosen_values(const SearchParameter& parameter, bool coarse) {
    if (!coarse) return parameter.values;
    std::vector<double> values;
    const auto step = static_cast<std::size_t>(std::max(1, parameter.coarse));
    for (std::size_t i = 0; i < parameter.values.size(); i += step)
        values.push_back(parameter.values[i]);
    if (values.back() != parameter.values.back()) values.push_back(parameter.values.back());
    return values;
}

}  // namespace

ParameterSearch::ParameterSearch(std::shared_ptr<const SmoothingEngine> engine, SearchSpace space,
                                 ScoreSettings settings)
    : space_(std::move(space)),
      settings_(settings),
      table_(engine, space_.chooser),
      estimates_(engine, space_.chooser, 0, Fidelity::Estimate) {
    for (const SearchParameter& parameter : space_.parameters)
        if (parameter.values.empty())
            throw InvalidInput("there is no value to search for " + parameter.name);
}

ParameterSet ParameterSearch::values_at(const Place& place) const {
    ParameterSet values;
    for (std::size_t i = 0; i < place.size(); ++i)
        values.push_back(space_.parameters[i].values[static_cast<std::size_t>(place[i])]);
    return values;
}

ParameterSearch::Place ParameterSearch::place_of(const ParameterSet& values) const {
    Place place;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto& all = space_.parameters[i].values;
        const auto nearest = std::ranges::min_element(all, [&](double a, double b) {
            return std::abs(a - values[i]) < std::abs(b - values[i]);
        });
        place.push_back(static_cast<int>(nearest - all.begin()));
    }
    return place;
}

Suggestion ParameterSearch::best_of(const std::vector<ParameterSet>& sets,
                                    const Progress& progress) {
    return best_in(table_, sets, progress);
}

QualityTable::Work ParameterSearch::work() const {
    const QualityTable::Work &full = table_.work(), &rough = estimates_.work();
    return {full.evaluations + rough.evaluations, full.runs + rough.runs,
            full.sweeps + rough.sweeps};
}

Suggestion ParameterSearch::estimated(const Progress& progress) {
    if (!table_.engine().estimates()) return exhaustive(true, progress);
    return best_of({best_in(estimates_, grid(true), progress).values}, progress);
}

Suggestion ParameterSearch::best_in(QualityTable& table, const std::vector<ParameterSet>& sets,
                                    const Progress& progress) {
    table.find(sets, progress);
    const ScoreBase base{table.engine().original(), table.engine().mean_edge()};
    std::optional<Suggestion> best;
    for (const ParameterSet& set : sets) {
        const auto measures = table.at(set, progress);
        if (!measures) continue;
        Suggestion one{.values = set,
                       .measures = *measures,
                       .terms = score_terms(base, *measures, settings_.form)};
        one.score = score(one.terms, settings_.tau);
        if (!best || better(one, *best)) best = std::move(one);
    }
    if (!best) throw InvalidInput("all parameter sets of the search would roughen the surface");
    return *best;
}

std::vector<ParameterSet> ParameterSearch::grid(bool coarse) const {
    std::vector<std::vector<double>> rows;
    for (const SearchParameter& parameter : space_.parameters)
        rows.push_back(chosen_values(parameter, coarse));
    std::vector<ParameterSet> sets;
    for_each_combination(rows, [&](const std::vector<std::size_t>& at) {
        ParameterSet set;
        for (std::size_t i = 0; i < at.size(); ++i) set.push_back(rows[i][at[i]]);
        sets.push_back(std::move(set));
    });
    return sets;
}

Suggestion ParameterSearch::exhaustive(bool coarse, const Progress& progress) {
    return best_of(grid(coarse), progress);
}

std::vector<ParameterSet> ParameterSearch::neighbourhood(const Place& centre,
                                                         const std::vector<int>& reach) const {
    std::vector<std::vector<int>> rows;
    for (std::size_t i = 0; i < centre.size(); ++i) {
        const int last = static_cast<int>(space_.parameters[i].values.size()) - 1;
        rows.push_back({centre[i]});
        for (const int place : {centre[i] - reach[i], centre[i] + reach[i]}) {
            const int inside = std::clamp(place, 0, last);
            if (std::ranges::find(rows.back(), inside) == rows.back().end())
                rows.back().push_back(inside);
        }
    }
    std::vector<ParameterSet> sets;
    for_each_combination(rows, [&](const std::vector<std::size_t>& at) {
        Place place;
        for (std::size_t i = 0; i < at.size(); ++i) place.push_back(rows[i][at[i]]);
        sets.push_back(values_at(place));
    });
    return sets;
}

void ParameterSearch::walk(Suggestion& best, const std::vector<int>& steps,
                           const Progress& progress) {
    for (bool moved = true; moved;) {
        const Suggestion next = best_of(neighbourhood(place_of(best.values), steps), progress);
        moved = better(next, best);
        if (moved) best = next;
    }
}

Suggestion ParameterSearch::descend(const Place& start, int reach, const Progress& progress) {
    Suggestion best = best_of({values_at(start)}, progress);
    for (int wide = reach, last = -1; wide != last; last = wide, wide /= 2) {  // 0: single steps
        std::vector<int> steps;
        for (const SearchParameter& parameter : space_.parameters)
            steps.push_back(std::max(1, static_cast<int>(parameter.values.size()) * wide / 20));
        walk(best, steps, progress);
    }
    return best;
}

Suggestion ParameterSearch::along_valley(Suggestion best, const Progress& progress) {
    const std::size_t count = best.values.size();
    // Many parameters have many neighbours, and many ways out of a valley.
    const std::vector<int> widths = count <= 3 ? std::vector{8, 5, 3, 2} : std::vector{3};
    for (Suggestion before; before.values != best.values;) {
        before = best;
        for (std::size_t i = 0; i < count && count > 1; ++i)
            for (const int wide : widths) {
                std::vector<int> steps(count, 1);
                steps[i] = wide;
                walk(best, steps, progress);
            }
    }
    return best;
}

Suggestion ParameterSearch::refined(const Suggestion& from, int reach, const Progress& progress) {
    return along_valley(descend(place_of(from.values), reach, progress), progress);
}

Suggestion ParameterSearch::pattern(int reach, const Progress& progress) {
    const auto near = [&](std::size_t i, double share) {
        return static_cast<int>(
            std::lround(share * static_cast<double>(space_.parameters[i].values.size() - 1)));
    };
    std::optional<Suggestion> best;
    const std::size_t count = space_.parameters.size();
    for (std::size_t largest = 0; largest < count; ++largest) {
        progress.report(static_cast<double>(largest) / static_cast<double>(count), "searching");
        Place start;
        for (std::size_t i = 0; i < count; ++i) start.push_back(near(i, i == largest ? 0.9 : 0.1));
        Suggestion found = descend(start, reach, progress);
        if (!best || better(found, *best)) best = std::move(found);
    }
    return along_valley(*best, progress);
}

Suggestion ParameterSearch::along(std::size_t parameter, const ParameterSet& current,
                                  const Progress& progress) {
    std::vector<ParameterSet> sets;
    for (const double value : space_.parameters.at(parameter).values) {
        sets.push_back(current);
        sets.back()[parameter] = value;
    }
    return best_of(sets, progress);
}

}  // namespace vesselbench
