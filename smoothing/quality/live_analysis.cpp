#include "smoothing/quality/live_analysis.h"

#include <exception>
#include <utility>

#include "geometry/kernel/errors.h"

namespace vesselbench {

void analyse_step_by_step(ParameterSearch& graphs, ParameterSearch& best,
                          const ParameterSet& current,
                          const std::function<void(const LiveAnswer&)>& send,
                          const Progress& progress) {
    LiveAnswer known{.analysis = sensitivity(graphs, current, true, progress)};
    send(known);
    known.analysis = sensitivity(graphs, current, false, progress);
    send(known);
    known.best = best.first_look({}, progress);
    send(known);
    known.best = best.settled(*known.best, progress);
    known.complete = true;
    send(known);
}

LiveAnalysis::LiveAnalysis(ParameterSearch search, Receiver receiver)
    : search_(std::move(search)),
      receiver_(std::move(receiver)),
      worker_([this](const std::stop_token& end) { work(end); }) {}

LiveAnalysis::~LiveAnalysis() {
    const std::lock_guard lock(mutex_);
    waiting_.reset();
    current_.request_stop();
    worker_.request_stop();
}

std::uint64_t LiveAnalysis::ask(ParameterSet current, ScoreSettings settings) {
    const std::lock_guard lock(mutex_);
    current_.request_stop();
    current_ = std::stop_source();
    waiting_ = Request{++asked_, std::move(current), settings, current_.get_token()};
    changed_.notify_all();
    return asked_;
}

void LiveAnalysis::wait() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return !waiting_ && !busy_; });
}

void LiveAnalysis::work(const std::stop_token& end) {
    std::unique_lock lock(mutex_);
    while (changed_.wait(lock, end, [&] { return waiting_.has_value(); })) {
        const Request request = *std::exchange(waiting_, std::nullopt);
        busy_ = true;
        lock.unlock();
        try {
            answer(request);
        } catch (const Cancelled&) {  // a newer request is waiting, or the end
        } catch (const std::exception& error) {
            send(request, {.request = request.number, .complete = true, .error = error.what()});
        }
        lock.lock();
        busy_ = false;
        changed_.notify_all();
    }
}

void LiveAnalysis::send(const Request& request, const LiveAnswer& answer) {
    if (!request.stop.stop_requested()) receiver_(answer);
}

void LiveAnalysis::answer(const Request& request) {
    search_.set_score(request.settings);
    analyse_step_by_step(
        search_, search_, request.current,
        [&](const LiveAnswer& answer) {
            LiveAnswer numbered = answer;
            numbered.request = request.number;
            send(request, numbered);
        },
        Progress(nullptr, request.stop));
}

}  // namespace vesselbench
