#include "workbench/window/features/picture/view_picture.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <epoxy/gl.h>
#include <imgui.h>

#include "geometry/kernel/whole_file.h"
#include "gpu/png.h"
#include "gpu/transparency.h"
#include "workbench/session/task.h"
#include "workbench/window/core/core.h"
#include "workbench/window/core/shown.h"
#include "workbench/window/features/picture/picture_feature.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;

/// Pixels of the bound framebuffer. \param rect from the upper left corner
Picture read_pixels(const ScreenRect& rect, float window_height) {
    Picture picture{.width = static_cast<int>(rect.width), .height = static_cast<int>(rect.height)};
    const auto row = static_cast<std::size_t>(picture.width) * 3;
    const auto rows = static_cast<std::size_t>(picture.height);
    picture.rgb.resize(row * rows);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(static_cast<int>(rect.x), static_cast<int>(window_height - rect.y - rect.height),
                 picture.width, picture.height, GL_RGB, GL_UNSIGNED_BYTE, picture.rgb.data());
    for (std::size_t i = 0; i < rows / 2; ++i)
        std::swap_ranges(picture.rgb.begin() + static_cast<std::ptrdiff_t>(i * row),
                         picture.rgb.begin() + static_cast<std::ptrdiff_t>((i + 1) * row),
                         picture.rgb.begin() + static_cast<std::ptrdiff_t>((rows - 1 - i) * row));
    return picture;
}

}  // namespace

struct ViewPicture::Impl {
    explicit Impl(std::function<void()> wake) : saving(std::move(wake)) {}

    /// Called while the frame is drawn, after everything of the view.
    static void read(const ImDrawList*, const ImDrawCmd* command) {
        auto& own = *static_cast<Impl*>(command->UserCallbackData);
        const Picture picture = read_pixels(own.rect, own.window_height);
        own.saving.start_after([picture, file = own.file](const Progress&) {
            write_file(file, png(picture));
            return file;
        });
    }

    Task<fs::path> saving;
    fs::path file;
    ScreenRect rect;
    float window_height = 0;
};

ViewPicture::ViewPicture(std::function<void()> wake)
    : impl_(std::make_unique<Impl>(std::move(wake))) {}

/// A picture that was taken is written.
ViewPicture::~ViewPicture() {
    impl_->saving.wait();
}

bool ViewPicture::pending() const {
    return impl_->saving.pending();
}

void ViewPicture::collect(Document& document) {
    auto& saving = impl_->saving;
    if (!saving.poll()) return;
    if (const auto file = saving.take())
        document.tell(make_message(MessageKind::Success, "Saved picture " + file->string()));
    else
        document.tell(make_message(MessageKind::Error, saving.problem()));
}

void ViewPicture::save(const fs::path& file, const PictureLook& look, const Draw& draw) {
    const bool clear = look.background == PictureBackground::Transparent;
    const auto first = look.background == PictureBackground::Theme
                           ? draw(look.factor, std::nullopt)
                           : draw(look.factor, Colour(Colour::Ones()));
    const Picture on_black = clear ? draw(look.factor, Colour(Colour::Zero())) : Picture{};
    impl_->saving.start_after([first, on_black, clear, file](const Progress&) {
        write_file(file, clear ? png(without_background(on_black, first)) : png(first));
        return file;
    });
}

bool ViewPicture::update(PanelContext& c, const ScreenRect& view, const Draw& draw) {
    Impl& own = *impl_;
    collect(c.core.document);
    if (own.saving.pending()) return false;
    const fs::path file = c.core.get<PictureFeature>().take_file();
    if (file.empty()) return false;
    if (draw && !c.shown.picture.is_as_seen()) {
        save(file, c.shown.picture, draw);
        return false;
    }
    own.file = file;
    own.rect = view;
    own.window_height = ImGui::GetIO().DisplaySize.y;
    c.shown.view = false;
    ImGui::GetForegroundDrawList()->AddCallback(Impl::read, &own);
    return true;
}

}  // namespace vesselbench
