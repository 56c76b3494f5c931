#include "workbench/window/features/openings/openings_model.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "geometry/kernel/same_surface.h"
#include "workbench/operations/shared/opening_arguments.h"

namespace vesselbench {

namespace {

/// A flat end that is kept is shown by a section just behind it [diameters].
constexpr double kBehindCap = 0.01;

bool opens_ends(const OperationForm& form) {
    return form.operation().recipe.cuts_ends;
}

std::string text_in(const std::vector<FieldText>& texts, const std::string& parameter) {
    const auto found = std::ranges::find(texts, parameter, &FieldText::parameter);
    return found == texts.end() ? "" : found->text;
}

}  // namespace

// --- following the form

bool OpeningsModel::update(const Document& document, const OperationForm* form) {
    const auto before = std::exchange(pointed_, std::exchange(next_pointed_, std::nullopt));
    has_form_ = form != nullptr && document.is_open() && opens_ends(*form);
    has_tip_ = has_form_ && !form->field("tip").text.empty();
    if (!lists_ends()) {
        forget();
        return before != pointed_;
    }
    operation_ = &form->operation();
    take_input(document);
    take();
    ask(*form);
    const std::pair now(form->edit(), form->changes());
    const bool changed = new_plan_ || seen_ != now;
    if (changed) renew(*form);
    seen_ = now;
    return changed || before != pointed_;
}

void OpeningsModel::forget() {
    input_.reset();
    reading_ = false;
    if (asked_ || task_.pending()) task_.forget();
    asked_.reset();
    planned_.reset();
    surface_ = {};
    rows_.clear();
    problem_.clear();
    selected_.reset();
    fixes_plan_ = false;
}

void OpeningsModel::take_input(const Document& document) {
    reading_ = document.is_reading();
    input_problem_ = document.why_not_input();
    const Scene* scene = document.current();
    if (scene != nullptr && !reading_ && input_problem_.empty())
        input_ = *scene;
    else
        input_.reset();
}

/// A plan of other wishes is of no use.
void OpeningsModel::take() {
    if (!task_.poll()) return;
    if (auto answer = task_.take()) {
        if (answer->question != asked_) return;
        plain_ = plain_arguments(answer->question);
        planned_ = std::move(answer->planned);
        problem_ = planned_->problem;
        new_plan_ = true;
    }
    if (!task_.problem().empty()) {
        problem_ = task_.problem();
        planned_.reset();
        new_plan_ = true;
    }
}

void OpeningsModel::ask(const OperationForm& form) {
    const Surface* surface = this->surface();
    if (surface == nullptr) return await_model();
    if (!form.valid()) return;
    Arguments question = planning_arguments(form.arguments());
    const bool same = same_surface(surface_, *surface);
    if (same && asked_ == question) return;
    const bool known = same && planned_ && plain_ == plain_arguments(question);
    if (!known) planned_.reset();
    asked_ = question;
    surface_ = *surface;
    problem_.clear();
    new_plan_ = true;
    task_.forget();
    task_.start([operation = operation_, scene = *input_, question = std::move(question),
                 plain = known ? planned_->plain : nullptr](const Progress& progress) {
        PlannedEnds planned = plan_ends(*operation, scene, question, plain, progress);
        return Answer{question, std::move(planned)};
    });
}

/// There is nothing to plan on, at least for now.
void OpeningsModel::await_model() {
    const std::string reason =
        input_problem_.empty() && !reading_ ? "there is no surface yet" : input_problem_;
    new_plan_ = new_plan_ || planned_ || problem_ != reason;
    problem_ = reason;
    if (asked_) task_.forget();
    asked_.reset();
    planned_.reset();
}

void OpeningsModel::renew(const OperationForm& form) {
    new_plan_ = false;
    rows_.clear();
    fixes_plan_ = false;
    if (!planned_) return;
    const EndChoices choices = choices_in(form, *planned_);
    fixes_plan_ = choices.fixes_plan();
    rows_ = rows_of(choices, *planned_);
    if (selected_ && row(*selected_) == nullptr) selected_.reset();
}

const EndRow* OpeningsModel::row(int number) const {
    const auto found = std::ranges::find(rows_, number, &EndRow::number);
    return found == rows_.end() ? nullptr : &*found;
}

const Surface* OpeningsModel::surface() const {
    const bool has_surface = lists_ends() && input_ && input_->surface;
    return has_surface && !input_->surface->empty() ? &*input_->surface : nullptr;
}

void OpeningsModel::select_near(const Vec3& point) {
    if (planned_) selected_ = planned_->number_at(point);
}

// --- wishes

std::vector<FieldText> OpeningsModel::wish_texts(const OperationForm& form, int number,
                                                 EndWish wish) const {
    if (!planned_) return {};
    return texts_of(with_wish(choices_in(form, *planned_), *planned_, number, wish), *planned_);
}

std::vector<FieldText> OpeningsModel::inlet_texts(const OperationForm& form, int number) const {
    if (!planned_) return {};
    return texts_of(with_another_inlet(choices_in(form, *planned_), *planned_, number), *planned_);
}

std::vector<FieldText> OpeningsModel::move_texts(const OperationForm& form, int number,
                                                 const std::optional<Plane>& cut) const {
    if (!planned_) return {};
    EndChoices choices = choices_in(form, *planned_);
    choices.cuts.erase(number);
    if (cut) choices.cuts.emplace(number, *cut);
    return texts_of(choices, *planned_);
}

std::vector<FieldText> OpeningsModel::plain_texts() const {
    return planned_ ? texts_of({}, *planned_) : std::vector<FieldText>();
}

/// The planes of a plan that has changed. A plan that failed has none.
std::vector<FieldText> OpeningsModel::due_texts(const OperationForm& form) const {
    if (!planned_ || !planned_->chosen || !fixes_plan_ || pending()) return {};
    std::vector<FieldText> texts = texts_of(choices_in(form, *planned_), *planned_);
    std::erase_if(texts, [&](const FieldText& field) {
        return field.parameter != "planes" && field.parameter != "names" &&
               field.parameter != "closings";
    });
    return texts;
}

// --- dragging

std::optional<OperationForm> OpeningsModel::cut_form() const {
    const EndRow* end = selected_ ? row(*selected_) : nullptr;
    if (end == nullptr || !end->cut) return std::nullopt;
    PlannedOpening opening = *end->cut;
    Plane& plane = opening.place.plane;
    if (opening.way != OpeningWay::Cut) plane.point -= kBehindCap * end->diameter * plane.normal;
    opening.way = OpeningWay::Cut;
    const Patch patch{"cut", PatchKind::Outlet};
    return OperationForm(*operation_, {{"tip", opening.place.tip},
                                       {"planes", planes_argument({&opening, 1})},
                                       {"names", names_argument({&patch, 1})}});
}

std::vector<FieldText> OpeningsModel::dragged_texts(const OperationForm& form,
                                                    const OperationForm& cut_form, const Cut& cut,
                                                    const std::vector<FieldText>& texts) const {
    if (!planned_ || texts.empty() || !cut.branch) return {};
    const auto number = planned_->number_at(cut_form.arguments().point("tip"));
    if (!number) return {};
    OperationForm moved = cut_form;
    moved.set("planes", text_in(texts, "planes"));
    const std::vector<PlannedOpening> openings = openings_in(records_of(moved, "planes"));
    if (!openings.empty()) return move_texts(form, *number, openings.front().place.plane);
    // Hardly tilted: perpendicular to the centerline.
    moved.set("distance", text_in(texts, "distance"));
    const double distance = number_of(moved, "distance").value_or(cut.distance);
    return move_texts(form, *number,
                      Plane{cut.branch->place(distance), cut.branch->outward(distance)});
}

}  // namespace vesselbench
