#include "workbench/session/session_runner.h"

namespace vesselbench {

SessionRunner::SessionRunner(Session session, std::function<void()> notify)
    : session_(std::move(session)), notify_(std::move(notify)), snapshot_(session_.snapshot()) {
    session_.run_in_workers();
    thread_ = std::thread([this] { work(); });
}

SessionRunner::~SessionRunner() {
    {
        const std::lock_guard lock(mutex_);
        closing_ = true;
    }
    cancel_all();
    wake_.notify_all();
    thread_.join();
}

std::shared_ptr<const Snapshot> SessionRunner::snapshot() const {
    const std::lock_guard lock(mutex_);
    return snapshot_;
}

void SessionRunner::add(Request request) {
    std::vector<Request> superseded;
    {
        const std::lock_guard lock(mutex_);
        for (Request& older : waiting_)
            if (!request.supersede.empty() && older.supersede == request.supersede)
                superseded.push_back(std::move(older));
        std::erase_if(waiting_, [](const Request& older) { return older.core == nullptr; });
        waiting_.push_back(std::move(request));
    }
    for (const Request& older : superseded) older.core->cancel();
    wake_.notify_one();
}

void SessionRunner::cancel_all() {
    std::vector<std::shared_ptr<JobCore>> jobs;
    {
        const std::lock_guard lock(mutex_);
        if (running_) jobs.push_back(running_);
        for (const Request& request : waiting_) jobs.push_back(request.core);
    }
    for (const auto& job : jobs) job->cancel();
}

bool SessionRunner::idle() const {
    const std::lock_guard lock(mutex_);
    return waiting_.empty() && !running_;
}

void SessionRunner::work() {
    while (true) {
        Request request;
        {
            std::unique_lock lock(mutex_);
            wake_.wait(lock, [&] { return closing_ || !waiting_.empty(); });
            if (waiting_.empty()) return;
            request = std::move(waiting_.front());
            waiting_.pop_front();
            running_ = request.core;
            // A request that came while the runner was being closed.
            if (closing_) request.core->cancel();
        }
        run(std::move(request));
    }
}

void SessionRunner::run(Request request) {
    const std::shared_ptr<JobCore> core = request.core;
    std::exception_ptr error;
    const bool begun = core->begin();
    if (begun) {
        try {
            request.call(session_, JobCore::reporter(core));
        } catch (...) {
            error = std::current_exception();
        }
        publish();
    }
    request.call = nullptr;  // frees what it holds before the end is reported
    {
        const std::lock_guard lock(mutex_);
        running_.reset();
    }
    if (begun) core->end(error);
    if (notify_) notify_();
}

void SessionRunner::publish() {
    try {
        auto now = session_.snapshot();
        const std::lock_guard lock(mutex_);
        snapshot_.swap(now);
    } catch (const std::exception&) {
        // The project cannot be read any more: the next request that needs it says why.
    }
}

Job<LogEntry> SessionRunner::apply(std::string operation, Arguments given, EditOptions options) {
    return submit([=](Session& session, const Progress& progress) {
        return session.apply(operation, given, options, progress);
    });
}

Job<LogEntry> SessionRunner::change_edit(EditId id, Arguments given, EditOptions options) {
    return submit([=](Session& session, const Progress& progress) {
        return session.change_edit(id, given, options, progress);
    });
}

Job<Preview> SessionRunner::preview(std::string operation, Arguments given, EditOptions options,
                                    std::string supersede) {
    return submit(
        [=](Session& session, const Progress& progress) {
            return session.preview(operation, given, options, progress);
        },
        std::move(supersede));
}

Job<Preview> SessionRunner::preview_change(EditId id, Arguments given, EditOptions options,
                                           std::string supersede) {
    return submit(
        [=](Session& session, const Progress& progress) {
            return session.preview_change(id, given, options, progress);
        },
        std::move(supersede));
}

Job<LogEntry> SessionRunner::commit(Preview preview) {
    return submit([preview = std::move(preview)](Session& session, const Progress&) {
        return session.commit(preview);
    });
}

Job<Nothing> SessionRunner::remove_edit(EditId id) {
    return submit([id](Session& session, const Progress&) {
        session.remove_edit(id);
        return Nothing{};
    });
}

Job<Nothing> SessionRunner::undo() {
    return submit([](Session& session, const Progress&) {
        session.undo();
        return Nothing{};
    });
}

Job<Nothing> SessionRunner::undo(EditId before) {
    return submit([before](Session& session, const Progress&) {
        session.undo(before);
        return Nothing{};
    });
}

Job<Nothing> SessionRunner::redo() {
    return submit([](Session& session, const Progress&) {
        session.redo();
        return Nothing{};
    });
}

Job<Nothing> SessionRunner::redo(EditId to) {
    return submit([to](Session& session, const Progress&) {
        session.redo(to);
        return Nothing{};
    });
}

Job<Nothing> SessionRunner::jump(StateId state) {
    return submit([state](Session& session, const Progress&) {
        session.jump(state);
        return Nothing{};
    });
}

Job<Scene> SessionRunner::scene(std::string variant) {
    return submit([variant = std::move(variant)](Session& session, const Progress& progress) {
        return session.scene(variant, progress);
    });
}

Job<Scene> SessionRunner::scene_after(EditId id) {
    return submit([id](Session& session, const Progress& progress) {
        return session.scene_after(id, progress);
    });
}

Job<std::vector<ReplayEntry>> SessionRunner::replay() {
    return submit(
        [](Session& session, const Progress& progress) { return session.replay(progress); });
}

Job<Nothing> SessionRunner::save_as(std::filesystem::path project) {
    return submit([project = std::move(project)](Session& session, const Progress& progress) {
        session.save_as(project, progress);
        return Nothing{};
    });
}

Job<Nothing> SessionRunner::with_scene(std::string variant,
                                       std::function<void(const Scene&, const Progress&)> call) {
    constexpr double kSceneShare = 0.7;  // of the progress; the callback has the rest
    return submit([=](Session& session, const Progress& progress) {
        const Scene scene = session.scene(variant, progress.part(0.0, kSceneShare));
        call(scene, progress.part(kSceneShare, 1.0));
        return Nothing{};
    });
}

Job<SessionRunner::Live> SessionRunner::start_live(std::string operation, Arguments given,
                                                   EditOptions options) {
    return submit([=](Session& session, const Progress& progress) {
        return std::make_shared<LiveEdit>(session.start_live(operation, given, options, progress));
    });
}

Job<Scene> SessionRunner::add(Live live, Arguments more, std::string supersede) {
    return submit(
        [live = std::move(live), more = std::move(more)](Session&, const Progress& progress) {
            live->add(more, progress);
            return live->scene();
        },
        std::move(supersede));
}

Job<LogEntry> SessionRunner::commit(Live live) {
    return submit([live = std::move(live)](Session& session, const Progress& progress) {
        return session.commit(session.preview(*live, progress));
    });
}

}  // namespace vesselbench
