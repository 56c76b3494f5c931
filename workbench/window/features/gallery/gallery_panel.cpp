#include "workbench/window/features/gallery/gallery_panel.h"

#include <imgui.h>

#include "workbench/window/case/readable.h"
#include "workbench/window/core/core.h"
#include "workbench/window/features/gallery/gallery_feature.h"
#include "workbench/window/keys/key_table.h"
#include "workbench/window/style/icons.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

namespace {

void draw_mode(PanelContext& c, const std::string& name, const std::string& label, GalleryMode mode,
               const ButtonLook& look) {
    ButtonLook own = look;
    own.primary = c.core.get<GalleryFeature>().gallery().mode() == mode;
    if (button(c.ui, name, label, own)) c.core.get<GalleryFeature>().show(mode);
}

void draw_modes(PanelContext& c) {
    const float wide = (ImGui::GetContentRegionAvail().x - c.ui.grid(1)) / 2;
    draw_mode(c, "live.gallery", "Gallery", GalleryMode::Models,
              {.icon = icons::kColumns,
               .width = wide,
               .help = "Little, medium and strong smoothing side by side  " +
                       keys_of(KeyCommand::Gallery)});
    ImGui::SameLine(0, c.ui.grid(1));
    draw_mode(c, "live.spots", "Spots", GalleryMode::Spots,
              {.icon = icons::kTarget,
               .width = wide,
               .help = "Places of the model, magnified under the three suggestions  " +
                       keys_of(KeyCommand::Spots)});
}

void draw_spot(PanelContext& c, std::size_t i) {
    SpotList& spots = c.core.get<GalleryFeature>().gallery().spots;
    const std::string number = std::to_string(i);
    const bool chosen = &spots.all()[i] == spots.chosen();
    if (icon_button(c.ui, "spot.choose." + number, icons::kTarget, "Magnify this spot", true,
                    chosen))
        spots.choose(i);
    const float gap = c.ui.grid(0.5F), side = ImGui::GetFrameHeight();
    ImGui::SameLine(0, gap);
    std::string name = spots.all()[i].name;
    const float wide = ImGui::GetContentRegionAvail().x - side - gap;
    if (text_field(c.ui, "spot.name." + number, name, {.hint = "name", .width = wide}))
        spots.rename(i, name);
    ImGui::SameLine(0, gap);
    if (icon_button(c.ui, "spot.remove." + number, icons::kDelete, "Remove this spot"))
        spots.remove(i);
}

void draw_spots(PanelContext& c) {
    SuggestionGallery& gallery = c.core.get<GalleryFeature>().gallery();
    for (std::size_t i = 0; i < gallery.spots.all().size(); ++i) draw_spot(c, i);
    const bool first = gallery.spots.all().empty();
    const bool picks = gallery.picks();
    if (button(c.ui, "spot.pick", picks ? "Click on the model" : "Add a spot",
               {.icon = icons::kPlus,
                .primary = picks && !first,
                .enabled = !first,
                .width = -1,
                .help = "A click on the model makes a spot"}))
        gallery.pick(!picks);
    if (!gallery.spots.not_stored().empty())
        wrapped(c.ui,
                "The spots are lost when the project is closed: " + gallery.spots.not_stored(),
                c.ui.theme.warning);
}

}  // namespace

void draw_gallery_panel(PanelContext& c) {
    draw_modes(c);
    const SuggestionGallery& gallery = c.core.get<GalleryFeature>().gallery();
    if (gallery.mode() == GalleryMode::Off) return;
    space(c.ui, 0.5F);
    if (gallery.mode() == GalleryMode::Spots) draw_spots(c);
    if (!gallery.problem().empty())
        wrapped(c.ui, readable_sentence(gallery.problem()), c.ui.theme.warning);
    else
        wrapped(c.ui, "A double click on a suggestion fills in its values.", c.ui.theme.muted);
}

}  // namespace vesselbench
