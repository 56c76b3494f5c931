#include "workbench/prepare/decided_ends.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <optional>
#include <utility>

#include "geometry/kernel/errors.h"
#include "workbench/operations/clip_opening/clipping_record.h"
#include "workbench/operations/clip_opening/parameters.h"
#include "workbench/operations/shared/opening_arguments.h"
#include "workbench/operations/table.h"

namespace vesselbench {

namespace {

/// A place that a user gave lies so near to the end that it means [diameters].
constexpr double kNamedReach = 1.5;

/// A decision, and the rank of it.
struct RankedEnd {
    DecidedEnd end;
    bool named = false;  ///< by a user
};

bool opens_ends(const std::string& name) {
    const Operation* operation = known_operation(name);
    return operation != nullptr && operation->recipe.cuts_ends;
}

/// The revisions of edits that open ends, on the way to the current state: the newest edit first.
std::vector<EditRef> cutting_edits(const Snapshot& made) {
    std::vector<EditRef> edits;
    for (const LogEntry& entry : made.log)
        if (entry.status != EditStatus::Stale) edits.push_back(entry.edit.edit);
    for (const HistoryState* state = &made.history->state(made.history->current());
         state->change != StateChange::Start; state = &made.history->state(state->parent))
        if (state->change == StateChange::Remove) edits.push_back(state->edit);
    std::erase_if(edits, [&](const EditRef& ref) {
        const auto found = made.past->find(ref);
        return found == made.past->end() || !opens_ends(found->second.edit.operation);
    });
    std::ranges::sort(edits, std::greater{});
    return edits;
}

bool is_near(const Positions& places, const Vec3& place, double reach) {
    return std::ranges::any_of(places, [&](const Vec3& p) { return (p - place).norm() <= reach; });
}

/// The decisions of a revision that ran.
class RevisionEnds {
public:
    RevisionEnds(const EditRecord& edit, const ResultRecord& ran)
        : edit_(edit),
          ran_(ran.resolved),
          report_(ran.report),
          leaves_closed_(ran_.is_word("closed_ends", "leave")),
          inlets_(points_of(ran_, "inlet")),
          open_(points_of(ran_, "open")),
          closed_(points_of(ran_, "closed")) {
        if (ran_.has("planes")) openings_ = openings_in(ran_.records("planes"));
        if (ran_.has("names")) patches_ = patches_in(ran_.records("names"));
    }

    /// Of every end that was found; empty: the report does not say.
    [[nodiscard]] std::vector<RankedEnd> reported() const {
        std::vector<RankedEnd> ends;
        for (const ReportedEnd& end : reported_ends(report_))
            if (auto found = reported_end(end)) ends.push_back(std::move(*found));
        return ends;
    }

    /// Of the openings alone.
    [[nodiscard]] std::vector<RankedEnd> opened() const {
        std::vector<RankedEnd> ends;
        for (std::size_t i = 0; i < std::min(openings_.size(), patches_.size()); ++i)
            ends.push_back(decided(openings_[i].place.tip, 0.0, role_of(patches_[i]), true));
        return ends;
    }

private:
    [[nodiscard]] RankedEnd decided(const Vec3& place, double diameter, EndRole role,
                                    bool named) const {
        return {{place, diameter, role, edit_.edit, edit_.place.variant}, named};
    }

    static EndRole role_of(const Patch& patch) {
        return patch.kind == PatchKind::Inlet ? EndRole::Inlet : EndRole::Open;
    }

    [[nodiscard]] EndRole role_of(const std::string& opening) const {
        const auto patch = std::ranges::find(patches_, opening, &Patch::name);
        return patch == patches_.end() ? EndRole::Open : role_of(*patch);
    }

    /// None: nothing was decided, as of a part of another end.
    [[nodiscard]] std::optional<RankedEnd> reported_end(const ReportedEnd& end) const {
        const double reach = kNamedReach * end.diameter;
        if (end.opening)
            return decided(end.place, end.diameter, role_of(*end.opening),
                           ran_.has("tip") || is_near(inlets_, end.place, reach) ||
                               is_near(open_, end.place, reach));
        if (!end.numbered || end.fate != to_string(EndFate::Closed)) return std::nullopt;
        const bool named = is_near(closed_, end.place, reach);
        if (leaves_closed_ && !named) return std::nullopt;
        return decided(end.place, end.diameter, EndRole::Closed, named);
    }

    const EditRecord& edit_;
    const Arguments& ran_;
    const std::string& report_;
    bool leaves_closed_;
    Positions inlets_, open_, closed_;
    std::vector<PlannedOpening> openings_;
    std::vector<Patch> patches_;
};

/// A revision whose planes were given reports no other ends: what an earlier one closed ranks
/// behind its openings.
/// \throw UsageError if a record is none of this program
std::vector<RankedEnd> ends_of_edit(const Snapshot& made, EditRef edit) {
    std::vector<RankedEnd> opened;
    for (EditRef ref = edit; ref.revision > 0; --ref.revision) {
        const auto past = made.past->find(ref);
        if (past == made.past->end() || !past->second.first) continue;
        const ResultRecord& ran = *past->second.first;
        const RevisionEnds ends(past->second.edit, ran);
        if (ref == edit) opened = ends.opened();
        std::vector<RankedEnd> all = ends.reported();
        if (all.empty()) continue;
        if (ref == edit) return all;
        std::erase_if(all, [](const RankedEnd& end) { return end.end.role != EndRole::Closed; });
        opened.insert(opened.end(), all.begin(), all.end());
        break;
    }
    return opened;
}

/// None of a record of another version, or by a stranger.
std::vector<RankedEnd> readable_ends(const Snapshot& made, EditRef edit) {
    try {
        return ends_of_edit(made, edit);
    } catch (const UsageError&) {
        return {};
    }
}

}  // namespace

std::vector<DecidedEnd> decided_ends(const Snapshot& made) {
    std::vector<RankedEnd> ranked;
    for (const EditRef& edit : cutting_edits(made))
        std::ranges::move(readable_ends(made, edit), std::back_inserter(ranked));
    const auto rank = [&](const RankedEnd& end) {
        return std::pair(made.history->find(end.end.edit.id).has_value(), end.named);
    };
    std::ranges::stable_sort(ranked, std::greater{}, rank);
    std::vector<DecidedEnd> ends;
    for (RankedEnd& end : ranked) ends.push_back(std::move(end.end));
    return ends;
}

}  // namespace vesselbench
