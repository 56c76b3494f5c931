#include "smoothing/quality/live_analysis.h"

#include <exception>
#include <utility>

#include "geometry/kernel/errors.h"

namespace vesselbench {

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
    const Progress progress(nullptr, request.stop);
    search_.set_score(request.settings);
    LiveAnswer known{.request = request.number,
                     .analysis = sensitivity(search_, request.current, true, progress)};
    send(request, known);
    known.analysis = sensitivity(search_, request.current, false, progress);
    send(request, known);
    known.best = search_.first_look({}, progress);
    send(request, known);
    known.best = search_.settled(*known.best, progress);
    known.complete = true;
    send(request, known);
}

}  // namespace vesselbench
