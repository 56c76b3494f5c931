#include "workbench/window/features/slices/image_slices.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/kernel/same_surface.h"

namespace vesselbench {

namespace {

bool same_voxels(const Image& a, const Image& b) {
    return a.voxels == b.voxels && a.size == b.size && a.index_to_patient == b.index_to_patient;
}

bool same_mask(const std::optional<Image>& a, const std::optional<Image>& b) {
    return a.has_value() == b.has_value() && (!a || same_voxels(*a, *b));
}

bool same_outline(const std::optional<Surface>& a, const std::optional<Surface>& b) {
    return a.has_value() == b.has_value() && (!a || same_shape(*a, *b));
}

}  // namespace

struct ImageSlices::Order {
    int version = 0;  ///< of the image
    Image image;
    std::optional<Image> mask;
    std::optional<Surface> surface;
    SliceGrid grid;
    std::optional<ImageFigures> figures;
    std::vector<std::pair<SlicePlane, double>> places;

    [[nodiscard]] SliceContent content(SlicePlane plane, double position) const {
        const bool labels = figures->kind == ImageKind::Labels;
        SliceContent content{.plane = plane, .position = position};
        content.image =
            slice_of(image, grid, plane, position, labels ? Between::Nearest : Between::Linear);
        if (mask) content.mask = slice_of(*mask, grid, plane, position, Between::Nearest);
        if (surface) content.outline = outline_of(*surface, plane, position);
        content.border = border_of(image, plane, position);
        return content;
    }
};

ImageSlices::ImageSlices(std::function<void()> wake) : task_(std::move(wake)) {}

// --- following the scene

void ImageSlices::clear() {
    image_ = {};
    mask_.reset();
    surface_.reset();
    figures_.reset();
    contents_ = {};
    had_ = {};
    problem_.clear();
    ++image_version_;
    row_ = lent_row_ = typed_grey_ = was_shown_ = until_surface_ = false;
    space_.fill(false);
}

bool ImageSlices::update(const Scene* scene, const Surface* followed) {
    const bool had_image = has_image();
    if (scene != nullptr) {
        if (!scene->image || scene->image->empty())
            take_image({}, *scene);
        else if (!same_voxels(image_, *scene->image) || !same_mask(mask_, scene->mask))
            take_image(*scene->image, *scene);
        if (followed != nullptr)
            take_surface(*followed);
        else
            take_surface(scene->surface);
        show_first_image(scene->surface);
    }
    const bool changed = take_made();
    if (!task_.pending()) start();
    return changed || had_image != has_image();
}

/// Of a case that has no surface yet; once, so that what the user hides stays hidden. The first
/// surface is not hidden by the planes; while one is only previewed, they step aside.
void ImageSlices::show_first_image(const std::optional<Surface>& surface) {
    if (!has_image()) return;
    if (!std::exchange(was_shown_, true) && !surface_) {
        row_ = true;
        space_.fill(true);
        until_surface_ = true;
    }
    const bool there = surface && !surface->empty();
    if (there && std::exchange(until_surface_, false)) space_.fill(false);
}

void ImageSlices::take_image(const Image& image, const Scene& scene) {
    if (image.empty() && image_.empty()) return;
    const bool first = image_.empty(), moved = first || image.empty() || !same_grid(image_, image);
    if (!same_voxels(image_, image)) figures_.reset();
    image_ = image;
    mask_ = image.empty() ? std::nullopt : scene.mask;
    ++image_version_;
    if (image.empty()) {
        contents_ = {};
        return;
    }
    if (!moved) return;
    grid_ = slice_grid(image_);
    const bool on_surface = scene.surface && !scene.surface->empty();
    if (first)
        set_cross(on_surface ? bounds(*scene.surface).centre() : 0.5 * (grid_.low + grid_.high()));
    else
        set_cross(cross_);
}

void ImageSlices::take_surface(const std::optional<Surface>& surface) {
    if (same_outline(surface_, surface)) return;
    surface_ = surface && !surface->empty() ? surface : std::nullopt;
    ++surface_version_;
}

void ImageSlices::take_figures(const ImageFigures& figures) {
    if (figures_) return;
    figures_ = figures;
    if (!typed_grey_ || figures.kind == ImageKind::Labels) reset_grey();
}

// --- making slices

ImageSlices::Wish ImageSlices::wish(SlicePlane plane) const {
    return {image_version_, surface_version_, position(plane)};
}

/// True if it is shown, but was asked for with other contents.
bool ImageSlices::outdated(SlicePlane plane) const {
    return (in_row() || in_space(plane)) && had_[number(plane)] != wish(plane);
}

bool ImageSlices::pending() const {
    return task_.pending() ||
           std::ranges::any_of(kSlicePlanes, [this](SlicePlane plane) { return outdated(plane); });
}

void ImageSlices::start() {
    if (!has_image()) return;
    Order order{image_version_, image_, mask_, surface_, grid_, figures_, {}};
    for (const SlicePlane plane : kSlicePlanes) {
        if (!outdated(plane)) continue;
        had_[number(plane)] = wish(plane);
        order.places.emplace_back(plane, position(plane));
    }
    if (order.places.empty()) return;
    task_.start([order = std::move(order)](const Progress&) { return made(order); });
}

ImageSlices::Made ImageSlices::made(Order order) {
    if (!order.figures) order.figures = figures_of(order.image);
    Made made{.image = order.version, .figures = *order.figures};
    for (const auto& [plane, position] : order.places)
        made.contents.push_back(
            std::make_shared<const SliceContent>(order.content(plane, position)));
    return made;
}

bool ImageSlices::take_made() {
    if (!task_.poll()) return false;
    const auto made = task_.take();
    problem_ = task_.problem();
    if (!made) return true;
    if (made->image != image_version_) return false;
    take_figures(made->figures);
    for (const auto& content : made->contents) contents_[number(content->plane)] = content;
    return true;
}

// --- what, where and how

bool ImageSlices::any_in_space() const {
    return std::ranges::any_of(kSlicePlanes, [this](SlicePlane plane) { return in_space(plane); });
}

void ImageSlices::set_cross(const Vec3& point) {
    if (has_image() && point.allFinite()) cross_ = grid_.snapped(point);
}

void ImageSlices::move(SlicePlane plane, double position) {
    Vec3 point = cross_;
    point[axes_of(plane).normal] = position;
    set_cross(point);
}

void ImageSlices::step(SlicePlane plane, int slices) {
    move(plane, position(plane) + slices * grid_.step[axes_of(plane).normal]);
}

void ImageSlices::set_grey(const GreyWindow& grey) {
    if (!(grey.window > 0) || !std::isfinite(grey.window) || !std::isfinite(grey.level)) return;
    grey_ = grey;
    typed_grey_ = true;
}

void ImageSlices::reset_grey() {
    typed_grey_ = false;
    if (figures_) grey_ = figures_->automatic;
}

std::optional<float> ImageSlices::value_at(const Vec3& point) const {
    return voxel_at(image_, point);
}

std::optional<int> ImageSlices::label_at(const Vec3& point) const {
    if (!mask_ && !shows_labels()) return std::nullopt;
    const auto value = voxel_at(mask_ ? *mask_ : image_, point);
    if (!value || std::lround(*value) <= 0) return std::nullopt;
    return static_cast<int>(std::lround(*value));
}

}  // namespace vesselbench
