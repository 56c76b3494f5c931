#include "workbench/window/features/extraction/live_extraction.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

constexpr const char *kSide = "inside", *kBelow = "below";  ///< a parameter, and its value

/// A value with the digits that a thousandth of a range asks for.
std::string rounded_text(double value, double range) {
    const double digits = std::ceil(3.0 - std::log10(std::max(range, 1e-12)));
    const int decimals = static_cast<int>(std::clamp(digits, 0.0, 12.0));
    return formatted(value, ("%." + std::to_string(decimals) + "f").c_str());
}

/// Makes the source's surface of an image that is loaded already.
bool extracts(const Operation& operation) {
    return operation.recipe.makes_source && !operation.recipe.loads;
}

/// The parameter that has the iso-value: of two synonyms the one that is given, else the first.
std::string iso_parameter(const OperationForm& form) {
    return form.field("iso").text.empty() ? "threshold" : "iso";
}

std::string reason_against(const LiveSmoothing::Followed& followed) {
    const Document& document = followed.document;
    const Scene* scene = document.current();
    if (!document.snapshot()) return "no case is open";
    if (scene == nullptr || !scene->image || scene->image->empty()) return "there is no image yet";
    return document.why_not_input();
}

std::shared_ptr<const std::vector<float>> voxels_of(const std::optional<Image>& image) {
    return image ? image->voxels : nullptr;
}

}  // namespace

LiveExtraction::LiveExtraction(std::function<void()> wake)
    : LiveForm(std::move(wake), live_extracting()) {}

// --- following the form

void LiveExtraction::take_base(const Document& document) {
    const Scene* scene = document.current();
    const auto image = scene == nullptr ? nullptr : voxels_of(scene->image);
    const auto mask = scene == nullptr ? nullptr : voxels_of(scene->mask);
    if (image == base_image_ && mask == base_mask_) return;
    base_image_ = image;
    base_mask_ = mask;
    histogram_.reset();
    take_new_base();
}

bool LiveExtraction::update(const LiveSmoothing::Followed& followed) {
    const Operation* operation = followed.form != nullptr && extracts(followed.form->operation())
                                     ? &followed.form->operation()
                                     : nullptr;
    if (take_operation(operation) || !has_form()) began_ = false;
    if (followed.document.current() == nullptr) take_base(followed.document);  // closed
    if (!has_form()) return take_models();
    take_base(followed.document);
    take_reason(reason_against(followed));
    const bool changed = take_models();
    if (changed) take_findings();
    if (follows()) ask_for(followed);
    return show(!followed.document.previewed()) || changed;
}

/// What stays known while nothing is followed.
void LiveExtraction::take_findings() {
    if (!model()) return;
    histogram_ = model()->histogram;
    has_iso_ = model()->state.threshold.has_value();
}

bool LiveExtraction::begins() {
    return can_follow() && !std::exchange(began_, true);
}

/// The last question's coarse surface is waited for; what follows it gives way at once.
void LiveExtraction::ask_for(const LiveSmoothing::Followed& followed) {
    const OperationForm& form = *followed.form;
    if (!form.valid()) return;
    ask({base_number(), form.changes()}, is_answered(), [&] {
        const Scene& scene = *followed.document.current();
        return ExtractionQuestion{
            .image = *scene.image,
            .mask = scene.mask,
            .vessel = scene.segmentation.vessel,
            .base = base_number(),
            .arguments = checked_arguments(form.operation(), form.arguments())};
    });
}

// --- the iso-value

std::optional<double> LiveExtraction::iso(const OperationForm& form) const {
    if (const auto typed = number_of(form, iso_parameter(form))) return typed;
    return model() ? model()->state.threshold : std::nullopt;
}

std::vector<FieldText> LiveExtraction::iso_texts(const OperationForm& form, double iso) const {
    const double range = histogram_ ? histogram_->most - histogram_->least : 1.0;
    std::vector<FieldText> texts = {{iso_parameter(form), rounded_text(iso, range)}};
    if (form.field(kSide).text.empty() && is_below(form)) texts.push_back({kSide, kBelow});
    return texts;
}

bool LiveExtraction::is_below(const OperationForm& form) const {
    const std::string& side = form.field(kSide).text;
    return side.empty() ? model() && model()->state.inside_below : side == kBelow;
}

}  // namespace vesselbench
