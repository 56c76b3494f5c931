#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "workbench/window/features/extraction/extraction_model.h"
#include "workbench/window/features/live/live_smoothing.h"
#include "workbench/window/form/field_text.h"

namespace vesselbench {

/// What a surface was asked for.
struct ExtractionKey {
    int base = 0, changes = 0;

    bool operator==(const ExtractionKey&) const = default;
};

/// The form of an operation that extracts a surface from the image at an iso-value, as the surface
/// in the view follows it live (thesis 6.7.1): without an edit, coarse while values change. Used by
/// the frame's thread.
class LiveExtraction : public LiveForm<ExtractionQuestion, ExtractionModel, ExtractionKey> {
public:
    /// \param wake called by another thread when update() has something to do
    explicit LiveExtraction(std::function<void()> wake);

    /// Once a frame. \return true if what is shown has changed
    bool update(const LiveSmoothing::Followed& followed);

    /// True once for each form, while its surface can follow.
    [[nodiscard]] bool begins();

    // --- the iso-value

    /// Of the image; null: not known yet.
    [[nodiscard]] const std::shared_ptr<const ImageHistogram>& histogram() const {
        return histogram_;
    }

    /// False if labels are extracted.
    [[nodiscard]] bool has_iso() const { return has_iso_; }

    /// True if the vessel has the values below the iso-value.
    [[nodiscard]] bool is_below(const OperationForm& form) const;

    /// The form's; while it is not given, what the operation decides. None: not known yet, or there
    /// is none.
    [[nodiscard]] std::optional<double> iso(const OperationForm& form) const;

    /// The texts that give the form another iso-value. The side of the image on which the vessel
    /// was decided to be goes with it: it would be decided again.
    [[nodiscard]] std::vector<FieldText> iso_texts(const OperationForm& form, double iso) const;

private:
    void take_base(const Document& document);
    void ask_for(const LiveSmoothing::Followed& followed);
    void take_findings();

    std::shared_ptr<const ImageHistogram> histogram_;
    bool has_iso_ = true;
    bool began_ = false;  ///< of the form
    std::shared_ptr<const std::vector<float>> base_image_, base_mask_;
};

}  // namespace vesselbench
