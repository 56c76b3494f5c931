#include "workbench/window/features/history/thumbnails.h"

#include <map>
#include <optional>
#include <utility>

#include <epoxy/gl.h>

#include "workbench/session/known_results.h"
#include "workbench/session/task.h"
#include "workbench/window/features/history/thumbnail_drawing.h"
#include "workbench/window/features/history/thumbnail_files.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostStates = 100;  ///< pictures of states in memory

Texture texture_of(const ClearPicture& picture) {
    unsigned id = 0;
    glGenTextures(1, &id);
    glBindTexture(GL_TEXTURE_2D, id);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, picture.width, picture.height, 0, GL_RGBA,
                 GL_UNSIGNED_BYTE, picture.rgba.data());
    glGenerateMipmap(GL_TEXTURE_2D);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glBindTexture(GL_TEXTURE_2D, 0);
    return Texture(id);
}

struct Made {
    ClearPicture picture;  ///< empty: there is no surface
    Texture texture;
};

}  // namespace

struct Thumbnails::Impl {
    Impl(const std::function<void()>& wake, fs::path folder)
        : cache(std::move(folder)), arrays(wake), writing(wake) {}

    void follow(const Document& document);
    void begin(const Document& document);
    void lay_out(const Scene& scene);
    void take_scene();
    void take_arrays(Renderer& renderer);
    void keep(const Document& document);
    [[nodiscard]] std::optional<ResultId> result_of(StateId state);

    [[nodiscard]] bool making() const { return reading.pending() || arrays.pending(); }

    fs::path cache;
    std::map<fs::path, Texture> projects;  ///< by their files
    bool may_load = true;                  ///< one file a frame
    bool loads_later = false;

    // Of the open case.
    fs::path project;
    std::string variant;
    std::shared_ptr<const History> history;
    std::map<StateId, ResultId> results;  ///< of the states asked for
    std::map<ResultId, Made> made;
    std::optional<StateId> wanted;
    ResultId making_result = 0;  ///< what is read or laid out
    Task<Scene> reading;
    Task<DrawingArrays> arrays;
    ResultId kept = 0;  ///< whose picture is the project's
    Task<Nothing> writing;
    std::optional<ThumbnailDrawing> drawing;
};

Thumbnails::Thumbnails(std::function<void()> wake, fs::path cache)
    : impl_(std::make_unique<Impl>(std::move(wake), std::move(cache))) {}

Thumbnails::~Thumbnails() = default;

bool Thumbnails::pending() const {
    return impl_->wanted || impl_->making() || impl_->writing.pending() || impl_->loads_later;
}

void Thumbnails::update(const Document& document, Renderer& renderer) {
    static_cast<void>(impl_->writing.poll());
    impl_->may_load = true;
    impl_->loads_later = false;
    impl_->follow(document);
    impl_->take_scene();
    impl_->take_arrays(renderer);
    if (!document.is_open()) return;
    impl_->keep(document);
    if (impl_->wanted && !impl_->making() && !document.busy()) impl_->begin(document);
}

/// Forgets what belongs to another case or state of it.
void Thumbnails::Impl::follow(const Document& document) {
    const auto now = document.is_open() ? document.snapshot()->history : nullptr;
    if (project != document.project()) {
        project = document.project();
        made.clear();
        reading = {};
        arrays.forget();
        making_result = kept = 0;
    }
    if (now == history && variant == document.variant()) return;
    history = now;
    variant = document.variant();
    results.clear();
    wanted.reset();
}

std::optional<ResultId> Thumbnails::Impl::result_of(StateId state) {
    if (!history || !history->states().contains(state)) return std::nullopt;
    const auto found = results.find(state);
    if (found != results.end()) return found->second;
    const ResultId result = known_results(*history, {state}, variant).front();
    results[state] = result;
    return result;
}

/// The newest model is at hand, others are read.
void Thumbnails::Impl::begin(const Document& document) {
    const StateId state = *std::exchange(wanted, std::nullopt);
    making_result = result_of(state).value_or(0);
    if (making_result == 0 || made.contains(making_result)) return;
    if (made.size() >= kMostStates) made.clear();
    if (state == history->current() && document.newest() != nullptr)
        return lay_out(*document.newest());
    reading = document.runner()->submit(
        [state, variant = variant](Session& session, const Progress& progress) {
            return session.known_scene(state, variant, progress);
        },
        "thumbnail");
}

void Thumbnails::Impl::take_scene() {
    if (!reading.poll()) return;  // one that was cancelled is asked for again when it is seen again
    if (const auto scene = reading.take())
        lay_out(*scene);
    else
        made[making_result] = {};  // no picture
}

void Thumbnails::Impl::lay_out(const Scene& scene) {
    if (!scene.surface || scene.surface->empty()) {
        made[making_result] = {};
        return;
    }
    arrays.start([surface = *scene.surface](const Progress&) { return thumbnail_arrays(surface); });
}

void Thumbnails::Impl::take_arrays(Renderer& renderer) {
    if (!arrays.poll()) return;
    auto ready = arrays.take();
    Made& entry = made[making_result];
    entry = {};  // no picture
    if (!ready) return;
    try {
        if (!drawing) drawing.emplace();
        entry.picture = drawing->draw(renderer, std::move(*ready));
        entry.texture = texture_of(entry.picture);
    } catch (const std::exception&) {
        entry = {};
    }
}

/// Keeps the current state's picture as the project's, and asks for it if it is missing.
void Thumbnails::Impl::keep(const Document& document) {
    if (document.newest() == nullptr || writing.pending()) return;
    const ResultId now = result_of(history->current()).value_or(0);
    if (now == 0 || now == kept) return;
    const auto found = made.find(now);
    if (found == made.end()) {
        if (!wanted) wanted = history->current();
        return;
    }
    kept = now;
    if (found->second.picture.rgba.empty()) return;
    projects.erase(thumbnail_file(cache, project));
    writing.start_after(
        [cache = cache, project = project, picture = found->second.picture](const Progress&) {
            save_thumbnail(cache, project, picture);
            return Nothing{};
        });
}

unsigned Thumbnails::of_state(StateId state) {
    const ResultId result = impl_->result_of(state).value_or(0);
    if (result == 0) return 0;
    const auto found = impl_->made.find(result);
    if (found != impl_->made.end()) return found->second.texture.id();
    if (!impl_->wanted) impl_->wanted = state;
    return 0;
}

unsigned Thumbnails::of_project(const fs::path& project) {
    const fs::path file = thumbnail_file(impl_->cache, project);
    const auto found = impl_->projects.find(file);
    if (found != impl_->projects.end()) return found->second.id();
    if (!std::exchange(impl_->may_load, false)) {
        impl_->loads_later = true;
        return 0;
    }
    Texture& texture = impl_->projects[file];
    if (const auto picture = saved_thumbnail(impl_->cache, project)) texture = texture_of(*picture);
    return texture.id();
}

}  // namespace vesselbench
