#include "workbench/window/features/openings/openings_feature.h"

#include <utility>

#include "workbench/window/features/openings/opening_roles.h"

namespace vesselbench {

/// Texts that fix a plan follow it, but not what is being dragged.
bool OpeningsFeature::update() {
    const int scenes = core_.document.scene_changes();
    if (std::exchange(seen_scenes_, scenes) != scenes) forget_role_question();
    const bool changed = openings_.update(core_.document, core_.open_form());
    if (changed && core_.form() && !core_.before_drag())
        core_.fill_form(openings_.due_texts(*core_.form()));
    const bool known = !openings_.rows().empty() || !openings_.problem().empty();
    if (keeps_ends_ && known && !openings_.pending()) keep_ends();
    return changed;
}

void OpeningsFeature::form_shown() {
    keeps_ends_ = core_.form() && core_.form()->edit();
    if (keeps_ends_)
        core_.fill_form(found_texts(*core_.document.snapshot(), *core_.form()->edit()));
}

void OpeningsFeature::keep_ends() {
    keeps_ends_ = false;
    const std::optional<Vec3> inlet = std::exchange(wanted_inlet_, std::nullopt);
    if (!core_.form() || !core_.form()->edit()) return;
    if (inlet) openings_.select_near(*inlet);
    const std::optional<int> number = inlet ? openings_.selected() : std::nullopt;
    const auto wishes =
        former_wishes(openings_.rows(), *core_.document.snapshot(), *core_.form()->edit());
    if (number) core_.fill_form(openings_.wish_texts(*core_.form(), *number, EndWish::Inlet));
    for (const auto& [end, wish] : wishes)
        if (end != number) core_.fill_form(openings_.wish_texts(*core_.form(), end, wish));
}

void OpeningsFeature::click(const PatchMeasures& opening) {
    forget_role_question();
    if (!openings_.rows().empty()) return openings_.select_near(opening.centroid);
    const auto& form = core_.form();
    const bool free = !form || (has_field(*form, Meaning::Inlet) && !form->edit());
    if (form && has_field(*form, Meaning::Openings)) {
        const std::string& names = name_of(*form, Meaning::Openings);
        core_.set_field(names, with_name_switched(form->field(names).text, opening.name));
    } else if (free && core_.can_change()) {
        asked_ = opening;
    }
}

void OpeningsFeature::give_role(PatchKind role) {
    const std::optional<PatchMeasures> opening = std::exchange(asked_, std::nullopt);
    const Scene* scene = core_.document.shown();
    if (!opening || scene == nullptr || !scene->surface) return;
    const auto made = made_opening(*core_.document.snapshot(), core_.document.variant(), *opening);
    if (role == PatchKind::Inlet && made && !core_.form()) {
        core_.choose_edit(made->edit);
        wanted_inlet_ = made->tip;
        return;
    }
    const auto texts = role_texts(*opening, role, scene->surface->patches);
    if (!core_.form() || !has_field(*core_.form(), Meaning::Inlet)) core_.choose("clip-opening");
    core_.fill_form(texts);
}

}  // namespace vesselbench
