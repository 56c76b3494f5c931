#pragma once

#include <filesystem>
#include <string>

namespace vesselbench {

/// What a project keeps beside its history: it is of the project, not of a state, and undo does
/// not change it. Each is JSON.
enum class StoredText {
    Recipes,       ///< those that the case brought along
    GivenRecipes,  ///< those that files gave, by the purpose's name
    Flow,          ///< the arguments given for the flow, of those in flow_parameters()
    Spots,         ///< stored_spots.h
    Warnings,      ///< of a recipe, beside those of the edits
    Purposes,      ///< that it was prepared for, the last one last
    InputName,     ///< the one that was given in place of the input's own
    Acceptance,    ///< how many reviewers a purpose's products require, by its name
    CaseFolder,    ///< where the files of these recipes are, relative to the project's folder
    Measures,      ///< stored_measures.h
    Dismissals     ///< findings/dismissals.h
};

/// What the record says of a text that was replaced.
struct StoredChange {
    std::string subject = "project";
    std::string facts = "{}";  ///< a JSON object
};

/// Keeps a text in a project file, which a session of this process may have open.
/// \throw IoError if the project cannot be written
void store_text(const std::filesystem::path& project, StoredText which, const std::string& text,
                const StoredChange& change = {});

/// A text in a project file; empty: it has none.
/// \throw IoError, InvalidInput if it cannot be read
[[nodiscard]] std::string stored_text(const std::filesystem::path& project, StoredText which);

/// Keeps how a window shows a project's model, in the project file. It says nothing of the case:
/// the record neither binds it nor has an entry for it. \param text JSON
/// \throw IoError if the project cannot be written
void store_view(const std::filesystem::path& project, const std::string& text);

/// That text; empty: the project has none.
/// \throw IoError, InvalidInput if it cannot be read
[[nodiscard]] std::string stored_view(const std::filesystem::path& project);

}  // namespace vesselbench
