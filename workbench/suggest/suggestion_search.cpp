#include "workbench/suggest/suggestion_search.h"

#include "geometry/kernel/errors.h"

namespace vesselbench {

SearchWay search_way_from(const std::string& name) {
    if (name == "automatic") return SearchWay::Automatic;
    if (name == "coarse") return SearchWay::Coarse;
    if (name == "exhaustive") return SearchWay::Exhaustive;
    if (name == "pattern") return SearchWay::Pattern;
    throw UsageError("--search: '" + name +
                     "' is unknown: use automatic, coarse, exhaustive or pattern");
}

SuggestionSearch::SuggestionSearch(const SearchSubject& subject, ScoreForm form, SearchWay way,
                                   bool planes)
    : subject_(subject),
      way_(way),
      chosen_(engine_for(subject, planes || form == ScoreForm::Thesis)),
      search_(search_for(subject, chosen_, space_for(subject, chosen_), {.form = form})) {}

Suggestion SuggestionSearch::suggest(double tau, const Progress& progress) {
    if (!(tau >= 0.0 && tau <= 1.0))
        throw UsageError("--tau is a target smoothness from 0 (accurate) to 1 (smooth)");
    search_.set_score({.form = form(), .tau = tau});
    switch (way_) {
        case SearchWay::Coarse:
            return search_.exhaustive(true, progress);
        case SearchWay::Exhaustive:
            return search_.exhaustive(false, progress);
        case SearchWay::Pattern:
            return search_.pattern(8, progress);
        case SearchWay::Automatic:
            break;
    }
    last_ = search_.settled(search_.first_look(last_, progress.part(0.0, 0.7)),
                            progress.part(0.7, 1.0));
    return *last_;
}

std::vector<ParameterSet> SuggestionSearch::coarse_sets() const {
    return search_.grid(true);
}

std::optional<QualityMeasures> SuggestionSearch::measures(const ParameterSet& set,
                                                          const Progress& progress) {
    return search_.table().at(set, progress);
}

Surface SuggestionSearch::changed(const ParameterSet& set, const Progress& progress) const {
    return changed_with(subject_, space(), set, progress);
}

}  // namespace vesselbench
