"""The figures of the fit, of patients that it did not see, as Markdown."""
import common
import page_rows
from ends.choice import PRESENT

KINDS = ("right", "wrong", "doubt", "refused")
BINS = ((0.0, 0.02), (0.02, 0.05), (0.05, 0.2), (0.2, 0.5), (0.5, 0.8), (0.8, 0.9), (0.9, 0.95), (0.95, 0.98), (0.98, 1.01))


def percent(part, whole):
    return f"{100.0 * part / whole:.0f} %" if whole else "-"


def row_of(name, results):
    counts = [sum(r.verdict == kind for r in results) for kind in KINDS]
    asked = [r for r in results if r.verdict in ("doubt", "refused")]
    return [name, len(results), *(percent(count, len(results)) for count in counts),
            percent(sum(r.rightly for r in asked), len(asked))]


def mean_row(name, groups):
    """Over groups of equal weight."""
    shares = [[sum(r.verdict == kind for r in group) / len(group) for kind in KINDS] for group in groups]
    return [name, sum(map(len, groups)), *(percent(sum(s[k] for s in shares), len(shares)) for k in range(len(KINDS))), ""]


def by(results, key):
    groups = {}
    for result in results:
        groups.setdefault(key(result.case), []).append(result)
    return dict(sorted(groups.items()))


HEAD = ["", "cases", *KINDS, "of doubts and refusals: the likelier choice is wrong"]


def anatomy_table(results):
    groups = by(results, lambda case: case.anatomy)
    rows = [row_of(name, group) for name, group in groups.items()]
    rows += [row_of("all", results), mean_row("mean of anatomies", list(groups.values()))]
    return common.table(["anatomy", *HEAD[1:]], rows)


def reliability_table(results):
    rows = []
    pairs = [(p, label == 0) for r in results for p, label in r.ends]
    inlets = [r.inlet for r in results if r.inlet]
    for low, high in BINS:
        ends = [good for p, good in pairs if low <= p < high]
        roots = [good for p, good in inlets if low <= p < high]
        said = f"{100 * low:.0f} to {min(100, 100 * high):.0f} %"
        rows.append([said, len(ends), percent(sum(ends), len(ends)), len(roots), percent(sum(roots), len(roots))])
    return common.table(["said", "candidates", "openings", "inlets chosen", "accepted"], rows)


INTRODUCTION = """# Vessel ends on patients that the fit did not see

How often the program's choice of ends and inlet is right ([Vessel ends](../user/ends.md) describes it). `scripts/orchard.py make`
makes the cases from labelled vessels: as they are, closed by flat, domed, ragged and oblique ends, with torn rims, as masks
and images of several resolutions, cut by the image's border, with stubs of cut branches, in other units, decimated, noisy,
turned, and with an inlet that is not the widest end. `scripts/fit_ends.py --page docs/science/ends.md` writes this page. The
patients are dealt to five folds; each case is judged by weights that were fitted without its patient. Made at {revision};
{cases} cases of {patients} patients: of the orchard, {coverage}.

**right**: the ends that have to be open are open, no other is, and the inlet is one. **wrong**: not so, and nobody is asked.
**doubt**: the preparation stops with a question. **refused**: it fails. The choice is judged, not the cuts: an end that is chosen
and cannot be cut counts as refused. The means over anatomies give each anatomy the same weight, however many cases it has.
"""


def inlets_table(results):
    """Of cases in which some end is no inlet: what the fit takes, and what the widest end alone would be."""
    rows = []
    for name, kinds in (("as they are", ("as-is",)), ("not the widest", ("not-widest",)), ("other made cases", None)):
        chosen = [r for r in results if r.inlet and r.widest_accepted is not None and (
            r.case.made in kinds if kinds else r.case.made not in ("as-is", "not-widest"))]
        counts = [sum(map(test, chosen)) for test in (
            lambda r: r.inlet[1], lambda r: r.widest_accepted, lambda r: r.asked_inlet,
            lambda r: not r.inlet[1] and r.verdict == "wrong")]
        rows.append([name, len(chosen), *(percent(count, len(chosen)) for count in counts)])
    return common.table(["cases", "number", "likeliest end is an inlet", "widest end is an inlet", "asked about the inlet",
                         "wrong inlet, nobody asked"], rows)


def groups_of(results):
    """As they are; made; made with an inlet that is not the widest end."""
    def part(test):
        return [r for r in results if test(r.case.made)]
    return [part(lambda made: made == "as-is"), part(lambda made: made not in ("as-is", "not-widest")),
            part(lambda made: made == "not-widest")]


LIMITS = {"certain": "Odds of an end beyond which it is no doubt", "inlet_certain":
          "Odds of the inlet over the next end's beyond which it is no doubt", "wider_outlet":
          "Width of an outlet beside the inlet's from which it is a doubt"}


def curve_table(curve, present):
    """Wrong and doubt against one limit."""
    rows = []
    for value, results in curve:
        cells = [f"**{value:g}**" if value == present else f"{value:g}"]
        for group in groups_of(results):
            cells += [percent(sum(r.verdict == kind for r in group), len(group)) for kind in ("right", "wrong", "doubt")]
        rows.append(cells)
    names = ("as they are", "made", "not the widest")
    return common.table(["limit", *(f"{name}: {kind}" for name in names for kind in ("right", "wrong", "doubt"))], rows)


def curves_text(curves):
    return "\n".join(f"{LIMITS[name]}:\n\n{curve_table(curve, getattr(PRESENT, name))}" for name, curve in curves.items())


def coverage(results, orchard):
    """How many of the orchard's cases were measured. orchard: the kinds of all its cases."""
    parts = []
    for name, test in (("as they are", lambda made: made == "as-is"), ("made", lambda made: made != "as-is")):
        parts.append(f"{sum(test(r.case.made) for r in results)} of {sum(map(test, orchard))} {name}")
    return " and ".join(parts) + ("" if len(results) == len(orchard) else ", those that are quickly measured first")


def page_text(results, ridges, curves, orchard):
    real = [r for r in results if r.case.made == "as-is"]
    made = [r for r in results if r.case.made != "as-is"]
    kinds = [row_of(name, group) for name, group in by(made, lambda case: case.made).items()]
    return "\n".join([
        INTRODUCTION.format(revision=page_rows.revision(), cases=len(results), patients=len({r.case.patient for r in results}),
                            coverage=coverage(results, orchard)),
        f"## Surfaces and masks as they are\n\n{anatomy_table(real)}", f"## Made cases by anatomy\n\n{anatomy_table(made)}",
        "## Made cases by kind\n\n" + common.table(["made", *HEAD[1:]], kinds),
        f"## The inlet\n\n{inlets_table(results)}",
        f"## Odds\n\nWhat is said of a candidate, and what is so.\n\n{reliability_table(results)}",
        "## Where doubt ends\n\nWrong with exit 0 against doubt, by each limit alone; the one that is used is bold.\n\n" +
        curves_text(curves),
        f"Ridges: {ridges['ends']:g} for the ends, {ridges['inlets']:g} for the inlet."]) + "\n"


def origin_lines(results, ridges):
    wrong = sum(r.verdict == "wrong" for r in results)
    right = sum(r.verdict == "right" for r in results)
    patients = len({r.case.patient for r in results})
    return ["Made by scripts/fit_ends.py, not to be edited by hand; docs/science/ends.md describes the models.",
            f"Fitted to {len(results)} cases of {patients} patients, ridges {ridges['ends']:g} and {ridges['inlets']:g}.",
            f"On patients left out: {right} right, {wrong} wrong with exit 0, the others doubts and refusals."]
