#pragma once

#include <optional>
#include <string>

#include "workbench/session/task.h"
#include "workbench/window/model/document.h"
#include "workbench/window/model/operation_form.h"

namespace vesselbench {

/// The scene that a form's operation runs on: that before the edit to be changed, or before the
/// place of a new one, which need not be the shown scene. Used by the frame's thread.
class FormInput {
public:
    FormInput() = default;

    ~FormInput() { forget(); }

    FormInput(const FormInput&) = delete;
    FormInput& operator=(const FormInput&) = delete;

    /// Once a frame: takes the scene, or asks the session for it while no request runs. Pending
    /// edits are not run.
    /// \param step of a new edit
    void update(Document& document, const OperationForm& form, Step step);

    void forget();

    /// Null while it is not known.
    [[nodiscard]] const Scene* scene() const { return scene_ ? &*scene_ : nullptr; }

    /// Why it cannot be known; empty: it is, or will be.
    [[nodiscard]] const std::string& problem() const { return problem_; }

    [[nodiscard]] bool pending() const { return last_ && !scene_; }

private:
    /// What the edits before the form's depend on.
    struct Key {
        int changes = 0;  ///< Document::snapshot_changes()
        std::optional<EditId> edit;
        Step step = Step::Source;

        bool operator==(const Key&) const = default;
    };

    void find_last(const Document& document, const OperationForm& form, Step step);
    void take();

    std::optional<Key> key_;
    std::optional<HistoryEntry> last_;  ///< the edit whose result is wanted
    bool is_current_ = false;           ///< which is the document's own model
    std::optional<Task<Scene>> job_;
    std::optional<Scene> scene_;
    std::string problem_;
};

}  // namespace vesselbench
