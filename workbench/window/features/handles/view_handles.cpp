#include "workbench/window/features/handles/view_handles.h"

#include <imgui.h>

#include "geometry/kernel/same_surface.h"
#include "workbench/window/core/core.h"
#include "workbench/window/features/handles/crop_handles.h"
#include "workbench/window/features/handles/cut_handles.h"
#include "workbench/window/features/handles/handles_feature.h"
#include "workbench/window/features/handles/length_handles.h"
#include "workbench/window/features/handles/neck_handles.h"
#include "workbench/window/features/handles/stretch_handles.h"
#include "workbench/window/features/handles/tool_handles.h"
#include "workbench/window/features/openings/openings_feature.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

namespace {

constexpr double kSnap = 0.4;  ///< a dragged length so near to a detent goes there [em]

const Surface* model_of(const PanelContext& c) {
    if (const Surface* before = c.core.get<OpeningsFeature>().openings().surface()) return before;
    const Scene* scene = c.core.document.current();
    return scene != nullptr && scene->surface && !scene->surface->empty() ? &*scene->surface
                                                                          : nullptr;
}

}  // namespace

void ViewHandles::forget() {
    take_cut(nullptr, std::nullopt);
    cut_form_.reset();
    deform_.forget();
    shape_ = {};
    openings_.clear();
    state_ = State::Idle;
    hot_.reset();
}

// --- what is shown

void ViewHandles::take_model(const PanelContext& c) {
    if (model_of(c) == nullptr)
        openings_.clear();
    else if (!c.core.document.previewed() && !c.core.searches_places())
        openings_ = c.core.surface_places().openings;
}

void ViewHandles::take_shape(const PanelContext& c) {
    const auto& form = c.core.form();
    const Surface* model = model_of(c);
    const bool cuts = form && model != nullptr && has_field(*form, Meaning::Planes);
    cut_form_.reset();
    if (cuts)
        cut_form_ = c.core.get<OpeningsFeature>().openings().lists_ends()
                        ? c.core.get<OpeningsFeature>().openings().cut_form()
                        : form;
    take_cut(model, cut_form_ ? cut_question(*cut_form_) : std::nullopt);
    const bool deforms = form && model != nullptr && deforms_branch(*form);
    deform_.update(model, deforms ? &*form : nullptr);
    shape_ = {};
    const auto& offered = c.core.get<HandlesFeature>().offered_box();
    if (form && offered)
        shape_ = crop_shape(*form, *offered);
    else if (!form || model == nullptr)
        return;
    else if (has_tool(*form))
        shape_ = tool_shape(*form, bounds(*model));
    else if (has_field(*form, Meaning::Openings))
        shape_ = length_shape(*form, openings_);
    else if (has_stretch(*form))
        shape_ = stretch_shape(*form);
    else if (has_field(*form, Meaning::Neck))
        shape_ = neck_shape(*form);
    else if (deforms && deform_.preview())
        shape_ = deform_shape(*form, *deform_.preview());
    else if (cut_form_ && cut_)
        shape_ = cut_shape(*cut_form_, *cut_);
    if (!c.core.armed().empty()) shape_.handles.clear();
}

/// Begins a search if the question or the surface is another one, and takes a result. While a plane
/// is dragged, the search that runs is completed, so that cuts are seen meanwhile.
void ViewHandles::take_cut(const Surface* surface, const std::optional<CutQuestion>& question) {
    if (surface == nullptr || !question) {
        search_.forget();
        asked_.reset();
        asked_surface_ = {};
        cut_.reset();
        return;
    }
    if (search_.poll()) {
        cut_ = search_.take();
        if (!cut_) cut_ = Cut{.problem = search_.problem()};
    }
    const bool same = same_surface(asked_surface_, *surface);
    if (same && asked_ == question) return;
    if (!same || !asked_ || asked_->tip != question->tip) {
        search_.forget();
        cut_.reset();
    }
    asked_ = question;
    asked_surface_ = *surface;
    search_.start_after([surface = asked_surface_, question = *question,
                         known = cut_ ? cut_->branch : nullptr](const Progress& progress) {
        return find_cut(surface, question, known, progress);
    });
}

// --- dragging

void ViewHandles::find_hot(const PanelContext& c, const PixelView& view, const ViewPixel& cursor) {
    hot_.reset();
    const bool pressed = ImGui::IsItemActive() && ImGui::IsMouseClicked(ImGuiMouseButton_Left);
    if (pressed || (ImGui::IsItemHovered() && !ImGui::IsAnyMouseDown()))
        hot_ = nearest_handle(shape_.handles, view, cursor, kHandleReach * c.ui.em);
}

void ViewHandles::begin(PanelContext& c, const PixelView& view, const ViewPixel& cursor) {
    start_ = {.index = *hot_,
              .handle = shape_.handles[*hot_],
              .cut = cut_,
              .cut_form = cut_form_,
              .branch = deform_.preview(),
              .openings = openings_,
              .cursor = cursor,
              .offset = cursor - view.place(shape_.handles[*hot_].point).value_or(cursor)};
    c.core.begin_drag();
    state_ = State::Dragging;
}

std::vector<FieldText> ViewHandles::texts(const PanelContext& c, const Vec3& to,
                                          double snap) const {
    const OperationForm& before = *c.core.before_drag();
    if (const auto& offered = c.core.get<HandlesFeature>().offered_box())
        return crop_texts(before, *offered, start_.index, to);
    if (has_tool(before))
        if (const Surface* model = model_of(c))
            return tool_texts(before, bounds(*model), start_.index, to);
    if (has_field(before, Meaning::Openings))
        return length_texts(before, start_.openings, start_.index, to, snap);
    if (has_stretch(before)) return stretch_texts(before, start_.index, to);
    if (has_field(before, Meaning::Neck)) return neck_texts(before, start_.index, to);
    if (start_.branch) return deform_texts(*start_.branch, start_.index, to);
    if (!start_.cut || !start_.cut_form) return {};
    std::vector<FieldText> moved = cut_texts(*start_.cut_form, *start_.cut, start_.index, to);
    const OpeningsModel& openings = c.core.get<OpeningsFeature>().openings();
    if (!openings.lists_ends()) return moved;
    return openings.dragged_texts(before, *start_.cut_form, *start_.cut, moved);
}

void ViewHandles::follow(PanelContext& c, const PixelView& view, const ViewPixel& cursor) {
    if (cursor == start_.cursor) return;
    const Vec3 to = dragged_point(start_.handle, view, cursor - start_.offset);
    const double snap = kSnap * c.ui.em * view.pixel_at(to);
    c.core.drag(texts(c, to, snap));
}

void ViewHandles::update(PanelContext& c, const PixelView& view) {
    take_model(c);
    take_shape(c);
    const ViewPixel cursor = mouse_pixel();
    if (state_ == State::Idle) {
        find_hot(c, view, cursor);
        if (hot_ && ImGui::IsItemActive() && ImGui::IsMouseClicked(ImGuiMouseButton_Left))
            begin(c, view, cursor);
        return;
    }
    if (state_ == State::Dragging && !c.core.before_drag()) state_ = State::Dropped;
    if (state_ == State::Dragging) {
        follow(c, view, cursor);
        take_shape(c);
    }
    if (ImGui::IsMouseDown(ImGuiMouseButton_Left)) return;
    c.core.end_drag();
    state_ = State::Idle;
}

Positions ViewHandles::beyond(const PixelView& screen) const {
    Positions places;
    bool outside = false;
    for (const Handle& handle : shape_.handles) {
        const auto seen = project(screen.camera, screen.aspect(), handle.point);
        outside = outside || !seen || seen->head<2>().cwiseAbs().maxCoeff() > 1.0;
        places.push_back(handle.point);
    }
    return outside ? places : Positions();
}

// --- drawing

void ViewHandles::draw_handle(PanelContext& c, const PixelView& screen, std::size_t index) const {
    const Handle& handle = shape_.handles[index];
    const auto place = screen.place(handle.point);
    if (!place || !can_be_dragged(handle, screen)) return;
    const bool lit = state_ == State::Dragging ? start_.index == index : hot_ == index;
    draw_handle_mark(c.ui, handle, *place, lit);
}

void ViewHandles::draw(PanelContext& c, const PixelView& screen) const {
    for (std::size_t i = 0; i < shape_.handles.size(); ++i) draw_handle(c, screen, i);
    for (const ViewNote& note : shape_.notes)
        if (const auto at = screen.place(note.point))
            draw_plate(c.ui,
                       {at->x() + c.ui.em * 1.1F, at->y() + c.ui.em * (note.below ? 1.8F : 0.0F)},
                       note.text);
    if (!c.core.armed().empty() || c.core.searches_places()) return;
    if (cut_ && !cut_->problem.empty()) return draw_hint(c.ui, rect_of(screen), cut_->problem);
    if (const auto& branch = deform_.preview(); branch && !branch->problem.empty())
        return draw_hint(c.ui, rect_of(screen), branch->problem);
    if (state_ == State::Idle && !hot_) return;
    ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
    if (state_ == State::Dragging)
        draw_hint(c.ui, rect_of(screen), start_.handle.help + "    Esc: restore");
    else if (hot_ && *hot_ < shape_.handles.size())
        draw_hint(c.ui, rect_of(screen), shape_.handles[*hot_].help);
}

}  // namespace vesselbench
