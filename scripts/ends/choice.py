"""The program's choice (geometry/vessel/ends/end_choice.cpp) by given models, and whether it is right."""
import csv
import dataclasses
import math
import os

from common import ROOT

# As in end_choice.h and end_choice.cpp.
LEAST_SHARE, LIKELY, FEWEST_CUTS, FEWEST_OPENINGS = 0.05, 2.0, 2, 2


@dataclasses.dataclass
class Limits:
    """Where doubt ends: EndLimits of end_choice.h."""
    certain: float
    inlet_certain: float
    wider_outlet: float


def present_limits():
    with open(os.path.join(ROOT, "geometry", "vessel", "ends", "end_limits.csv")) as table:
        rows = csv.reader(line for line in table if line[0] != "#")
        return Limits(**{name: float(value) for name, value in list(rows)[1:]})


PRESENT = present_limits()


@dataclasses.dataclass
class Result:
    """What becomes of a case."""
    case: object
    verdict: str     # right, wrong, doubt, refused
    rightly: bool    # of a doubt or a refusal: the likeliest choice would be wrong
    why: list
    ends: list       # (likelihood of an opening, label) of the candidates whose truth is known
    inlet: tuple     # (likelihood of the one that is taken, whether it is accepted), or None
    asked_inlet: bool = False
    widest_accepted: bool | None = None  # whether the widest open end is an inlet; None: all or none of them are


# What the page shows of each limit beside the others as they are.
TRIED = {"certain": (1.5, 2.0, 3.0, 4.0, 6.0, 9.0, 15.0), "inlet_certain": (1.0, 1.2, 1.5, 2.0, 3.0, 5.0, 9.0),
         "wider_outlet": (1.0, 1.05, 1.1, 1.2, 1.4, 2.0)}


def is_cut(end):
    f = end["odds"]["features"]
    return f["rim"] + f["border"] > 0


def is_left_closed(end):
    return not is_cut(end) and end["odds"]["features"]["cuts_beside"] > 0


def grazes(end):
    """A border of the image grazes a vessel that passes there: no end, whatever the odds."""
    return "in the side of a vessel" in end["why"]


def is_wider(end, other, limit):
    """By its vessel, or by its rim or cap."""
    these, those = end["odds"]["inlet"]["features"], other["odds"]["inlet"]["features"]
    return any(math.exp(these[name] - those[name]) > limit for name in ("width", "closure"))


def ratio(p):
    return p / (1.0 - p + 1e-12)


class Choice:
    """Of one case: open and doubtful candidates, and the inlet."""

    def __init__(self, case, models, limits):
        ends = case.ends
        self.limits = limits
        odds = models.end_odds(case)
        self.opening = [0.0 if is_left_closed(e) or grazes(e) else p[0] for e, p in zip(ends, odds)]
        self.plain = [p[0] for p in odds]
        candidates = [j for j, e in enumerate(ends) if e["odds"]["inlet"] and self.opening[j] >= 0.5]
        self.inlet, self.inlet_odds, self.inlet_doubtful = None, 0.0, False
        if candidates:
            p = models.inlet_odds(case, candidates)
            self.by_inlet = sorted(zip(p, candidates), reverse=True)
            self.inlet_odds, self.inlet = self.by_inlet[0]
            furcates = len(candidates) > 2
            inlet = ends[self.inlet]
            self.inlet_doubtful = any(furcates and p * limits.inlet_certain > self.inlet_odds or
                                      is_wider(ends[j], inlet, limits.wider_outlet) for p, j in self.by_inlet[1:])
        self.decide(ends)

    def decide(self, ends):
        widest = max((e["odds"]["vessel_mm"] for e in ends), default=0.0)
        reference = ends[self.inlet]["odds"]["vessel_mm"] if self.inlet is not None else widest
        self.share = [min(1.0, (e["odds"]["vessel_mm"] / reference) ** 3) if reference > 0 else 0.0 for e in ends]
        self.open, self.doubtful = [], []
        for j, end in enumerate(ends):
            odds, counts = ratio(self.plain[j]), self.share[j] > LEAST_SHARE
            if grazes(end):
                self.open.append(False)
                self.doubtful.append(False)
            elif is_left_closed(end):
                self.open.append(False)
                self.doubtful.append(counts and odds >= self.limits.certain)
            else:
                self.open.append(odds >= (1.0 if counts else LIKELY))
                self.doubtful.append(counts and 1.0 / self.limits.certain < odds < self.limits.certain)
        self.continue_vessels(ends, reference)
        for j in sorted(range(len(ends)), key=lambda j: -self.plain[j]):
            if sum(self.open) >= FEWEST_OPENINGS:
                break
            if not self.open[j]:
                self.open[j] = self.doubtful[j] = True

    def continue_vessels(self, ends, reference):
        behind = {}
        for j, end in enumerate(ends):
            for vessel in end["odds"].get("through", []) if j != self.inlet else []:
                behind.setdefault(vessel["vessel"], (vessel["diameter_mm"], []))[1].append(j)
        for diameter, those in sorted(behind.values(), key=lambda of_vessel: len(of_vessel[1])):
            share = min(1.0, (diameter / reference) ** 3) if reference > 0 else 0.0
            if share > LEAST_SHARE:
                self.continue_vessel(ends, those, share)

    def continue_vessel(self, ends, behind, share):
        """See end_choice.cpp."""
        if any(self.open[j] or self.doubtful[j] or is_left_closed(ends[j]) for j in behind):
            return
        none = math.prod(1.0 - self.plain[j] for j in behind)
        if (1.0 - none) * self.limits.certain > none:
            likeliest = max(behind, key=lambda j: self.plain[j])
            self.share[likeliest] = max(self.share[likeliest], share)
            self.doubtful[likeliest] = True


def faults(case, choice):
    """What is wrong with the likelier choice."""
    why = []
    opened = {case.of[j] for j in case.of if choice.open[j]}
    for i, end in enumerate(case.truth["ends"]):
        if end["role"] not in ("inlet", "open") or i in opened:
            continue
        twins = end.get("any_of") and any(other.get("any_of") == end["any_of"] and k in opened
                                          for k, other in enumerate(case.truth["ends"]))
        if not twins:
            found = [j for j in case.of if case.of[j] == i]
            why.append(f"{end['role']} end of {end['diameter_mm']:.1f} mm is " + (
                f"closed at {choice.plain[found[0]]:.2f}, {100 * choice.share[found[0]]:.0f} % of the flow"
                if found else "no candidate"))
    widest = max((end["diameter_mm"] for end in case.truth["ends"] if end["role"] == "inlet"), default=0.0)
    for j, end in enumerate(case.ends):
        if not choice.open[j]:
            continue
        role = case.role(j)
        small = case.truth.get("others") == "optional" and end["diameter_mm"] <= (
            case.truth.get("others_max_mm") or 0.45 * widest)
        if role == "closed" or (role is None and case.labels[j] is not None and not small):
            why.append(f"{'sac or stub' if role else 'bump'} of {end['diameter_mm']:.1f} mm is opened at {choice.plain[j]:.2f}")
    if choice.inlet is not None and case.role(choice.inlet) != "inlet":
        why.append(f"the inlet is at {case.role(choice.inlet) or 'no end'}")
    return why


def not_cut(case, choice):
    """Ends that are to be opened, but that the program could not open, so that it refuses the case."""
    def meant(j, end):
        return choice.open[j] and choice.share[j] > LEAST_SHARE and not is_left_closed(end) and not grazes(end)

    # Of ends that the program left closed for their odds, it is not known whether they can be cut.
    return [j for j, end in enumerate(case.ends)
            if meant(j, end) and not end["opening"] and end["odds"]["opening"] >= 0.5 and not end["odds"]["doubtful"] and
            "part of the end" not in end["why"]]


def widest_accepted(case):
    """Whether the widest of the true ends that are open is an inlet; None where there is no choice."""
    roles = [(end["diameter_mm"], end["role"] == "inlet") for end in case.truth["ends"] if end["role"] in ("inlet", "open")]
    return max(roles)[1] if len({inlet for _, inlet in roles}) == 2 else None


def result_of(case, models, limits=PRESENT):
    if not case.ends:
        return Result(case, "refused", False, [case.error[:120]], [], None)
    choice = Choice(case, models, limits)
    widest = widest_accepted(case)
    why = faults(case, choice)
    known = [(p, label) for p, label in zip(choice.plain, case.labels) if label is not None]
    inlet = (choice.inlet_odds, case.role(choice.inlet) == "inlet") if choice.inlet is not None else None
    if sum(choice.open) < FEWEST_OPENINGS or not_cut(case, choice):
        return Result(case, "refused", bool(why), why, known, inlet, choice.inlet_doubtful, widest)
    if any(choice.doubtful) or choice.inlet_doubtful:
        return Result(case, "doubt", bool(why), why, known, inlet, choice.inlet_doubtful, widest)
    return Result(case, "wrong" if why else "right", False, why, known, inlet, False, widest)


def results_of(judged, limits=PRESENT):
    """Each case judged by models that did not see its patient."""
    return [result_of(case, models, limits) for case, models in judged]


def curves(judged):
    """By limit: (value, results) of each value that is tried, the other limits as they are."""
    return {name: [(value, results_of(judged, dataclasses.replace(PRESENT, **{name: value}))) for value in values]
            for name, values in TRIED.items()}
