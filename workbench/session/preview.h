#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "workbench/case/arguments.h"
#include "workbench/project/project.h"
#include "workbench/session/edit_run.h"

namespace vesselbench {

/// An edit that has run and may be entered by Session::commit() without running again: a value that
/// any thread may hold. It keeps its scenes in memory during its lifetime.
class Preview {
public:
    /// The edit to be entered. The id of a new edit is 0; it gets one on commit.
    [[nodiscard]] const EditRecord& edit() const { return data_->edit; }

    /// The scene after the edit.
    [[nodiscard]] const Scene& scene() const { return *data_->run.scene; }

    /// The scene it ran on.
    [[nodiscard]] const Scene& input() const { return data_->run.input; }

    /// The result it ran on; none if pending edits before it had to run for the preview: they are
    /// committed with it.
    [[nodiscard]] std::optional<ResultId> input_id() const { return data_->before.end; }

    /// Figures, warnings and resolved arguments; its ids are set on commit.
    [[nodiscard]] const ResultRecord& result() const { return data_->run.record; }

private:
    friend class Session;

    struct Data {
        EditRecord edit;
        EditRun run;
        EvaluatedLine before;             ///< the edits that precede it
        std::vector<SourceFile> sources;  ///< that it read
    };

    explicit Preview(Data data) : data_(std::make_shared<const Data>(std::move(data))) {}

    std::shared_ptr<const Data> data_;
};

}  // namespace vesselbench
