#include "quality/score.h"

#include <cmath>
#include <sstream>

#include "geometry/errors.h"

namespace vesselbench {

namespace {

/// value / base; where the original has nothing to compare with, nothing changes.
double ratio(double value, double base, double otherwise) {
    return base != 0.0 ? value / base : otherwise;
}

}  // namespace

ScoreForm score_form_from(const std::string& name) {
    if (name == "default") return ScoreForm::Default;
    if (name == "thesis") return ScoreForm::Thesis;
    throw InvalidInput("score '" + name + "' is neither default nor thesis");
}

std::string to_string(ScoreForm form) {
    return form == ScoreForm::Default ? "default" : "thesis";
}

ScoreTerms score_terms(const ScoreBase& base, const QualityMeasures& measures, ScoreForm form) {
    const QualityMeasures& original = base.original;
    const double volume =
        ratio(std::abs(measures.volume - original.volume), std::abs(original.volume), 0.0);
    if (form == ScoreForm::Thesis)
        return {ratio(measures.curvature, original.curvature, 1.0),
                measures.error_thesis / (original.error_thesis + 1.0), volume};
    return {ratio(measures.curvature_abs, original.curvature_abs, 1.0),
            kErrorWeight * ratio(measures.error, base.mean_edge, 0.0), kVolumeWeight * volume};
}

double score(const ScoreTerms& terms, double tau) {
    if (!(tau >= 0.0 && tau <= 1.0)) {
        std::ostringstream text;
        text << "tau = " << tau << " is not in [0, 1]";
        throw InvalidInput(text.str());
    }
    return tau * terms.curvature + (1.0 - tau) * 0.5 * (terms.error + terms.volume);  // (6.6)
}

}  // namespace vesselbench
