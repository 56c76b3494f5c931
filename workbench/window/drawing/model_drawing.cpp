#include "workbench/window/drawing/model_drawing.h"

#include <algorithm>
#include <utility>

#include "geometry/kernel/same_surface.h"
#include "gpu/picture.h"

namespace vesselbench {

namespace {

constexpr double kTransparent = 0.35;  ///< opacity of a transparent model [-]

}  // namespace

ModelDrawing::ModelDrawing(std::function<void()> wake) : task_(std::move(wake)) {}

void ModelDrawing::show(const Scene* scene) {
    late_.clear();
    deviation_.reset();
    // A stroke that was entered is drawn already.
    const bool drawn = drawn_ && !task_.pending() && scene != nullptr && scene->surface &&
                       same_surface(shown_, *scene->surface);
    if (drawn) return;
    task_.forget();
    problem_.clear();
    if (scene == nullptr || !scene->surface || scene->surface->empty())
        release();
    else
        lay_out(*scene->surface);
}

/// Holds nothing of a model that is no longer shown: it may be of a closed case.
void ModelDrawing::release() {
    drawn_.reset();
    shown_ = {};
    uploaded_.reset();
    colours_.reset();
}

void ModelDrawing::reshape(const Surface& surface) {
    late_.clear();
    if (!drawn_ || task_.pending() || !same_surface(shown_, surface)) lay_out(surface);
}

void ModelDrawing::lay_out(const Surface& surface) {
    const auto known = drawn_ ? drawn_->arrays().layout : nullptr;
    task_.start_after(
        [surface, known](const Progress&) { return prepare_drawing(surface, known); });
}

bool ModelDrawing::update() {
    new_ = false;
    bool changed = std::exchange(moved_, false);
    if (task_.poll()) {
        if (auto arrays = task_.take()) {
            upload([&] { take(std::move(*arrays)); });
            new_ = drawn_ != nullptr;
        } else {
            fail(task_.problem());
        }
        changed = true;
    }
    upload([&] { changed = upload_values() || changed; });
    return std::exchange(moved_, false) || changed;
}

/// What the device has no memory for is not drawn at all: half of it would be of another scene.
template <class Work>
void ModelDrawing::upload(const Work& work) {
    try {
        work();
    } catch (const std::exception& error) {
        fail(error.what());
    }
}

void ModelDrawing::fail(const std::string& problem) {
    drawn_.reset();
    late_.clear();
    problem_ = problem;
    moved_ = true;
}

void ModelDrawing::take(DrawingArrays arrays) {
    problem_.clear();
    if (drawn_ && drawn_->arrays().layout == arrays.layout) {
        drawn_->move_all(std::move(arrays));
    } else {
        drawn_.reset();  // not both at once
        drawn_ = std::make_shared<DrawnSurface>(std::move(arrays));
        uploaded_.reset();
    }
    shown_ = drawn_->surface();
    follow_late();
}

// --- dabs

void ModelDrawing::move(const SceneMove& move) {
    if (task_.pending())
        late_.push_back(move);
    else if (drawn_ && same_surface(shown_, surface_of(move.before)))
        follow(move);
    else
        lay_out(surface_of(move.after));
}

/// The moves that came while the surface was laid out: those since it.
void ModelDrawing::follow_late() {
    const std::vector<SceneMove> late = std::exchange(late_, {});
    if (late.empty() || same_surface(shown_, surface_of(late.back().after))) return;
    auto next = std::ranges::find_if(
        late, [&](const SceneMove& move) { return same_surface(shown_, surface_of(move.before)); });
    for (; next != late.end(); ++next) move(*next);
    if (!task_.pending() && !same_surface(shown_, surface_of(late.back().after)))
        lay_out(surface_of(late.back().after));
}

void ModelDrawing::follow(const SceneMove& move) {
    const Surface& after = surface_of(move.after);
    upload([&] {
        if (shown_.positions != after.positions) drawn_->move(after.points(), move.changed);
        const bool coloured = uploaded_ && uploaded_ == painted_values();
        shown_ = after;
        moved_ = true;
        if (!coloured) return;
        uploaded_ = painted_values();
        drawn_->set_values(*uploaded_, move.changed);
    });
}

// --- colours

void ModelDrawing::set_deviation(std::shared_ptr<const DeviationMap> deviation) {
    deviation_ = std::move(deviation);
}

ModelDrawing::Values ModelDrawing::painted_values() const {
    const auto found = shown_.attributes.find(painted_);
    return found == shown_.attributes.end() ? nullptr : found->second;
}

ModelDrawing::Values ModelDrawing::wanted_values() const {
    if (!painted_.empty()) return painted_values();
    if (colours_ && colours_->values.size() == shown_.vertex_count())
        return {colours_, &colours_->values};
    return deviation_ ? Values(deviation_, &deviation_->values) : nullptr;
}

bool ModelDrawing::upload_values() {
    if (!drawn_ || task_.pending()) return false;
    const Values wanted = wanted_values();
    if (wanted == uploaded_ || (wanted && wanted->size() != shown_.vertex_count())) return false;
    uploaded_ = wanted;
    drawn_->set_values(uploaded_ ? std::span<const double>(*uploaded_) : std::span<const double>());
    return true;
}

const Surface* ModelDrawing::surface() const {
    return drawn_ ? &shown_ : nullptr;
}

bool ModelDrawing::shows_weight() const {
    return drawn_ && drawn_->has_values() && uploaded_ && uploaded_ == painted_values();
}

bool ModelDrawing::shows_deviation(const ViewLook& look) const {
    return look.deviation && deviation_ && drawn_ && drawn_->has_values() &&
           uploaded_.get() == &deviation_->values;
}

bool ModelDrawing::shows_colouring() const {
    return colours_ && drawn_ && drawn_->has_values() && uploaded_.get() == &colours_->values;
}

ValueRange ModelDrawing::colour_range() const {
    if (typed_range_) return *typed_range_;
    if (shows_colouring()) return colours_->range;
    return deviation_ ? ValueRange{-deviation_->full, deviation_->full} : ValueRange{};
}

void ModelDrawing::colour(SurfaceLayer& layer, const ViewLook& look) const {
    if (shows_weight()) {
        layer.colouring = Colouring::Values;
    } else if (shows_deviation(look) || shows_colouring()) {
        layer.colouring = Colouring::Values;
        layer.map = shows_colouring() ? ColourMap::Ordered : ColourMap::Diverging;
        layer.least = colour_range().least;
        layer.most = colour_range().most;
    }
}

Layers ModelDrawing::layers(const ViewLook& look, double edge_width) const {
    Layers layers;
    if (!drawn_) return layers;
    SurfaceLayer layer{.source = drawn_, .id = kModelLayer, .colouring = Colouring::Patches};
    layer.patch_colours = patch_colours(drawn_->surface());
    if (look.coarse && !look.edges) layer.detail = Detail::Coarse;
    layer.flat = look.flat;
    layer.opacity = look.transparent ? kTransparent : 1.0;
    layer.edges = look.edges ? Edges::Over : Edges::Off;
    layer.edge_width = edge_width;
    colour(layer, look);
    layers.surfaces.push_back(std::move(layer));
    return layers;
}

}  // namespace vesselbench
