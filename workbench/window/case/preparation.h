#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "workbench/prepare/input.h"
#include "workbench/prepare/prepare.h"
#include "workbench/prepare/resumed_recipe.h"
#include "workbench/session/session_runner.h"
#include "workbench/window/case/message.h"

namespace vesselbench {

/// The messages of a recipe while it runs, handed from the session's thread to the frame's.
class RecipeMessages {
public:
    void add(Message message);

    /// Those since the last call.
    [[nodiscard]] std::vector<Message> take();

private:
    std::mutex mutex_;
    std::vector<Message> messages_;
};

/// A recipe that runs on a case, one entry after the other, so that the view follows it.
struct Preparation {
    Recipe recipe;
    std::string purpose;
    std::filesystem::path project;
    std::size_t next = 0;      ///< the entry that runs
    std::size_t warnings = 0;  ///< so far
    bool cancelled = false;    ///< no further entry is started

    [[nodiscard]] bool done() const { return next == recipe.size(); }

    [[nodiscard]] const std::string& operation() const {
        return recipe[next].given.operation().name;
    }

    /// Starts the next entry; after the last one the project is prepared for the purpose.
    /// \param messages receives what it reports
    [[nodiscard]] Task<Nothing> start(SessionRunner& runner,
                                      const std::shared_ptr<RecipeMessages>& messages) const;
};

/// What is left of a purpose's recipe in a case: its own recipe, else the default one.
/// \param input with the case's own recipes; none: it has none
/// \param scene of the case; null: none
/// \param done the purposes whose model was made
[[nodiscard]] ResumedRecipe missing_entries(const Snapshot& snapshot,
                                            const std::optional<Input>& input, const Scene* scene,
                                            const std::string& purpose,
                                            const std::vector<std::string>& done);

/// A remark of a line; the names of a step and an operation at its beginning are put in the
/// window's words.
[[nodiscard]] Message message_from(const std::string& text);

}  // namespace vesselbench
