#include "workbench/suggest/suggestion_search.h"

#include "geometry/errors.h"

namespace vesselbench {

namespace {

constexpr std::size_t kMostForGrid = 3;  // parameters: the coarse grid of four takes too long

}  // namespace

SearchWay search_way_from(const std::string& name) {
    if (name == "automatic") return SearchWay::Automatic;
    if (name == "coarse") return SearchWay::Coarse;
    if (name == "exhaustive") return SearchWay::Exhaustive;
    if (name == "pattern") return SearchWay::Pattern;
    throw UsageError("--search: '" + name + "' is none of automatic, coarse, exhaustive, pattern");
}

SuggestionSearch::SuggestionSearch(const SearchSubject& subject, ScoreSettings settings,
                                   SearchWay way, bool planes)
    : subject_(subject),
      way_(way),
      settings_(settings),
      chosen_(engine_for(subject, planes || settings.form == ScoreForm::Thesis)),
      search_(chosen_.engine, space_for(subject), settings) {
    if (way_ == SearchWay::Automatic && space().parameters.size() > kMostForGrid)
        way_ = SearchWay::Pattern;
}

Suggestion SuggestionSearch::suggest(double tau, const Progress& progress) {
    if (!(tau >= 0.0 && tau <= 1.0))
        throw UsageError("--tau is a target smoothness from 0 (accurate) to 1 (smooth)");
    settings_.tau = tau;
    search_.set_score(settings_);
    switch (way_) {
        case SearchWay::Coarse:
            return search_.exhaustive(true, progress);
        case SearchWay::Exhaustive:
            return search_.exhaustive(false, progress);
        case SearchWay::Pattern:
            return from_pattern(progress);
        case SearchWay::Automatic:
            break;
    }
    return search_.refined(search_.estimated(progress.part(0.0, 0.7)), 2, progress.part(0.7, 1.0));
}

Suggestion SuggestionSearch::from_pattern(const Progress& progress) {
    const bool many = space().parameters.size() > kMostForGrid;
    const Suggestion found =
        many && last_ ? search_.refined(*last_, 8, progress) : search_.pattern(8, progress);
    last_ = found;
    return found;
}

std::vector<ParameterSet> SuggestionSearch::coarse_sets() const {
    return search_.grid(true);
}

std::optional<QualityMeasures> SuggestionSearch::measures(const ParameterSet& set,
                                                          const Progress& progress) {
    return search_.table().at(set, progress);
}

Surface SuggestionSearch::smoothed(const ParameterSet& set, const Progress& progress) const {
    return smoothed_with(subject_, space(), set, progress);
}

}  // namespace vesselbench
