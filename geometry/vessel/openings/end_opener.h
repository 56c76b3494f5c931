#pragma once

#include <cstddef>
#include <string>

#include "geometry/vessel/openings/cut_trial.h"
#include "geometry/vessel/openings/plan_draft.h"

namespace vesselbench {

/// Opens the ends of a draft one after the other: keeps their rims and caps, or cuts them where no
/// earlier opening is in the way. Not thread-safe.
class EndOpener {
public:
    /// Keeps references to both.
    EndOpener(PlanDraft& draft, const Progress& progress);

    /// Keeps a good cap or rim as it is. False: the end has none.
    bool keep(std::size_t e);

    /// Cuts an end across its vessel; else along its own rim, unless it is a stub that can go.
    /// False: there is no place for a cut, and the record says why.
    /// \throw Cancelled if the user cancels
    bool cut(std::size_t e);

    /// So short that its branch can be removed instead, and that has not failed before.
    [[nodiscard]] bool is_stub(std::size_t e) const;

private:
    bool cut_across(std::size_t e);
    bool cut_elsewhere(std::size_t e);
    bool keep_bent(std::size_t e);
    bool keep_oblique(std::size_t e);
    [[nodiscard]] bool is_free(const OpeningPlace& place, std::size_t e);
    bool make_cut(std::size_t e, const OpeningPlace& place, const std::string& why,
                  bool chosen = false);

    PlanDraft& draft_;
    const Progress& progress_;
    CutTrials trials_;
};

}  // namespace vesselbench
