#pragma once

namespace vesselbench {

enum class PictureBackground { Theme, White, Transparent };

/// How a picture of the view is saved.
struct PictureLook {
    int factor = 1;  ///< width and height, times those of the view: 1, 2 or 4
    PictureBackground background = PictureBackground::Theme;

    /// The view's pixels, with legend and marks; else the model is drawn again, alone.
    [[nodiscard]] bool is_as_seen() const {
        return factor == 1 && background == PictureBackground::Theme;
    }
};

}  // namespace vesselbench
