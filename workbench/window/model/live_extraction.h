#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "geometry/kernel/stopwatch.h"
#include "workbench/window/model/extraction_model.h"
#include "workbench/window/model/field_text.h"
#include "workbench/window/model/live_smoothing.h"

namespace vesselbench {

/// The form of an operation that extracts a surface from the image at an iso-value, as the surface
/// in the view follows it live (thesis 6.7.1): without an edit, coarse while values change. Used by
/// the frame's thread.
class LiveExtraction {
public:
    /// \param wake called by another thread when update() has something to do
    explicit LiveExtraction(std::function<void()> wake);

    /// Once a frame. \return true if what is shown has changed
    bool update(const LiveSmoothing::Followed& followed);

    /// True if the form is of such an operation.
    [[nodiscard]] bool has_form() const { return has_form_; }

    /// Why the surface cannot follow the form; empty: it can.
    [[nodiscard]] const std::string& why_not() const { return why_not_; }

    [[nodiscard]] bool can_follow() const { return has_form_ && why_not_.empty(); }

    /// Begins or ends to show what the form says.
    void follow(bool on);

    [[nodiscard]] bool follows() const { return on_; }

    /// True once for each form, while its surface can follow.
    [[nodiscard]] bool begins();

    /// What the view shows instead of the document's surface; null: nothing.
    [[nodiscard]] const std::shared_ptr<const ExtractionModel>& shown() const { return shown_; }

    /// The last surface, also while something else is shown; null: none.
    [[nodiscard]] const std::shared_ptr<const ExtractionModel>& model() const {
        return models_.newest();
    }

    /// True while shown() does not answer the form as it is now, or is coarse.
    [[nodiscard]] bool outdated() const;

    /// Why the form cannot be answered; empty: no problem.
    [[nodiscard]] const std::string& problem() const { return models_.problem(); }

    [[nodiscard]] bool pending() const { return on_ && models_.pending(); }

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
    /// was decided to be goes with it: it would be decided anew.
    [[nodiscard]] std::vector<FieldText> iso_texts(const OperationForm& form, double iso) const;

    /// A drag begins.
    void begin_slide();

    /// The drag is cancelled: what was not followed before it is no longer.
    void cancel_slide();

private:
    void take_base(const Document& document);
    void ask(const LiveSmoothing::Followed& followed);
    void take_findings();
    [[nodiscard]] bool is_worked_on() const;

    /// What a question was asked for.
    struct Asked {
        int base = -1, changes = -1;

        bool operator==(const Asked&) const = default;
    };

    ExtractionModels models_;
    std::shared_ptr<const ExtractionModel> shown_;
    std::shared_ptr<const ImageHistogram> histogram_;
    bool has_iso_ = true;
    bool on_ = false, has_form_ = false, on_before_slide_ = false;
    bool began_ = false;  ///< of the form
    std::string why_not_;
    std::shared_ptr<const std::vector<float>> base_image_, base_mask_;
    int base_ = 0;
    const Operation* operation_ = nullptr;
    Asked asked_;
    std::uint64_t question_ = 0;
    Stopwatch since_asked_;
};

}  // namespace vesselbench
