#include "workbench/window/model/workplace.h"

#include <algorithm>
#include <utility>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "workbench/operations/table.h"
#include "workbench/report/measure_table.h"
#include "workbench/window/model/opening_roles.h"
#include "workbench/window/model/rail.h"
#include "workbench/window/model/user_folders.h"

namespace vesselbench {

namespace {

/// The edit that loaded the image; none: no edit did.
std::optional<EditId> image_edit(const Snapshot& snapshot) {
    const std::string& loading = loading_operation(InputKind::Image).name;
    for (const LogEntry& entry : snapshot.log)
        if (entry.edit.operation == loading) return entry.edit.edit.id;
    return std::nullopt;
}

}  // namespace

Workplace::Workplace(DocumentOptions options, Settings remembered, const LiveDevice& live)
    : document(options),
      settings(std::move(remembered)),
      measures(options.wake),
      search_(options.wake),
      view_data_(options.wake),
      slices_(options.wake),
      wake_(options.wake),
      live_(options.wake, live),
      quality_(options.wake),
      gallery_(options.wake),
      extraction_(options.wake),
      openings_(options.wake),
      automatic_(options.wake),
      labels_(std::move(options.wake)) {}

bool Workplace::update() {
    const bool changed = document.poll();
    pointed_ = std::exchange(next_pointed_, std::nullopt);
    if (seen_opened_ != document.opened()) {
        seen_opened_ = document.opened();
        settings.remember(document.project());
        settings.save_soon();
        slices_.clear();
        choose_step(Step::Source);
        comparison_.reset();
        view = {};
        end_spots();
        gallery_.spots.open(document.project(), document.snapshot()->read_only_reason);
        end_measures();
        measures.open(document.project(), document.snapshot()->read_only_reason);
    }
    if (seen_snapshots_ != document.snapshot_changes()) renew_lists();
    if (seen_entered_ != document.entered()) {
        seen_entered_ = document.entered();
        if (applied_form_ == form_number_) end_applied_form();
    }
    tell_difference();
    const bool compared = comparison_ && document.is_open() && comparison_->update(document);
    const bool places = update_places();
    const bool view_data = view_data_.update(document, view, settings.layers);
    const bool live = update_live();
    const bool openings = update_openings();
    const bool new_slices = update_slices();
    const bool measured = update_measures();
    offered_.update(document.current(), form_ ? &*form_ : nullptr);
    // What is dragged is followed by the model: a search would take its time.
    const bool automatic = !before_drag_ && automatic_.update(document, form_ ? &*form_ : nullptr);
    const bool labels = labels_.update(document, form_ ? &*form_ : nullptr);
    return labels || automatic || openings || live || view_data || places || new_slices ||
           compared || measured || changed;
}

bool Workplace::update_live() {
    const LiveSmoothing::Followed followed{
        .document = document, .form = form_ ? &*form_ : nullptr, .colouring = view.colouring};
    const bool live = live_.update(followed);
    tell_fallback();
    if (view.flies) end_models_gallery();
    const bool gallery = gallery_.update(followed, live_);
    // Three suggestions that are waited for, and whatever runs, come first.
    const bool busy = gallery_.searches() || document.activity().has_value();
    const bool quality = quality_.update(followed, busy           ? QualityPace::Paused
                                                   : is_driving() ? QualityPace::Dragged
                                                                  : QualityPace::Full);
    const bool extraction = extraction_.update(followed);
    return live || gallery || quality || extraction;
}

/// Texts that fix a plan follow it, but not what is being dragged.
bool Workplace::update_openings() {
    const bool changed = openings_.update(document, form_ ? &*form_ : nullptr);
    if (changed && form_ && !before_drag_) fill_form(openings_.due_texts(*form_));
    return changed;
}

/// A distance is not continued on another model, or after another tool.
bool Workplace::update_measures() {
    const std::pair now(view.tool, document.scene_changes());
    if (std::exchange(measured_with_, now) != now) measures.begin_next();
    return measures.update();
}

/// The outline in the slices is that of the surface in the view.
bool Workplace::update_slices() {
    const auto& followed = extraction_.shown();
    return slices_.update(document.shown(), followed ? &followed->state.surface : nullptr);
}

void Workplace::end_applied_form() {
    form_.reset();
    disarm();
    end_drag();
    document.stand_before({});
}

/// What was applied is computed by the CPU, and taken back where it would cross itself: a user who
/// saw something else is told.
void Workplace::tell_difference() {
    if (!applied_live_ || form_ || document.is_reading()) return;
    const Scene* scene = document.current();
    if (scene == nullptr || !scene->surface || scene->surface->positions == applied_to_) return;
    const std::shared_ptr<const LiveModel> seen = std::exchange(applied_live_, nullptr);
    const std::string difference = difference_text(seen->state.surface, *scene->surface);
    if (difference.empty()) return;
    document.tell(make_message(MessageKind::Remark,
                               "The result differs from the live preview by " + difference));
}

/// Slower previews have a reason.
void Workplace::tell_fallback() {
    if (told_fallback_ || !live_.model() || live_.model()->reason.empty()) return;
    told_fallback_ = true;
    document.tell(make_message(MessageKind::Remark,
                               "Live smoothing continues on the CPU: " + live_.model()->reason));
}

bool Workplace::update_places() {
    const bool tips = form_ && wants_tips(*form_) && !document.previewed();
    const bool same_scene = searched_scenes_ == document.scene_changes();
    if (!same_scene) forget_role_question();
    if (!same_scene || (tips && !searched_tips_)) {
        searched_scenes_ = document.scene_changes();
        searched_tips_ = tips;
        search_places(document.shown(), tips);
    }
    if (!search_.poll()) return false;
    auto places = search_.take();
    places_ = places ? std::move(*places) : SurfacePlaces{.problem = search_.problem()};
    return true;
}

/// Of no surface there are no places.
void Workplace::search_places(const Scene* scene, bool tips) {
    search_.forget();
    places_ = {};
    if (scene == nullptr || !scene->surface || scene->surface->empty()) return;
    search_.start([surface = *scene->surface, tips](const Progress& progress) {
        return places_of(surface, tips, progress);
    });
}

void Workplace::renew_lists() {
    seen_snapshots_ = document.snapshot_changes();
    unit_question_.reset();
    if (!document.is_open()) {
        rail_ = empty_rail();
        history_ = {};
        return;
    }
    rail_ = rail_of(*document.snapshot(), document.variant());
    history_ = history_tree(*document.snapshot());
    unit_question_ = vesselbench::unit_question(*document.snapshot());
}

void Workplace::answer_unit(const std::string& unit) {
    const LogEntry* entry =
        unit_question_ ? find_entry(*document.snapshot(), unit_question_->edit) : nullptr;
    if (entry == nullptr || !can_change()) return;
    Arguments given = entry->edit.given;
    given.set("units", unit);
    leave_form();
    document.change(entry->edit.edit.id, std::move(given));
}

// --- cases

bool Workplace::can_add_mask() const {
    return can_change() && image_edit(*document.snapshot()).has_value();
}

void Workplace::ask_for_mask() {
    const auto edit = image_edit(*document.snapshot());
    if (!edit) return;
    choose_edit(*edit);
    ask(FileQuestion::Parameter, "mask");
}

void Workplace::open(const std::filesystem::path& path) {
    const std::filesystem::path bundled = bundled_cases_folder();
    std::error_code error;
    const bool own = !bundled.empty() && std::filesystem::equivalent(
                                             path.has_filename() ? path.parent_path()
                                                                 : path.parent_path().parent_path(),
                                             bundled, error);
    document.open({.path = path, .beside_input = !own});
}

void Workplace::open_bundled(const std::filesystem::path& path) {
    document.open({.path = path, .beside_input = false});
}

void Workplace::open_phantom(const std::string& name) {
    document.open({.phantom = name});
}

void Workplace::end_spots() {
    const std::string lost = gallery_.spots.close();
    if (!lost.empty())
        document.tell(
            make_message(MessageKind::Error, "the last change of the spots is lost: " + lost));
}

void Workplace::end_measures() {
    const std::string lost = measures.close();
    if (!lost.empty())
        document.tell(make_message(MessageKind::Error,
                                   "the last change of the measurements is lost: " + lost));
}

void Workplace::close() {
    leave_form();
    stop_comparing();
    view = {};
    picture_file_.clear();
    gallery_.show(GalleryMode::Off);
    document.close();
    end_spots();
    end_measures();
    slices_.clear();
    settings.refresh();
    renew_lists();
}

// --- the operation panel

void Workplace::choose_step(Step step) {
    leave_form();
    step_ = step;
}

void Workplace::choose(const std::string& operation, std::optional<Step> step) {
    const Operation& chosen = find_operation(operation);
    drop_form();
    const bool fits = step && std::ranges::count(chosen.allowed, *step) > 0;
    step_ = fits ? *step : chosen.usual_step;
    document.stand_before(EditSite{.edit = {}, .step = step_});
    form_.emplace(chosen, suggested_arguments(chosen));
    show_form();
    if (is_brush(form_->operation())) {
        if (tip_.radius > 0.0) vesselbench::set_tip(*form_, tip_);
        return;
    }
    arm_required();
}

/// A region of the image is seen in its slices.
void Workplace::show_form() {
    ++form_number_;
    if (has_field(*form_, Meaning::Box)) slices_.lend_row(true);
}

/// What the form of a new edit starts with.
Arguments Workplace::suggested_arguments(const Operation& operation) const {
    const Scene* scene = document.current();
    if (operation.suggested == nullptr || scene == nullptr) return {};
    return operation.suggested(*scene, document.variant());
}

/// What has to be picked is picked at once.
void Workplace::arm_required() {
    for (const FormField& field : form_->fields())
        if (field.parameter->required && pick_target(*field.parameter))
            return arm(field.parameter->name);
}

void Workplace::look_at(const Vec3& place, const Vec3& outward) {
    slices_.set_cross(place);
    looked_at_ = place;
    looked_from_ = outward;
    ++looks_;
}

std::string Workplace::why_no_worst() const {
    if (view.colouring == ColouringKind::Patches)
        return "Choose colours first: their worst places are shown in turn";
    if (live_.shown() && !has_live_colours(view.colouring))
        return "These colours do not follow the model while it is smoothed live";
    return "The colours are not known yet";
}

void Workplace::look_at_worst(int steps) {
    const ColouringInfo& info = colouring_info(view.colouring);
    const auto found = worst_.go({document, view_data_, live_.shown(), view.colouring}, steps);
    if (!found) return document.tell(make_message(MessageKind::Remark, why_no_worst()));
    look_at(found->place, found->outward);
    std::string words = std::string(info.label) + " " + formatted(found->value);
    if (std::string(info.unit) != "-") words += std::string(" ") + info.unit;
    if (found->sharpness) words += ", change of orientation " + formatted(*found->sharpness);
    document.tell(make_message(MessageKind::Remark, words + ": worst place " + worst_.position()));
}

void Workplace::choose_edit(EditId edit) {
    drop_form();
    const LogEntry* entry = find_entry(*document.snapshot(), edit);
    const Operation* operation =
        entry == nullptr ? nullptr : known_operation(entry->edit.operation);
    if (operation == nullptr) return document.stand_before({});
    form_.emplace(*operation, entry->edit);
    show_form();
    step_ = entry->edit.place.step;
    document.stand_before(EditSite{.edit = edit, .step = step_});
}

void Workplace::set_field(const std::string& parameter, const std::string& text) {
    const int before = form_->changes();
    form_->set(parameter, text);
    if (form_->changes() == before) return;
    if (is_brush(form_->operation())) tip_ = tip();
    document.forget_failure();
    document.drop_preview();
}

void Workplace::reset_form() {
    disarm();
    form_->reset();
    document.forget_failure();
    document.drop_preview();
}

void Workplace::leave_form() {
    drop_form();
    document.stand_before({});
}

void Workplace::drop_form() {
    looked_at_.reset();
    live_.follow(false);
    extraction_.follow(false);
    slices_.lend_row(false);
    applied_live_.reset();
    applied_to_.reset();
    document.drop_preview();
    if (form_) document.forget_failure();
    form_.reset();
    wanted_field_.clear();
    disarm();
    end_drag();
    forget_role_question();
    previewed_changes_ = -1;
}

bool Workplace::can_change() const {
    return document.can(RequestKind::Edit);
}

bool Workplace::can_apply() const {
    return form_ && form_->valid() && openings_.can_apply() && can_change();
}

bool Workplace::preview_is_current() const {
    return document.previewed() && form_ && previewed_changes_ == form_->changes();
}

void Workplace::preview() {
    if (!form_ || !form_->valid() || !openings_.can_apply() || !document.can(RequestKind::Preview))
        return;
    end_models_gallery();
    previewed_changes_ = form_->changes();
    if (form_->edit())
        document.preview_change(*form_->edit(), form_->arguments());
    else
        document.preview(form_->operation().name, form_->arguments(), step_);
}

void Workplace::apply() {
    if (!can_apply()) return;
    applied_form_ = form_number_;
    applied_live_ = live_.shown();
    applied_to_ = applied_live_ ? document.current()->surface->positions : nullptr;
    if (preview_is_current()) return document.commit_preview();
    if (form_->edit())
        document.change(*form_->edit(), form_->arguments());
    else
        document.apply(form_->operation().name, form_->arguments(), step_);
}

// --- the brush

bool Workplace::can_paint() const {
    return form_ && armed_.empty() && !form_->edit() && is_brush(form_->operation()) &&
           form_->valid() && view.tool == MeasureTool::None && document.can_paint();
}

bool Workplace::is_painting() const {
    return form_ && is_brush(form_->operation()) && document.is_painting();
}

BrushTip Workplace::tip() const {
    return form_ ? tip_of(*form_, tip_) : tip_;
}

void Workplace::set_tip(const BrushTip& tip) {
    tip_ = tip;
    if (form_) vesselbench::set_tip(*form_, tip);
}

void Workplace::begin_stroke(StrokeKeys keys) {
    if (can_paint()) document.begin_stroke(stroke_of(*form_, tip(), keys), step_);
}

std::string Workplace::command() const {
    const std::filesystem::path& project = document.project();
    return form_ ? form_->as_command(project.string(), document.variant(), step_) : "";
}

// --- picking in the view

void Workplace::arm(const std::string& parameter) {
    if (armed_ == parameter) return disarm();
    armed_ = parameter;
    end_models_gallery();
    const std::optional<PickTarget> target = armed_target();
    if (target && is_in_slices(*target)) slices_.show_row(true);
    document.drop_preview();
}

std::optional<PickTarget> Workplace::armed_target() const {
    if (!form_ || armed_.empty()) return std::nullopt;
    const FormField& field = form_->field(armed_);
    return field.active ? pick_target(*field.parameter) : std::nullopt;
}

void Workplace::pick(const Vec3& point) {
    const std::optional<PickTarget> target = armed_target();
    if (!target || target == PickTarget::Labels || document.is_reading()) return;
    set_field(armed_, picked_text(*target, form_->field(armed_).text, point));
    if (is_complete(*target, form_->field(armed_).text)) disarm();
}

void Workplace::pick_label(int label) {
    if (armed_target() == PickTarget::Labels)
        set_field(armed_, picked_labels(form_->field(armed_).text, label));
}

// --- measuring

MeasuredModel Workplace::measured_model(MeasuredOn on) const {
    const bool preview = document.previewed() || live_.shown();
    return {.on = preview && on == MeasuredOn::Surface ? MeasuredOn::Preview : on,
            .state = document.is_open() ? document.snapshot()->history->current() : 0,
            .variant = document.variant()};
}

// --- comparing

void Workplace::compare(StateId reference) {
    const bool again = comparison_ && comparison_->reference() == reference;
    stop_comparing();
    gallery_.show(GalleryMode::Off);
    if (!again && document.is_open()) comparison_.emplace(reference, compare_mode_, wake_);
}

void Workplace::stop_comparing() {
    if (comparison_) compare_mode_ = comparison_->mode();
    comparison_.reset();
}

// --- handles in the view

void Workplace::begin_drag() {
    before_drag_ = form_;
    driving_ = sliding_ = false;
}

void Workplace::drag(const std::vector<FieldText>& texts) {
    if (before_drag_) fill_form(texts);
}

void Workplace::cancel_drag() {
    const std::optional<OperationForm> before = std::exchange(before_drag_, std::nullopt);
    if (form_ && before) bring_back(*before);
}

void Workplace::end_drag() {
    dragged_ = std::exchange(before_drag_, std::nullopt);
    if (!form_) dragged_.reset();
    dragged_changes_ = form_ ? form_->changes() : -1;
}

bool Workplace::take_back_drag() {
    const std::optional<OperationForm> before = std::exchange(dragged_, std::nullopt);
    if (!before || !form_ || form_->changes() != dragged_changes_ ||
        before->changes() == dragged_changes_)
        return false;
    bring_back(*before);
    return true;
}

void Workplace::bring_back(const OperationForm& before) {
    for (const FormField& field : before.fields()) set_field(field.parameter->name, field.text);
    if (std::exchange(driving_, false)) live_.cancel_drag();
    if (std::exchange(sliding_, false)) extraction_.cancel_drag();
}

// --- smoothing by the mouse

bool Workplace::can_drive() const {
    return form_ && form_->valid() && armed_.empty() && live_.can_follow() &&
           document.can(RequestKind::Preview) && view.tool == MeasureTool::None && !comparison_;
}

void Workplace::begin_driving() {
    if (!can_drive()) return;
    end_models_gallery();
    begin_drag();
    driving_ = true;
    document.drop_preview();
    live_.begin_drive();
}

void Workplace::begin_setting() {
    if (live_.has_form()) return begin_driving();
    if (!quality_.can_analyse()) return;
    begin_drag();
    driving_ = true;
}

void Workplace::drive(const DriveReach& reach) {
    if (is_driving() && live_.can_follow()) drag(live_.drive(*before_drag_, reach));
}

// --- the gallery of suggestions

void Workplace::show_gallery(GalleryMode mode) {
    gallery_.toggle(mode);
    if (gallery_.mode() == GalleryMode::Off) return;
    stop_comparing();
    view.flies = false;
    if (mode != GalleryMode::Models) return;
    disarm();
    view.tool = MeasureTool::None;
    document.drop_preview();
}

/// Whole models leave no room for what the view is asked to show.
void Workplace::end_models_gallery() {
    if (gallery_.mode() == GalleryMode::Models) gallery_.show(GalleryMode::Off);
}

void Workplace::take_suggestion(std::size_t i) {
    const auto suggestion = gallery_.suggestion(i);
    if (!form_ || !suggestion) return;
    for (const FieldText& field : SuggestionGallery::texts(*form_, *suggestion))
        set_field(field.parameter, field.text);
    gallery_.took(*form_);
    gallery_.show(GalleryMode::Off);
    live_.follow(true);
}

// --- sliding the iso-value

void Workplace::follow_extraction(bool on) {
    extraction_.follow(on);
    if (extraction_.follows()) slices_.lend_row(true);
}

void Workplace::begin_sliding() {
    if (!form_ || !extraction_.can_follow() || !document.can(RequestKind::Preview)) return;
    begin_drag();
    sliding_ = true;
    document.drop_preview();
    extraction_.begin_drag();
    slices_.lend_row(true);
}

void Workplace::slide(double iso) {
    if (is_sliding()) drag(extraction_.iso_texts(*before_drag_, iso));
}

// --- openings

void Workplace::fill_form(const std::vector<FieldText>& texts) {
    if (!form_) return;
    for (const FieldText& field : texts) set_field(field.parameter, field.text);
}

void Workplace::click_opening(const PatchMeasures& opening) {
    forget_role_question();
    if (!openings_.rows().empty()) return openings_.select_near(opening.centroid);
    const bool free = !form_ || (has_field(*form_, Meaning::Inlet) && !form_->edit());
    if (form_ && has_field(*form_, Meaning::Openings)) {
        const std::string& names = name_of(*form_, Meaning::Openings);
        set_field(names, with_name_switched(form_->field(names).text, opening.name));
    } else if (free && can_change()) {
        opening_ = opening;
    }
}

void Workplace::give_role(PatchKind role) {
    const std::optional<PatchMeasures> opening = std::exchange(opening_, std::nullopt);
    const Scene* scene = document.shown();
    if (!opening || scene == nullptr || !scene->surface) return;
    const auto texts = role_texts(*opening, role, scene->surface->patches);
    if (!form_ || !has_field(*form_, Meaning::Inlet)) choose("clip-opening");
    fill_form(texts);
}

// --- questions for a file

void Workplace::save_recipe(const std::filesystem::path& file) {
    try {
        write_recipe(file, recipe.recipe());
        document.tell(make_message(MessageKind::Remark, "The recipe was saved: " + file.string()));
    } catch (const IoError& error) {
        document.tell(make_message(MessageKind::Error, error.what()));
    }
}

void Workplace::ask(FileQuestion question, const std::string& parameter) {
    question_ = question;
    asked_parameter_ = parameter;
}

void Workplace::answer(const std::filesystem::path& file) {
    switch (std::exchange(question_, FileQuestion::None)) {
        case FileQuestion::Open:
            return open(file);
        case FileQuestion::SaveCopy:
            return document.save_copy(file);
        case FileQuestion::Export:
            return document.export_to(file);
        case FileQuestion::Parameter:
            return form_ ? set_field(asked_parameter_, file.string()) : void();
        case FileQuestion::Picture:
            picture_file_ = file;
            return;
        case FileQuestion::Measures:
            return document.write_table(file, measures_csv(measures.all()));
        case FileQuestion::SaveRecipe:
            return save_recipe(file);
        case FileQuestion::None:
            return;
    }
}

}  // namespace vesselbench
