#include "workbench/window/features/openings/end_rows.h"

#include <algorithm>
#include <utility>

#include "geometry/kernel/wording.h"
#include "geometry/vessel/openings/end_texts.h"

namespace vesselbench {

namespace {

EndWish wish_of(const EndChoices& choices, const PlannedEnds& planned, const std::set<int>& inlets,
                const EndRecord& end) {
    if (choices.removed.contains(end.number)) return EndWish::Removed;
    if (is_open(choices, planned, end.number))
        return inlets.contains(end.number) ? EndWish::Inlet : EndWish::Outlet;
    const bool named = choices.closed.contains(end.number);
    return !named && planned.decided(end).fate == EndFate::Removed ? EndWish::Removed
                                                                   : EndWish::Closed;
}

PlannedEnds without_user(const PlannedEnds& planned) {
    return {.plain = planned.plain, .chosen = {}, .problem = {}};
}

bool is_named(const EndChoices& choices, int number) {
    return choices.open.contains(number) || choices.closed.contains(number) ||
           choices.inlets.contains(number) || choices.removed.contains(number);
}

/// A plan that is older than the wishes says what was asked for then.
std::string reason_of(const EndRecord& decided, const EndRecord& plain, bool chosen) {
    return !chosen && (decided.asked || decided.wanted) ? plain.why : decided.why;
}

/// Takes back what was said about an end.
void forget(EndChoices& choices, int number) {
    for (std::set<int>* set : {&choices.open, &choices.closed, &choices.inlets, &choices.removed})
        set->erase(number);
}

/// An end that is as planned need not be named, unless that settles a doubt.
void open_end(EndChoices& choices, const EndRecord& end) {
    const bool doubtful = end.verdict && end.verdict->doubtful;
    if (doubtful || !end.opening) choices.open.insert(end.number);
}

void close_end(EndChoices& choices, const EndRecord& end) {
    const bool doubtful = end.verdict && end.verdict->doubtful;
    choices.cuts.erase(end.number);
    if (doubtful || end.opening || end.fate == EndFate::Removed) choices.closed.insert(end.number);
}

}  // namespace

std::string to_string(EndWish wish) {
    switch (wish) {
        case EndWish::Inlet:
            return "Inlet";
        case EndWish::Outlet:
            return "Outlet";
        case EndWish::Closed:
            return "Closed";
        case EndWish::Removed:
            return "Removed";
    }
    return "";
}

std::vector<EndRow> rows_of(const EndChoices& choices, const PlannedEnds& planned) {
    const PlannedEnds plain = without_user(planned);
    const std::set<int> inlets = inlets_of(choices, planned), before = inlets_of({}, plain);
    std::vector<EndRow> rows;
    for (std::size_t e = 0; e < planned.plain->plan.ends.size(); ++e) {
        const EndRecord& end = planned.plain->plan.ends[e];
        if (end.number == 0) continue;
        const bool chosen = is_named(choices, end.number);
        EndRow row{.number = end.number,
                   .place = end.place,
                   .diameter = end.diameter,
                   .share = end.share(),
                   .odds = end.verdict ? end.verdict->odds.opening : 0.0,
                   .wish = wish_of(choices, planned, inlets, end),
                   .planned = wish_of({}, plain, before, end),
                   .chosen = chosen,
                   .doubtful = !chosen && end.verdict && end.verdict->doubtful,
                   .removable = planned.plain->removable[e],
                   .sac = end.verdict && looks_like_sac(*end.verdict),
                   .moved = choices.cuts.contains(end.number),
                   .why = reason_of(planned.decided(end), end, chosen)};
        if (row.is_open()) row.cut = opening_of(choices, planned, end.number);
        rows.push_back(std::move(row));
    }
    std::ranges::sort(rows, {},
                      [](const EndRow& row) { return std::pair(!row.doubtful, row.number); });
    return rows;
}

EndWish next_wish(const EndRow& row) {
    if (row.is_open()) return EndWish::Closed;
    return row.wish == EndWish::Closed && row.removable ? EndWish::Removed : EndWish::Outlet;
}

EndChoices with_wish(EndChoices choices, const PlannedEnds& planned, int number, EndWish wish) {
    const EndRecord* end = planned.plain->end(number);
    if (end == nullptr) return choices;
    forget(choices, number);
    switch (wish) {
        case EndWish::Inlet: {
            const std::set<int> others = std::exchange(choices.inlets, {number});
            for (const int other : others)
                if (const EndRecord* opened = planned.plain->end(other); opened != nullptr)
                    open_end(choices, *opened);
            break;
        }
        case EndWish::Outlet:
            open_end(choices, *end);
            break;
        case EndWish::Closed:
            close_end(choices, *end);
            break;
        case EndWish::Removed:
            choices.cuts.erase(number);
            if (end->fate != EndFate::Removed) choices.removed.insert(number);
            break;
    }
    return choices;
}

EndChoices with_another_inlet(EndChoices choices, const PlannedEnds& planned, int number) {
    const std::set<int> inlets = inlets_of(choices, planned);
    forget(choices, number);
    choices.inlets.insert(inlets.begin(), inlets.end());
    choices.inlets.insert(number);
    return choices;
}

std::string summary_of(const std::vector<EndRow>& rows) {
    std::vector<std::string> changed;
    for (const EndRow& row : rows)
        if (row.is_changed()) changed.push_back(std::to_string(row.number));
    const auto open = std::ranges::count_if(rows, &EndRow::is_open);
    const auto doubts = std::ranges::count_if(rows, &EndRow::doubtful);
    std::string text = std::to_string(open) + " of " + counted(rows.size(), "end") + " open";
    if (doubts > 0) text += ", " + std::to_string(doubts) + " in doubt";
    if (!changed.empty()) text += "; changed: " + joined(changed);
    return text;
}

}  // namespace vesselbench
