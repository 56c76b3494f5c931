#pragma once

#include <cstddef>

#include "workbench/window/core/core.h"
#include "workbench/window/features/gallery/suggestion_gallery.h"

namespace vesselbench {

/// The gallery of suggestions for a smoothing form, and its spots.
class GalleryFeature : public Feature {
public:
    explicit GalleryFeature(Core& core) : core_(core), gallery_(core.wake()) {}

    [[nodiscard]] SuggestionGallery& gallery() { return gallery_; }

    /// Shows it, or ends it if it is shown in this mode; ends what else the view may show instead.
    void show(GalleryMode mode);

    /// Fills in the values of a suggestion, ends the gallery, and the model follows. Ignored while
    /// it is not known.
    void take(std::size_t suggestion);

    /// Ends picking, or else the gallery. \return false if it was not shown
    bool leave();

    [[nodiscard]] bool update() override;

    [[nodiscard]] bool pending() const override { return gallery_.pending(); }

    void keys(PanelContext& context) override;
    void case_opened() override;
    void case_closed() override;

    /// Whole models leave no room for what the view is asked to show.
    void model_wanted() override;

    void give_way() override { gallery_.show(GalleryMode::Off); }

private:
    void end_spots();

    Core& core_;
    SuggestionGallery gallery_;
};

}  // namespace vesselbench
