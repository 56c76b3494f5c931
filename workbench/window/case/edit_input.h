#pragma once

#include <optional>
#include <string>
#include <vector>

#include "workbench/case/history.h"

namespace vesselbench {

/// Where an edit belongs that a form makes.
struct EditSite {
    std::optional<EditId> edit;  ///< of the current state, to be changed; none: a new one
    Step step = Step::Source;    ///< a new one follows the edits of this step

    bool operator==(const EditSite&) const = default;
};

/// What an edit runs on.
struct EditInput {
    EditSite site;
    std::vector<HistoryEntry> before;  ///< the edits that precede it, in order; not empty
    ResultId result = 0;               ///< after those of them that are known
    bool has_pending = false;          ///< one of them has not run: `result` is that before it
    bool has_later = false;            ///< other edits follow it
};

/// What an edit of the current state would run on.
/// \param variant that is shown
/// \return none if no edit precedes it, or the state does not contain it
[[nodiscard]] std::optional<EditInput> input_of(const EditSite& site, const History& history,
                                                const std::string& variant);

/// False for a new edit at the end of the variant: it runs on the newest model.
[[nodiscard]] bool is_earlier(const EditInput& input);

/// Which model the input is, and what becomes of the edits behind it: "The model before step 4,
/// Openings: edit 3, Clip opening. ..."
/// \param operation of the edit
[[nodiscard]] std::string input_text(const EditInput& input, const std::string& operation);

}  // namespace vesselbench
