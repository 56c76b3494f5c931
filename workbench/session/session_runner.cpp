#include "workbench/session/session_runner.h"

namespace vesselbench {

SessionRunner::SessionRunner(Session session, std::function<void()> notify)
    : session_(std::move(session)),
      snapshot_(session_.snapshot()),
      thread_(TaskThread::WhenIdle::Waits,
              {.called = [this] { publish(); }, .ended = std::move(notify), .closing = {}}) {
    session_.run_in_workers();
}

std::shared_ptr<const Snapshot> SessionRunner::snapshot() const {
    const std::lock_guard lock(mutex_);
    return snapshot_;
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

Task<LogEntry> SessionRunner::apply(std::string operation, Arguments given, EditOptions options) {
    return submit([=](Session& session, const Progress& progress) {
        return session.apply(operation, given, options, progress);
    });
}

Task<LogEntry> SessionRunner::change_edit(EditId id, Arguments given, EditOptions options) {
    return submit([=](Session& session, const Progress& progress) {
        return session.change_edit(id, given, options, progress);
    });
}

Task<Preview> SessionRunner::preview(std::string operation, Arguments given, EditOptions options,
                                     std::string supersede) {
    return submit(
        [=](Session& session, const Progress& progress) {
            return session.preview(operation, given, options, progress);
        },
        std::move(supersede));
}

Task<Preview> SessionRunner::preview_change(EditId id, Arguments given, EditOptions options,
                                            std::string supersede) {
    return submit(
        [=](Session& session, const Progress& progress) {
            return session.preview_change(id, given, options, progress);
        },
        std::move(supersede));
}

Task<LogEntry> SessionRunner::commit(Preview preview) {
    return submit([preview = std::move(preview)](Session& session, const Progress&) {
        return session.commit(preview);
    });
}

Task<Nothing> SessionRunner::remove_edit(EditId id) {
    return submit([id](Session& session, const Progress&) {
        session.remove_edit(id);
        return Nothing{};
    });
}

Task<Nothing> SessionRunner::undo() {
    return submit([](Session& session, const Progress&) {
        session.undo();
        return Nothing{};
    });
}

Task<Nothing> SessionRunner::undo(EditId before) {
    return submit([before](Session& session, const Progress&) {
        session.undo(before);
        return Nothing{};
    });
}

Task<Nothing> SessionRunner::redo() {
    return submit([](Session& session, const Progress&) {
        session.redo();
        return Nothing{};
    });
}

Task<Nothing> SessionRunner::redo(EditId to) {
    return submit([to](Session& session, const Progress&) {
        session.redo(to);
        return Nothing{};
    });
}

Task<Nothing> SessionRunner::jump(StateId state) {
    return submit([state](Session& session, const Progress&) {
        session.jump(state);
        return Nothing{};
    });
}

Task<Scene> SessionRunner::scene(std::string variant) {
    return submit([variant = std::move(variant)](Session& session, const Progress& progress) {
        return session.scene(variant, progress);
    });
}

Task<Scene> SessionRunner::scene_after(EditId id) {
    return submit([id](Session& session, const Progress& progress) {
        return session.scene_after(id, progress);
    });
}

Task<Scene> SessionRunner::result_scene(ResultId id) {
    return submit([id](Session& session, const Progress& progress) {
        return session.result_scene(id, progress);
    });
}

Task<std::vector<ReplayEntry>> SessionRunner::replay() {
    return submit(
        [](Session& session, const Progress& progress) { return session.replay(progress); });
}

Task<Nothing> SessionRunner::save_as(std::filesystem::path project) {
    return submit([project = std::move(project)](Session& session, const Progress& progress) {
        session.save_as(project, progress);
        return Nothing{};
    });
}

Task<Nothing> SessionRunner::with_scene(std::string variant,
                                        std::function<void(const Scene&, const Progress&)> call) {
    constexpr double kSceneShare = 0.7;  // of the progress; the callback has the rest
    return submit([=](Session& session, const Progress& progress) {
        const Scene scene = session.scene(variant, progress.part(0.0, kSceneShare));
        call(scene, progress.part(kSceneShare, 1.0));
        return Nothing{};
    });
}

Task<SessionRunner::Live> SessionRunner::start_live(std::string operation, Arguments given,
                                                    EditOptions options) {
    return submit([=](Session& session, const Progress& progress) {
        return std::make_shared<LiveEdit>(session.start_live(operation, given, options, progress));
    });
}

Task<Scene> SessionRunner::add(Live live, Arguments more, std::string supersede) {
    return submit(
        [live = std::move(live), more = std::move(more)](Session&, const Progress& progress) {
            live->add(more, progress);
            return live->scene();
        },
        std::move(supersede));
}

Task<LogEntry> SessionRunner::commit(Live live) {
    return submit([live = std::move(live)](Session& session, const Progress& progress) {
        return session.commit(session.preview(*live, progress));
    });
}

}  // namespace vesselbench
