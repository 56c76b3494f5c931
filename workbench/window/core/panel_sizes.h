#pragma once

#include <array>
#include <optional>
#include <utility>

namespace vesselbench {

/// Parts of the window whose size the user chooses. Slices: of the view below the model.
enum class Panel { Rail, Operation, Bottom, Slices };

inline constexpr std::array<std::pair<const char*, Panel>, 4> kPanels = {
    {{"rail", Panel::Rail},
     {"operation", Panel::Operation},
     {"bottom", Panel::Bottom},
     {"slices", Panel::Slices}}};

struct PanelSize {
    /// Of the window's width (Rail, Operation), its height (Bottom), or the view's height (Slices),
    /// 0 to 1; none: chosen automatically.
    std::optional<double> share = std::nullopt;
    bool folded = false;

    bool operator==(const PanelSize&) const = default;
};

/// What the user made of the window's parts, remembered between two starts.
class PanelSizes {
public:
    [[nodiscard]] PanelSize& operator[](Panel panel) {
        return sizes_[static_cast<std::size_t>(panel)];
    }

    [[nodiscard]] const PanelSize& operator[](Panel panel) const {
        return sizes_[static_cast<std::size_t>(panel)];
    }

    /// The model and the three slices in two rows of two, rather than the slices in one row.
    bool quarters = false;

    bool operator==(const PanelSizes&) const = default;

private:
    std::array<PanelSize, kPanels.size()> sizes_;
};

/// What takes the room of the panels around it.
enum class Enlarged { None, Model, Axial, Coronal, Sagittal };

}  // namespace vesselbench
