#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tests/soak/random_arguments.h"
#include "workbench/session/session.h"

namespace vesselbench::soak {

/// What a random user did.
using Tally = std::map<std::string, std::size_t>;

/// Uses a session at random: applies every operation of the table, changes and removes earlier
/// edits, moves through the states, shows scenes, writes notes and files. The same seed does the
/// same on the same session.
class RandomEditor {
public:
    RandomEditor(std::uint64_t seed, const SmallFiles& files);

    /// One action. What cannot be done, by the words of the program, is counted as refused.
    /// \return what it did: "apply smooth", "undo"
    /// \throw what is no error of the program's own
    std::string act(Session& session);

    /// The program's words on the last action, if it could not be done.
    [[nodiscard]] const std::string& reason() const { return reason_; }

    /// Writes an exported surface of the session's scene into a folder.
    void set_export_folder(std::filesystem::path folder) { export_folder_ = std::move(folder); }

    [[nodiscard]] const Tally& tally() const { return tally_; }

private:
    using Action = std::string (RandomEditor::*)(Session&);

    std::string apply(Session& session);
    std::string change(Session& session);
    std::string remove(Session& session);
    std::string undo(Session& session);
    std::string redo(Session& session);
    std::string go_to(Session& session);
    std::string go_by_edit(Session& session);
    std::string show(Session& session);
    std::string note(Session& session);
    std::string write(Session& session);

    const Operation& some_operation(const Session& session, const Scene& scene);
    std::optional<EditId> some_edit(const Session& session);
    Scene scene_before(Session& session);

    forest::Dice dice_;
    const SmallFiles& files_;
    Tally tally_;
    std::string doing_, reason_;
    std::filesystem::path export_folder_;
};

/// Session options for the operations of the table. \param worker command; empty: this program
[[nodiscard]] SessionOptions table_options(std::vector<std::string> worker = {});

/// What does not reproduce in the current state, in words, by: replaying each edit on its stored
/// input; applying all edits again from nothing with their resolved arguments; reading every
/// argument back from the command line's, JSON's and the project's text. Empty: nothing.
/// Runs pending edits before. \param options of the session that starts from nothing
[[nodiscard]] std::vector<std::string> unreproduced(Session& session, const SmallFiles& files,
                                                    const SessionOptions& options);

}  // namespace vesselbench::soak
