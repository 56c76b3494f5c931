#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geometry/image/segment.h"
#include "workbench/session/task.h"
#include "workbench/window/case/document.h"
#include "workbench/window/form/operation_form.h"

namespace vesselbench {

/// A label that a form may take.
struct LabelRow {
    int label = 0;
    double volume = 0.0;    ///< [mm^3]
    bool taken = false;     ///< as given, else as the operation decides
    std::string name = {};  ///< of the segment; empty: it has none
    /// Red, green, blue; none: that of the category.
    std::optional<std::array<std::uint8_t, 3>> colour = std::nullopt;
};

/// The labels of the document's mask, else of its image, for a form that takes labels. They are
/// found in the background. Used by the frame's thread.
class LabelList {
public:
    /// \param wake called by the other thread when update() has something to do
    explicit LabelList(std::function<void()> wake) : task_(std::move(wake)) {}

    /// Once a frame. \param form null: none \return true if the labels have changed
    bool update(const Document& document, const OperationForm* form);

    /// Ascending; empty while they are not known, and of an image without labels.
    [[nodiscard]] std::vector<LabelRow> rows(const FormField& field) const;

    [[nodiscard]] bool pending() const { return task_.pending(); }

private:
    using Volumes = std::map<int, double>;  ///< [mm^3]

    Task<Volumes> task_;
    Volumes volumes_;
    std::vector<Segment> segments_;
    std::shared_ptr<const std::vector<float>> voxels_;  ///< whose labels these are
};

/// "artery", else "Label 5"
[[nodiscard]] std::string name_of(const LabelRow& row);

/// The field's text with a label more, or without it if it is taken; the last one stays.
[[nodiscard]] std::string switched_label(std::vector<LabelRow> rows, int label);

}  // namespace vesselbench
