#include "smoothing/quality/pattern_search.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "geometry/kernel/errors.h"
#include "smoothing/quality/combinations.h"

namespace vesselbench {

namespace {

constexpr const char* kSearching = "searching";

/// Scores this close are equal: rounding must not decide.
constexpr double kEqualScores = 1e-12;

bool better(const Suggestion& a, const Suggestion& b) {
    if (std::abs(a.score - b.score) > kEqualScores) return a.score < b.score;
    if (a.values.back() != b.values.back()) return a.values.back() < b.values.back();
    return a.values < b.values;
}

}  // namespace

Suggestion best_of(MeasureSource& table, const std::vector<ParameterSet>& sets,
                   const ScoreSettings& settings, const Progress& progress) {
    table.find(sets, progress);
    const ScoreBase base{table.original(), table.mean_edge(), settings.volume_weight};
    std::optional<Suggestion> best;
    for (const ParameterSet& set : sets) {
        const auto measures = table.at(set, progress);
        if (!measures) continue;
        Suggestion one{.values = set,
                       .measures = *measures,
                       .terms = score_terms(base, *measures, settings.form)};
        one.score = score(one.terms, settings.tau);
        if (!best || better(one, *best)) best = std::move(one);
    }
    if (!best) throw InvalidInput("no parameter set of the search is usable on this surface");
    return *best;
}

ParameterSet PatternSearch::values_at(const Place& place) const {
    ParameterSet values;
    for (std::size_t i = 0; i < place.size(); ++i)
        values.push_back(space_.parameters[i].values[static_cast<std::size_t>(place[i])]);
    return values;
}

PatternSearch::Place PatternSearch::place_of(const ParameterSet& values) const {
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

std::vector<ParameterSet> PatternSearch::neighbourhood(const Place& centre,
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
    for (const Place& place : combinations(rows)) sets.push_back(values_at(place));
    return sets;
}

void PatternSearch::walk(Suggestion& best, const std::vector<int>& steps,
                         const Progress& progress) const {
    for (bool moved = true; moved;) {
        const Suggestion next =
            best_of(table_, neighbourhood(place_of(best.values), steps), settings_, progress);
        moved = better(next, best);
        if (moved) best = next;
    }
}

Suggestion PatternSearch::descend(const Place& start, int reach, const Progress& progress) const {
    Suggestion best = best_of(table_, {values_at(start)}, settings_, progress);
    const double stages = std::bit_width(static_cast<unsigned>(reach)) + 1.0;
    for (int wide = reach, last = -1; wide != last; last = wide, wide /= 2) {  // 0: single steps
        progress.report(1.0 - std::bit_width(static_cast<unsigned>(wide)) / stages, kSearching);
        std::vector<int> steps;
        for (const SearchParameter& parameter : space_.parameters)
            steps.push_back(std::max(1, static_cast<int>(parameter.values.size()) * wide / 20));
        walk(best, steps, progress);
    }
    return best;
}

Suggestion PatternSearch::along_valley(Suggestion best, const Progress& progress) const {
    const std::size_t count = best.values.size();
    // Many parameters have many neighbours, and many ways out of a valley.
    const std::vector<int> widths = count <= 3 ? std::vector{8, 5, 3, 2} : std::vector{3};
    double left = 1.0;  // the number of rounds is unknown
    for (Suggestion before; before.values != best.values; left *= 0.5) {
        before = best;
        progress.report(1.0 - left, kSearching);
        for (std::size_t i = 0; i < count && count > 1; ++i)
            for (const int wide : widths) {
                std::vector<int> steps(count, 1);
                steps[i] = wide;
                walk(best, steps, progress);
            }
    }
    return best;
}

Suggestion PatternSearch::from(const ParameterSet& start, int reach,
                               const Progress& progress) const {
    return along_valley(descend(place_of(start), reach, progress.part(0.0, 0.5)),
                        progress.part(0.5, 1.0));
}

Suggestion PatternSearch::from_starts(int reach, const Progress& progress) const {
    const auto near = [&](std::size_t i, double share) {
        return static_cast<int>(
            std::lround(share * static_cast<double>(space_.parameters[i].values.size() - 1)));
    };
    std::optional<Suggestion> best;
    const std::size_t count = space_.parameters.size();
    const double part = 0.8 / static_cast<double>(count);
    for (std::size_t largest = 0; largest < count; ++largest) {
        const double done = part * static_cast<double>(largest);
        Place start;
        for (std::size_t i = 0; i < count; ++i) start.push_back(near(i, i == largest ? 0.9 : 0.1));
        Suggestion found = descend(start, reach, progress.part(done, done + part));
        if (!best || better(found, *best)) best = std::move(found);
    }
    return along_valley(*best, progress.part(0.8, 1.0));
}

}  // namespace vesselbench
