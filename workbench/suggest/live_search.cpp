#include "workbench/suggest/live_search.h"

#include <utility>

#include "workbench/suggest/live_filter_search.h"
#include "workbench/suggest/live_processing_search.h"
#include "workbench/suggest/processing_subject.h"

namespace vesselbench {

LiveSearch::LiveSearch(const Operation& operation, Scene scene)
    : way_(searches_filter(operation.search)
               ? live_filter_search(operation, std::move(scene))
               : live_processing_search(operation, std::move(scene))) {}

void LiveSearch::answer(const Arguments& given, double tau, const Receiver& receive,
                        const Progress& progress) {
    way_->answer(given, tau, receive, progress);
}

void LiveSearch::answer_dragged(const Arguments& given, double tau, const Receiver& receive,
                                const Progress& progress) {
    way_->answer_dragged(given, tau, receive, progress);
}

}  // namespace vesselbench
