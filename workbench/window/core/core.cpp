#include "workbench/window/core/core.h"

#include <algorithm>
#include <utility>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/whole_file.h"
#include "workbench/operations/table.h"
#include "workbench/prepare/bundled_cases.h"
#include "workbench/prepare/edits_recipe.h"
#include "workbench/window/case/user_folders.h"
#include "workbench/window/form/picked_text.h"

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

Core::Core(const DocumentOptions& options, Settings remembered)
    : FormDesk(options),
      settings(std::move(remembered)),
      wake_(options.wake),
      search_(options.wake) {}

bool Core::update() {
    bool changed = document.poll();
    pointed_ = std::exchange(next_pointed_, std::nullopt);
    take_case();
    if (seen_snapshots_ != document.snapshot_changes()) renew_lists();
    take_entered();
    changed = update_places() || changed;
    for (const auto& feature : features.all()) changed = feature->update() || changed;
    return update_field_values() || changed;
}

bool Core::pending() const {
    return document.busy() || search_.pending() || finds_field_values() ||
           std::ranges::any_of(features.all(),
                               [](const auto& feature) { return feature->pending(); });
}

void Core::for_listeners(const Listen& call) {
    call(*this);
    for (const auto& feature : features.all()) call(*feature);
}

bool Core::listeners_allow_apply() const {
    return std::ranges::all_of(features.all(),
                               [](const auto& feature) { return feature->allows_apply(); });
}

void Core::take_case() {
    if (std::exchange(seen_opened_, document.opened()) == document.opened()) return;
    settings.remember(document.project());
    settings.save_soon();
    choose_step(Step::Source);
    view = {};
    for (const auto& feature : features.all()) feature->case_opened();
}

bool Core::update_places() {
    const bool tips = form() && wants_tips(*form()) && !document.previewed();
    const bool same_scene = searched_scenes_ == document.scene_changes();
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
void Core::search_places(const Scene* scene, bool tips) {
    search_.forget();
    places_ = {};
    if (scene == nullptr || !scene->surface || scene->surface->empty()) return;
    search_.start([surface = *scene->surface, tips](const Progress& progress) {
        return places_of(surface, tips, progress);
    });
}

void Core::renew_lists() {
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

void Core::answer_unit(const std::string& unit) {
    const LogEntry* entry =
        unit_question_ ? find_entry(*document.snapshot(), unit_question_->edit) : nullptr;
    if (entry == nullptr || !can_change()) return;
    Arguments given = entry->edit.given;
    given.set("units", unit);
    leave_form();
    document.change(entry->edit.edit.id, std::move(given));
}

bool Core::can_add_mask() const {
    return can_change() && image_edit(*document.snapshot()).has_value();
}

void Core::ask_for_mask() {
    const auto edit = image_edit(*document.snapshot());
    if (!edit) return;
    choose_edit(*edit);
    ask(FileQuestion::Parameter, "mask");
}

void Core::open(const std::filesystem::path& path) {
    const std::filesystem::path bundled = bundled_cases_folder();
    std::error_code error;
    const bool own = !bundled.empty() && std::filesystem::equivalent(
                                             path.has_filename() ? path.parent_path()
                                                                 : path.parent_path().parent_path(),
                                             bundled, error);
    document.open({.path = path, .beside_input = !own});
}

void Core::open_bundled(const std::filesystem::path& path) {
    document.open({.path = path, .beside_input = false});
}

void Core::open_phantom(const std::string& name) {
    document.open({.phantom = name});
}

void Core::close() {
    leave_form();
    view = {};
    document.close();
    for (const auto& feature : features.all()) feature->case_closed();
    settings.refresh();
    renew_lists();
}

void Core::look_at(const Vec3& place, const Vec3& outward) {
    looked_at_ = place;
    looked_from_ = outward;
    ++looks_;
    for (const auto& feature : features.all()) feature->looked_at(place);
}

void Core::claim_view(const Feature& by) {
    for (const auto& feature : features.all())
        if (feature.get() != &by) feature->give_way();
}

// --- questions for a file

void Core::save_recipe(const std::filesystem::path& file, const std::string& text) {
    try {
        write_file(file, text);
        document.tell(make_message(MessageKind::Remark, "The recipe was saved: " + file.string()));
    } catch (const IoError& error) {
        document.tell(make_message(MessageKind::Error, error.what()));
    }
}

void Core::ask(FileQuestion question, const std::string& parameter) {
    question_ = question;
    asked_parameter_ = parameter;
}

void Core::answer(const std::vector<std::filesystem::path>& files) {
    const FileQuestion question = std::exchange(question_, FileQuestion::None);
    for (const std::filesystem::path& file : files) answer(question, file);
}

void Core::answer(FileQuestion question, const std::filesystem::path& file) {
    switch (question) {
        case FileQuestion::Open:
            return open(file);
        case FileQuestion::SaveCopy:
            return document.save_copy(file);
        case FileQuestion::Parameter:
            return form() ? set_field(asked_parameter_, file.string()) : void();
        case FileQuestion::Picture:
        case FileQuestion::Measures:
        case FileQuestion::ReviewPage:
        case FileQuestion::Verdicts:
            for (const auto& feature : features.all()) feature->file_chosen(question, file);
            return;
        case FileQuestion::SaveRecipe:
            return save_recipe(file, text_of_recipe(recipe.recipe()));
        case FileQuestion::SaveEdits:
            return save_recipe(file,
                               recipe_of_edits(*document.snapshot(), document.variant(), false));
        case FileQuestion::Export:  // the dialog exports: it knows the flow
        case FileQuestion::None:
            return;
    }
}

}  // namespace vesselbench
