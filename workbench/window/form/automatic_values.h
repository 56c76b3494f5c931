#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "workbench/session/task.h"
#include "workbench/window/case/document.h"
#include "workbench/window/form/operation_form.h"

namespace vesselbench {

/// What the form's operation would decide for the fields that are left empty, on the document's
/// current model. It is found in the background when the fields rest. Used by the frame's thread.
class AutomaticValues {
public:
    /// \param wake called by the other thread when update() has something to do
    explicit AutomaticValues(std::function<void()> wake) : task_(std::move(wake)) {}

    /// Once a frame; fills in the form's decisions. \param form null: none
    /// \return true if they have changed
    bool update(const Document& document, OperationForm* form);

    [[nodiscard]] bool pending() const { return task_.pending(); }

private:
    /// What decisions depend on: equal ones are not asked for again.
    struct Question {
        const Operation* operation = nullptr;
        Arguments given;
        std::shared_ptr<const Positions> positions;
        std::shared_ptr<const std::vector<float>> image, mask;
        std::size_t neighbours = 0;

        bool operator==(const Question&) const = default;

        /// True if only what is given differs.
        [[nodiscard]] bool has_ground_of(Question other) const;
    };

    [[nodiscard]] static Question question_of(const OperationForm& form, const Scene& scene);
    void ask(const OperationForm& form, const Scene& scene);
    void forget();

    Task<Arguments> task_;
    std::optional<Question> asked_;
    Arguments known_;  ///< of the question's model
};

/// What a field shows while it is empty: "automatic: 0.48", "required", a default.
[[nodiscard]] std::string unset_text(const FormField& field);

}  // namespace vesselbench
