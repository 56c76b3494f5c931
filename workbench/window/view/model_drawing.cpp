#include "workbench/window/view/model_drawing.h"

#include <chrono>

namespace vesselbench {

namespace {

constexpr double kTransparent = 0.35;  ///< opacity of a transparent model [-]

/// Wall, then a colour for each opening: inlets blue, outlets and others in turn.
std::vector<Colour> colours_of_patches(const Surface& surface) {
    static const Colour inlet(0.08F, 0.25F, 0.60F);
    std::vector<Colour> colours;
    std::size_t next = 0;
    for (const Patch& patch : surface.patches) {
        if (patch.kind == PatchKind::Wall)
            colours.push_back(kWallColour);
        else
            colours.push_back(patch.kind == PatchKind::Inlet ? inlet : category_colour(++next));
    }
    return colours;
}

}  // namespace

ModelDrawing::ModelDrawing(std::function<void()> wake) : wake_(std::move(wake)) {}

void ModelDrawing::show(const Scene* scene) {
    wanted_.reset();
    deviation_.reset();
    uploaded_.reset();
    if (scene == nullptr || !scene->surface || scene->surface->empty()) {
        drawn_.reset();
        return;
    }
    wanted_ = scene->surface;
    if (!next_.valid()) begin();
}

void ModelDrawing::begin() {
    const Surface surface = *std::exchange(wanted_, std::nullopt);
    std::optional<DrawingArrays> previous;
    if (drawn_) previous = drawn_->arrays();
    next_ = std::async(std::launch::async, [surface, previous, wake = wake_] {
        DrawingArrays arrays = prepare_drawing(surface, previous ? &*previous : nullptr);
        if (wake) wake();
        return arrays;
    });
}

bool ModelDrawing::update() {
    using namespace std::chrono_literals;
    bool changed = false;
    if (next_.valid() && next_.wait_for(0s) == std::future_status::ready) {
        DrawingArrays arrays = next_.get();
        if (wanted_) {
            begin();
        } else {
            drawn_ = std::make_shared<DrawnSurface>(std::move(arrays));
            changed = true;
        }
    }
    return upload_values() || changed;
}

void ModelDrawing::set_deviation(std::shared_ptr<const DeviationMap> deviation) {
    deviation_ = std::move(deviation);
}

bool ModelDrawing::upload_values() {
    const bool fits =
        !deviation_ ||
        (drawn_ && !next_.valid() && deviation_->values.size() == drawn_->surface().vertex_count());
    if (deviation_ == uploaded_ || !drawn_ || !fits) return false;
    uploaded_ = deviation_;
    drawn_->set_values(uploaded_ ? std::span<const double>(uploaded_->values)
                                 : std::span<const double>());
    return true;
}

const Surface* ModelDrawing::surface() const {
    return drawn_ ? &drawn_->surface() : nullptr;
}

bool ModelDrawing::shows_deviation(const ViewLook& look) const {
    return look.deviation && drawn_ && drawn_->has_values() && uploaded_;
}

Layers ModelDrawing::layers(const ViewLook& look, double edge_width) const {
    Layers layers;
    if (!drawn_) return layers;
    SurfaceLayer layer{.source = drawn_, .id = kModelLayer, .colouring = Colouring::Patches};
    layer.patch_colours = colours_of_patches(drawn_->surface());
    layer.flat = look.flat;
    layer.opacity = look.transparent ? kTransparent : 1.0;
    layer.edges = look.edges ? Edges::Over : Edges::Off;
    layer.edge_width = edge_width;
    if (shows_deviation(look)) {
        layer.colouring = Colouring::Values;
        layer.map = ColourMap::Diverging;
        layer.least = -uploaded_->full;
        layer.most = uploaded_->full;
    }
    layers.surfaces.push_back(std::move(layer));
    return layers;
}

}  // namespace vesselbench
