#include "workbench/window/form/label_list.h"

#include <algorithm>

#include "geometry/image/threshold.h"
#include "workbench/case/checked_value.h"
#include "workbench/window/form/field_text.h"

namespace vesselbench {

namespace {

/// Null: there is none, or the form takes no labels.
const Image* labelled(const Scene* scene, const OperationForm* form) {
    if (scene == nullptr || form == nullptr || !has_field(*form, Meaning::Labels)) return nullptr;
    const auto& image = scene->mask ? scene->mask : scene->image;
    return image && !image->empty() ? &*image : nullptr;
}

}  // namespace

bool LabelList::update(const Document& document, const OperationForm* form) {
    const Image* image = labelled(document.current(), form);
    const auto voxels = image == nullptr ? nullptr : image->voxels;
    if (voxels != voxels_) {
        voxels_ = voxels;
        volumes_.clear();
        segments_.clear();
        if (image != nullptr) segments_ = document.current()->segmentation.segments;
        task_.forget();
        if (image != nullptr)
            task_.start([image = *image](const Progress&) {
                return judge(image).kind == ImageKind::Labels ? label_volumes(image) : Volumes();
            });
    }
    if (!task_.poll()) return false;
    volumes_ = task_.take().value_or(Volumes());
    return true;
}

std::vector<LabelRow> LabelList::rows(const FormField& field) const {
    std::vector<double> taken;
    if (field.text.empty()) {
        if (const auto* decided =
                field.automatic ? std::get_if<std::vector<double>>(&*field.automatic) : nullptr)
            taken = *decided;
    } else if (field.error.empty()) {
        taken = std::get<std::vector<double>>(checked_value(*field.parameter, Value(field.text)));
    }
    std::vector<LabelRow> rows;
    for (const auto& [label, volume] : volumes_) {
        rows.push_back({label, volume, std::ranges::count(taken, label) > 0});
        const auto segment = std::ranges::find(segments_, label, &Segment::label);
        if (segment == segments_.end()) continue;
        rows.back().name = segment->name;
        rows.back().colour = segment->colour;
    }
    return rows;
}

std::string name_of(const LabelRow& row) {
    return row.name.empty() ? "Label " + std::to_string(row.label) : row.name;
}

std::string switched_label(std::vector<LabelRow> rows, int label) {
    const auto changed = std::ranges::find(rows, label, &LabelRow::label);
    if (changed != rows.end() &&
        (!changed->taken || std::ranges::count(rows, true, &LabelRow::taken) > 1))
        changed->taken = !changed->taken;
    std::vector<double> labels;
    for (const LabelRow& row : rows)
        if (row.taken) labels.push_back(row.label);
    return to_text(Value(labels));
}

}  // namespace vesselbench
