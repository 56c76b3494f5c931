#include "workbench/window/style/fonts.h"

#include <array>
#include <cmath>

#include <imgui.h>

#include "workbench/window/style/embedded_fonts.h"
#include "workbench/window/style/icons.h"

namespace vesselbench {

namespace {

// Latin with its extension, Greek, punctuation, superscripts, arrows, minus and relations.
constexpr std::array<ImWchar, 15> kLetters = {0x20,   0x17F,  0x370,  0x3FF,  0x2010,
                                              0x2027, 0x2030, 0x203A, 0x2070, 0x2094,
                                              0x2190, 0x2193, 0x2212, 0x2265, 0};

/// ImGui's ranges: pairs of first and last, ended by 0. The font's texture refers to them later.
const ImWchar* icon_ranges() {
    static const auto ranges = [] {
        std::array<ImWchar, 2 * icons::kCodes.size() + 1> pairs{};
        for (std::size_t i = 0; i < icons::kCodes.size(); ++i)
            pairs[2 * i] = pairs[2 * i + 1] = icons::kCodes[i];
        return pairs;
    }();
    return ranges.data();
}

ImFont* add(std::span<const unsigned char> bytes, float size, const ImWchar* ranges, bool merged) {
    ImFontConfig config;
    config.FontDataOwnedByAtlas = false;
    config.MergeMode = merged;
    config.OversampleH = merged ? 1 : 2;
    config.PixelSnapH = merged;
    if (merged) config.GlyphOffset.y = std::round(size * 0.12F);
    // ImGui's parameter is not const, but these bytes are only read.
    return ImGui::GetIO().Fonts->AddFontFromMemoryTTF(const_cast<unsigned char*>(bytes.data()),
                                                      static_cast<int>(bytes.size()), size, &config,
                                                      ranges);
}

ImFont* add_with_icons(std::span<const unsigned char> bytes, float size) {
    const float pixels = std::round(size);
    ImFont* font = add(bytes, pixels, kLetters.data(), false);
    add(window_icon_font(), std::round(size * 1.2F), icon_ranges(), true);
    return font;
}

}  // namespace

Fonts make_fonts(float em) {
    ImGui::GetIO().Fonts->Clear();
    Fonts fonts;
    fonts.regular = add_with_icons(window_font(), em);
    fonts.medium = add_with_icons(window_medium_font(), em);
    fonts.small = add_with_icons(window_font(), em * 0.87F);
    fonts.heading = add_with_icons(window_medium_font(), em * 1.2F);
    fonts.title = add_with_icons(window_medium_font(), em * 1.9F);
    return fonts;
}

}  // namespace vesselbench
