#include "workbench/window/model/cut_search.h"

#include "geometry/kernel/same_surface.h"

namespace vesselbench {

void CutSearch::update(const Surface* surface, const std::optional<CutQuestion>& question) {
    if (surface == nullptr || !question) {
        if (asked_) task_.forget();
        asked_.reset();
        cut_.reset();
        surface_ = {};
        return;
    }
    if (auto answer = task_.take()) cut_ = std::move(answer);
    if (std::string problem = task_.take_problem(); !problem.empty())
        cut_ = Cut{.problem = std::move(problem)};
    const bool same = same_surface(surface_, *surface);
    if (same && asked_ == question) return;
    if (!same || !asked_ || asked_->tip != question->tip) {
        task_.forget();
        cut_.reset();
    }
    asked_ = question;
    surface_ = *surface;
    task_.begin([surface = surface_, question = *question,
                 known = cut_ ? cut_->branch : nullptr](const Progress& progress) {
        return find_cut(surface, question, known, progress);
    });
}

}  // namespace vesselbench
