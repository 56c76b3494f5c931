#include "workbench/window/case/shown_scene.h"

#include <algorithm>
#include <utility>

#include "geometry/kernel/measure.h"
#include "workbench/session/known_results.h"
#include "workbench/session/source_counterpart.h"
#include "workbench/window/case/rail.h"

namespace vesselbench {

namespace {

/// Other models than the shown and the newest one: to close a form and open it again reads nothing.
constexpr int kOtherModels = 1;

const Scene* scene_at_hand(const Snapshot& snapshot, const std::string& variant) {
    if (pending_count(snapshot, variant) > 0) return nullptr;
    const auto variants = snapshot.history->variants();
    const bool own = std::ranges::count(variants, variant) > 0;
    const auto found = snapshot.scenes.find(own ? variant : "");
    return found == snapshot.scenes.end() ? nullptr : &found->second;
}

std::optional<PointDeviation> from_source(Session& session, EditId source,
                                          const std::string& variant, const Surface& surface,
                                          const Progress& progress) {
    const Scene from = session.scene_after(source, progress);
    if (!from.surface || from.surface->empty()) return std::nullopt;
    const auto comparable = comparable_vertices(surface, made_ends(session, variant, progress));
    return deviation_from(comparable_points(surface, comparable), *from.surface, progress);
}

}  // namespace

ShownScene::ShownScene(std::function<void(const std::string&)> report)
    : report_(std::move(report)) {}

// --- the scene

void ShownScene::follow(std::shared_ptr<const Snapshot> snapshot, std::string variant) {
    snapshot_ = std::move(snapshot);
    variant_ = std::move(variant);
    renew();
    models_.keep(newest_, 0);
}

void ShownScene::stand_before(const std::optional<EditSite>& site) {
    if (site_ == site) return;
    site_ = site;
    if (snapshot_) renew();
}

/// Finds out what should be shown, and shows it if it is at hand.
void ShownScene::renew() {
    newest_ = known_end(snapshot_->history->line(variant_));
    input_ = site_ ? input_of(*site_, *snapshot_->history, variant_) : std::nullopt;
    const ResultId wanted = input_ ? input_->result : newest_;
    if (wanted == std::exchange(wanted_, wanted)) return;
    const Scene* at_hand = scene_at_hand(*snapshot_, variant_);
    if (models_.shown() != nullptr && models_.shown()->result == wanted)
        model_.forget();
    else if (models_.show(wanted))
        model_changed();
    else if (wanted == 0)
        show(wanted, {});
    else if (wanted == newest_ && at_hand != nullptr)
        show(wanted, *at_hand);
    else
        model_.ask();
}

void ShownScene::show(ResultId result, Scene scene) {
    models_.put(result, std::move(scene));
    models_.keep(newest_, kOtherModels);
    model_changed();
}

void ShownScene::model_changed() {
    model_.forget();
    if (current()->surface && !models_.shown()->figures)
        figures_.ask();
    else
        figures_.forget();
    scene_changed();
}

void ShownScene::offer(ResultId result, const Scene& scene) {
    if (outdated() && wanted_ == result) show(result, scene);
}

const Scene* ShownScene::newest() const {
    const KnownModel* known = models_.find(newest_);
    return known != nullptr ? &known->scene : nullptr;
}

const ShownFigures& ShownScene::figures() const {
    static const ShownFigures kUnknown;
    const KnownModel* model = models_.shown();
    return model != nullptr && model->figures ? *model->figures : kUnknown;
}

void ShownScene::clear() {
    model_.forget();
    figures_.forget();
    deviation_.forget();
    source_.forget();
    snapshot_.reset();
    site_.reset();
    input_.reset();
    newest_ = wanted_ = kNone;
    models_.clear();
    preview_.reset();
    known_deviation_.reset();
    known_source_.reset();
    ++changes_;
}

void ShownScene::scene_changed() {
    ++changes_;
    ask_deviation();
    ask_source();
}

void ShownScene::show_preview(const Preview& preview) {
    preview_ = preview;
    scene_changed();
}

void ShownScene::drop_preview() {
    if (!preview_) return;
    preview_.reset();
    scene_changed();
}

// --- what is wanted

/// The last edit of the source's step, if other edits follow it.
std::optional<EditId> ShownScene::source_edit() const {
    std::optional<EditId> source;
    const auto line = input_ ? input_->before : snapshot_->history->line(variant_);
    for (const HistoryEntry& entry : line) {
        if (entry.status != EditStatus::Done) continue;
        if (entry.place.step != Step::Source) return source;
        source = entry.edit.id;
    }
    return std::nullopt;
}

void ShownScene::want_deviation(bool wanted) {
    if (wanted == std::exchange(wants_deviation_, wanted)) return;
    ask_deviation();
}

void ShownScene::ask_deviation() {
    known_deviation_.reset();
    if (wants_deviation_ && has_comparable())
        deviation_.ask();
    else
        deviation_.forget();
}

/// True if there is another surface for the deviation of this one.
bool ShownScene::has_comparable() const {
    if (scene() == nullptr || !scene()->surface) return false;
    return preview_ ? current() != nullptr && current()->surface : source_edit().has_value();
}

void ShownScene::want_source(bool wanted) {
    if (wanted == std::exchange(wants_source_, wanted)) return;
    known_source_.reset();
    ask_source();
}

void ShownScene::ask_source() {
    if (wants_source_ && current() != nullptr && source_edit()) return source_.ask();
    known_source_.reset();
    source_.forget();
}

// --- finding it

bool ShownScene::pending() const {
    return model_.wanted || figures_.wanted || deviation_.wanted || source_.wanted;
}

void ShownScene::pause() {
    model_.task.drop();
    figures_.task.drop();
    deviation_.task.drop();
    source_.task.drop();
}

void ShownScene::request(SessionRunner& runner) {
    if (model_.due()) model_.task = runner.result_scene(wanted_);
    if (model_.wanted) return;
    if (figures_.due()) request_figures(runner);
    if (deviation_.due()) request_deviation(runner);
    if (source_.due()) request_source(runner);
}

void ShownScene::request_figures(SessionRunner& runner) {
    figures_.task = runner.submit([source = source_edit(), variant = variant_, scene = *current()](
                                      Session& session, const Progress& progress) {
        ShownFigures figures;
        if (!scene.surface || scene.surface->empty()) return figures;
        figures.volume = volume(*scene.surface);
        figures.inside_out =
            *figures.volume < 0.0 && scene.surface->topology->boundary_loops().empty();
        if (source)
            figures.deviation = from_source(session, *source, variant, *scene.surface, progress);
        return figures;
    });
}

void ShownScene::request_deviation(SessionRunner& runner) {
    const std::optional<Scene> before = preview_ ? std::optional(*current()) : std::nullopt;
    deviation_.task = runner.submit([source = source_edit(), before, variant = variant_,
                                     scene = *scene()](Session& session, const Progress& progress) {
        const Surface& surface = surface_of(scene);
        if (before)
            return std::make_shared<const DeviationMap>(
                deviation_map(surface, surface_of(*before), {}, progress));
        const Scene from = session.scene_after(*source, progress);
        const auto compared = comparable_vertices(surface, made_ends(session, variant, progress));
        return std::make_shared<const DeviationMap>(
            deviation_map(surface, surface_of(from), compared, progress));
    });
}

void ShownScene::request_source(SessionRunner& runner) {
    source_.task = runner.scene_after(*source_edit());
}

// --- what has been found

/// Of a wish that failed, the reason is reported, and it is given up.
template <class Result>
std::optional<Result> ShownScene::taken(Wish<Result>& wish, const char* what) {
    if (!wish.task.poll()) return std::nullopt;
    wish.wanted = false;
    auto found = wish.task.take();
    if (!found) report_(std::string(what) + ": " + wish.task.problem());
    return found;
}

bool ShownScene::poll() {
    const bool model = poll_model(), figures = poll_figures();
    const bool deviation = poll_deviation(), source = poll_source();
    return model || figures || deviation || source;
}

bool ShownScene::poll_model() {
    if (!model_.wanted) return false;
    auto scene = taken(model_, "The model cannot be read");
    if (scene) {
        show(wanted_, std::move(*scene));
    } else if (!model_.wanted) {
        wanted_ = kNone;  // so that it is asked for again
        show(kNone, {});  // not another model
    }
    return !model_.wanted;
}

bool ShownScene::poll_figures() {
    const auto figures = taken(figures_, "The model cannot be measured");
    if (figures) models_.shown()->figures = *figures;
    return figures.has_value();
}

bool ShownScene::poll_deviation() {
    const auto map = taken(deviation_, "The deviation cannot be measured");
    if (map) known_deviation_ = *map;
    return map.has_value();
}

bool ShownScene::poll_source() {
    const auto scene = taken(source_, "The source cannot be read");
    if (scene) known_source_ = scene->surface;
    return scene.has_value();
}

}  // namespace vesselbench
