#include "smoothing/quality/score.h"

#include <cmath>
#include <sstream>

#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

/// value / base; no change if the original's value is 0.
double ratio(double value, double base, double otherwise) {
    return base != 0.0 ? value / base : otherwise;
}

}  // namespace

ScoreForm score_form_from(const std::string& name) {
    if (name == "default") return ScoreForm::Default;
    if (name == "thesis") return ScoreForm::Thesis;
    if (name == "compact") return ScoreForm::Compact;
    throw UsageError("score '" + name + "' is unknown: use default, thesis or compact");
}

std::string to_string(ScoreForm form) {
    switch (form) {
        case ScoreForm::Default:
            return "default";
        case ScoreForm::Thesis:
            return "thesis";
        case ScoreForm::Compact:
            return "compact";
    }
    return "";
}

std::string target_name(ScoreForm form) {
    return form == ScoreForm::Compact ? "triangles" : "curvature";
}

ScoreTerms score_terms(const ScoreBase& base, const QualityMeasures& measures, ScoreForm form) {
    const QualityMeasures& original = base.original;
    const double volume =
        ratio(std::abs(measures.volume - original.volume), std::abs(original.volume), 0.0);
    if (form == ScoreForm::Thesis)
        return {ratio(measures.curvature, original.curvature, 1.0),
                measures.error_thesis / (original.error_thesis + 1.0), volume};
    const double target = form == ScoreForm::Compact
                              ? ratio(measures.triangles, original.triangles, 1.0)
                              : ratio(measures.curvature_abs, original.curvature_abs, 1.0);
    return {target, kErrorWeight * ratio(measures.error, base.mean_edge, 0.0),
            base.volume_weight * volume};
}

double score(const ScoreTerms& terms, double tau) {
    if (!(tau >= 0.0 && tau <= 1.0)) {
        std::ostringstream text;
        text << "tau = " << tau << " is not in [0, 1]";
        throw InvalidInput(text.str());
    }
    return tau * terms.target + (1.0 - tau) * 0.5 * (terms.error + terms.volume);  // (6.6)
}

}  // namespace vesselbench
