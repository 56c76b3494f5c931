#include "workbench/prepare/decided_entry.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/argument_texts.h"
#include "workbench/case/checked_arguments.h"
#include "workbench/operations/clip_opening/clipping.h"
#include "workbench/operations/clip_opening/parameters.h"
#include "workbench/prepare/decided_ends.h"

namespace vesselbench {

namespace {

/// An end that lies farther from where it was decided about ends another vessel: by its diameter
/// now or then, as a sac may have lost a part [diameters].
constexpr double kSameEnd = 1.0;

constexpr const char* kCutsChosen = "the cuts that were given by hand are chosen again";

/// A parameter of places, with more of them.
void add_places(GivenArguments& given, const char* parameter, const Positions& more) {
    if (more.empty()) return;
    Positions places = points_of(given, parameter);
    places.insert(places.end(), more.begin(), more.end());
    std::vector<double> numbers;
    for (const Vec3& place : places)
        numbers.insert(numbers.end(), {place.x(), place.y(), place.z()});
    given.set(parameter, numbers);
}

/// Ends that are named by their numbers, by their places: the numbers are those of the plan that is
/// made without any names.
GivenArguments with_places(const GivenArguments& given, const Scene& scene,
                           const Progress& progress) {
    if (!names_numbers(given)) return given;
    GivenArguments placed(given.operation());
    for (const auto& [name, value] : given->values())
        if (std::ranges::none_of(kNumberParameters,
                                 [&](const NumberParameter& p) { return name == p.numbers; }))
            placed.set(name, value);
    const OpeningPlan plan = planned_openings(scene, checked_arguments(placed), progress);
    for (const NumberParameter& parameter : kNumberParameters) {
        if (!given->has(parameter.numbers)) continue;
        Positions places;
        for (const double number : given->list(parameter.numbers))
            for (const EndRecord& end : plan.ends)
                if (end.number == number) places.push_back(end.place);
        if (places.size() < given->list(parameter.numbers).size()) return given;  // it is refused
        add_places(placed, parameter.places, places);
    }
    return placed;
}

/// The last edit before those of an entry; none: there is none.
std::optional<EditId> edit_before(const std::vector<LogEntry>& log, Step step) {
    std::optional<EditId> last;
    for (const LogEntry& entry : log)
        if (entry.edit.place.step <= step) last = entry.edit.edit.id;
    return last;
}

bool is_open(const EndRecord& end) {
    return end.opening.has_value();
}

/// Of an end that may be decided about.
bool is_judged(const EndRecord& end) {
    return end.number > 0;
}

/// What was decided, end by end, about the ends that the odds alone decide about.
class Decisions {
public:
    Decisions(const OpeningPlan& plan, const std::vector<DecidedEnd>& decided,
              const Arguments& given)
        : plan_(plan),
          leaves_closed_(given.text("closed_ends") == "leave"),
          names_inlets_(given.has("inlet")) {
        for (const EndRecord& end : plan.ends) found_.push_back(decision(end, decided));
        if (!leaves_closed_ && !names_inlets_) take_inlets();
        for (std::size_t e = 0; e < found_.size(); ++e) take(e);
    }

    [[nodiscard]] GivenArguments added_to(GivenArguments given) const {
        add_places(given, "inlet", inlets_);
        add_places(given, "open", open_);
        add_places(given, "closed", closed_);
        return given;
    }

    /// As DecidedEntry has it.
    [[nodiscard]] std::string remark() const {
        std::vector<std::string> texts, variants;
        for (const DecidedEnd* end : used_) {
            const std::string where =
                end->variant.empty() ? "the shared steps" : "the variant " + end->variant;
            if (std::ranges::count(variants, where) == 0) variants.push_back(where);
        }
        const auto add = [&](const std::string& role, const Positions& places) {
            for (const Vec3& place : places) texts.push_back(role + " at " + place_text(place));
        };
        add("inlet", inlets_);
        add("open", open_);
        add("closed", closed_);
        if (texts.empty()) return "";
        return counted(texts.size(), "end") + " as decided in " + joined(variants) + ": " +
               joined(texts);
    }

private:
    /// The nearest one of the edit that ranks first. Null: nothing was decided, or the entry itself
    /// names the end.
    [[nodiscard]] const DecidedEnd* decision(const EndRecord& end,
                                             const std::vector<DecidedEnd>& decided) const {
        if (!is_judged(end) || end.wanted || (end.asked && !leaves_closed_)) return nullptr;
        const DecidedEnd* found = nullptr;
        for (const DecidedEnd& past : decided)
            if (is_about(past, end) &&
                (found == nullptr ||
                 (past.edit == found->edit && distance(past, end) < distance(*found, end))))
                found = &past;
        return found;
    }

    static double distance(const DecidedEnd& past, const EndRecord& end) {
        return (past.place - end.place).norm();
    }

    [[nodiscard]] bool is_about(const DecidedEnd& past, const EndRecord& end) const {
        return distance(past, end) <= kSameEnd * std::max(end.diameter, past.diameter) &&
               &end == nearest_end(past.place);
    }

    [[nodiscard]] const EndRecord* nearest_end(const Vec3& place) const {
        const EndRecord* nearest = nullptr;
        for (const EndRecord& end : plan_.ends)
            if (is_judged(end) && (nearest == nullptr ||
                                   (end.place - place).norm() < (nearest->place - place).norm()))
                nearest = &end;
        return nearest;
    }

    /// The inlets are those of one edit, and named where the plan has others.
    void take_inlets() {
        const auto is_inlet = [](const DecidedEnd* end) {
            return end != nullptr && end->role == EndRole::Inlet;
        };
        std::optional<EditRef> edit;
        for (const DecidedEnd* end : found_)
            if (is_inlet(end)) edit = std::max(edit.value_or(EditRef{}), end->edit);
        if (!edit) return;
        bool same = !plan_.inlet_doubtful, all_known = true;
        for (std::size_t e = 0; e < found_.size(); ++e) {
            const bool inlet = is_inlet(found_[e]) && found_[e]->edit == *edit;
            same = same && inlet == (planned_role(plan_, plan_.ends[e]) == EndRole::Inlet);
            all_known = all_known && (found_[e] != nullptr || !is_open(plan_.ends[e]));
        }
        // Where blood gathers, an end that nobody decided about is an inlet, too.
        if (same || (plan_.gathers && !all_known)) return;
        for (std::size_t e = 0; e < found_.size(); ++e)
            if (is_inlet(found_[e]) && found_[e]->edit == *edit) use(e, inlets_);
    }

    void take(std::size_t e) {
        const EndRecord& end = plan_.ends[e];
        if (found_[e] == nullptr || end.fate == EndFate::Removed ||
            std::ranges::count(inlets_, end.place) > 0)
            return;
        const bool doubtful = !leaves_closed_ && end.verdict && end.verdict->doubtful;
        if (found_[e]->role == EndRole::Closed) {
            if (is_open(end) || doubtful) use(e, closed_);
        } else if (!leaves_closed_ && (!is_open(end) || doubtful)) {
            use(e, open_);
        }
    }

    void use(std::size_t e, Positions& places) {
        places.push_back(plan_.ends[e].place);
        used_.push_back(found_[e]);
    }

    const OpeningPlan& plan_;
    bool leaves_closed_, names_inlets_;
    std::vector<const DecidedEnd*> found_;  ///< by end of the plan
    Positions inlets_, open_, closed_;
    std::vector<const DecidedEnd*> used_;
};

/// True if a plan can be made: what is decided must not refuse a model that the odds would make.
bool can_be_planned(const GivenArguments& given, const Scene& scene, const Progress& progress) {
    try {
        static_cast<void>(planned_openings(scene, checked_arguments(given), progress));
        return true;
    } catch (const AlgorithmFailure&) {
        return false;
    }
}

/// True if an entry opens all ends of a vessel.
bool opens_all(const GivenArguments& given) {
    return given.operation().recipe.cuts_ends && !given->has("tip");
}

/// True if it also decides where.
bool decides_all(const GivenArguments& given) {
    return opens_all(given) && !given->has("planes");
}

/// \param decided by falling rank  \param before the last edit before that of the entry
DecidedEntry completed(const RecipeEntry& entry, const std::vector<DecidedEnd>& decided,
                       std::optional<EditId> before, Session& session, const Progress& progress) {
    DecidedEntry made{.entry = entry, .remark = ""};
    const GivenArguments& given = entry.given;
    if (decided.empty() || !before) return made;
    const Scene scene = session.scene_after(*before, progress);
    if (!scene.surface) return made;
    try {
        const GivenArguments placed = with_places(given, scene, progress);
        const CheckedArguments all = checked_arguments(placed);
        const OpeningPlan plan = planned_openings(scene, all, progress);
        const Decisions decisions(plan, decided, all);
        std::string remark = decisions.remark();
        if (remark.empty()) return made;
        const GivenArguments completed = decisions.added_to(placed);
        if (!can_be_planned(completed, scene, progress)) return made;
        made.entry.given = completed;
        made.remark = std::move(remark);
    } catch (const AlgorithmFailure&) {  // the operation itself says what is wrong
    }
    return made;
}

bool names_ends(const Arguments& given) {
    return std::ranges::any_of(kNumberParameters, [&](const NumberParameter& p) {
        return given.has(p.numbers) || given.has(p.places);
    });
}

/// Without what names ends: their roles and cuts.
GivenArguments without_ends(const GivenArguments& given) {
    Arguments left = given;
    for (const NumberParameter& parameter : kNumberParameters) {
        left.remove(parameter.numbers);
        left.remove(parameter.places);
    }
    for (const char* name : {"planes", "names", "closings"}) left.remove(name);
    return given_arguments(given.operation(), left);
}

/// With those of the edit itself first. \param turned the blood flows another way: inlets are open
std::vector<DecidedEnd> decided_first(std::vector<DecidedEnd> decided, EditId edit, bool turned) {
    std::ranges::stable_partition(decided,
                                  [&](const DecidedEnd& end) { return end.edit.id == edit; });
    for (DecidedEnd& end : decided)
        if (turned && end.role == EndRole::Inlet) end.role = EndRole::Open;
    return decided;
}

}  // namespace

DecidedEntry decided_entry(const RecipeEntry& entry, Session& session, const std::string& variant,
                           const Progress& progress) {
    if (!decides_all(entry.given)) return {.entry = entry, .remark = ""};
    return completed(entry, decided_ends(*session.snapshot()),
                     edit_before(session.log(variant), step_of(entry)), session, progress);
}

DecidedEntry decided_change(EditId edit, const GivenArguments& more, Session& session,
                            const Progress& progress) {
    const std::vector<LogEntry> all = session.log();
    const auto old = std::ranges::find(all, edit, [](const LogEntry& e) { return e.edit.edit.id; });
    if (old == all.end()) throw UsageError("the current state has no edit " + std::to_string(edit));
    Arguments former = old->edit.given;
    const auto past = session.snapshot()->past;
    if (const auto ran = past->find(old->edit.edit); ran != past->end() && ran->second.first)
        former = with_found_places(std::move(former), ran->second.first->resolved);
    GivenArguments given = given_arguments(more.operation(), former);
    const bool other_ends = opens_all(given) && names_ends(more);
    const bool loses_cuts = other_ends && given->has("planes") && !more->has("planes");
    if (other_ends) given = without_ends(given);
    given.set(more);
    const RecipeEntry entry{.given = given, .step = old->edit.place.step};
    if (!decides_all(given)) return {.entry = entry, .remark = ""};
    std::optional<EditId> before;
    for (const LogEntry& each : session.log(old->edit.place.variant)) {
        if (each.edit.edit.id == edit) break;
        before = each.edit.edit.id;
    }
    DecidedEntry made = completed(
        entry, decided_first(decided_ends(*session.snapshot()), edit, more->has("vessel")), before,
        session, progress);
    if (loses_cuts) made.remark += std::string(made.remark.empty() ? "" : "; ") + kCutsChosen;
    return made;
}

}  // namespace vesselbench
