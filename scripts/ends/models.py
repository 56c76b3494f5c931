"""The models that judge ends and inlets: multinomial and conditional logistic regression with a ridge."""
import math

try:
    import numpy as np
except ImportError:
    raise SystemExit("fit_ends: needs python3-numpy") from None

CLASSES = ("opening", "sac", "bump")
RIDGES = (1e-2, 3e-3, 1e-3, 3e-4, 1e-4)
LEAST_SHARE, SMALL_WEIGHT = 0.05, 0.3  # kLeastShare of end_choice.h; and the weight of an end with less
KNOWN = 64.0  # the bundled aneurysm, whose widest end is its sac: nobody shall be asked about the first example
STEPS = 60


def names_of(ends, part):
    features = ends[0]["odds"]["features"] if part == "ends" else next(
        e["odds"]["inlet"]["features"] for e in ends if e["odds"]["inlet"])
    return list(features)


def case_weights(cases):
    """Each anatomy by the root of its number of cases, and within it each patient likewise."""
    anatomies, patients = {}, {}
    for case in cases:
        anatomies[case.anatomy] = anatomies.get(case.anatomy, 0) + 1
        patients[case.patient] = patients.get(case.patient, 0) + 1
    return {case.name: (KNOWN if case.made == "known" else 1.0) / math.sqrt(anatomies[case.anatomy] * patients[case.patient])
            for case in cases}


def softmax(score):
    p = np.exp(score - score.max(axis=-1, keepdims=True))
    return p / p.sum(axis=-1, keepdims=True)


def end_rows(cases):
    """Features, labels and weights of the candidates whose truth is known."""
    x, y, w = [], [], []
    weights = case_weights(cases)
    for case in cases:
        known = [(end, label) for end, label in zip(case.ends, case.labels) if label is not None]
        sizes = [1.0 if end["flow_share"] > LEAST_SHARE else SMALL_WEIGHT for end, _ in known]
        for (end, label), size in zip(known, sizes):
            x.append(list(end["odds"]["features"].values()))
            y.append(label)
            w.append(weights[case.name] * size / math.sqrt(sum(sizes)))
    w = np.array(w)
    return np.array(x), np.array(y), w / w.sum()


def fitted_ends(rows, ridge):
    """Newton's method on the weighted log-likelihood with a ridge, none on the constant."""
    x, y, w = rows
    n, k = x.shape
    c = len(CLASSES)
    weights = np.zeros((k, c))
    penalty = np.full((k, c), ridge)
    penalty[0] = 1e-4
    truth = np.zeros((n, c))
    truth[np.arange(n), y] = 1.0
    for _ in range(STEPS):
        p = softmax(x @ weights)
        slope = x.T @ ((p - truth) * w[:, None]) + penalty * weights
        curvature = np.diag(penalty.T.reshape(-1) + 1e-9)
        for a in range(c):
            for b in range(c):
                of_pair = w * p[:, a] * ((a == b) - p[:, b])
                curvature[a * k:(a + 1) * k, b * k:(b + 1) * k] += (x * of_pair[:, None]).T @ x
        step = np.linalg.solve(curvature, slope.T.reshape(-1)).reshape(c, k).T
        weights -= step
        if abs(step).max() < 1e-6:
            break
    return weights


def inlet_rows(cases):
    """(features of the candidates, which of them are accepted, weight) of each case that has a choice."""
    rows = []
    weights = case_weights(cases)
    for case in cases:
        if case.made == "known":  # of these, only the sac is meant
            continue
        candidates = [j for j, end in enumerate(case.ends) if end["odds"]["inlet"] and case.role(j) in ("inlet", "open")]
        good = np.array([case.role(j) == "inlet" for j in candidates])
        if good.size < 2 or good.all() or not good.any():
            continue
        x = np.array([list(case.ends[j]["odds"]["inlet"]["features"].values()) for j in candidates])
        rows.append((x, good, weights[case.name]))
    return rows


def fitted_inlets(rows, ridge, known=0.0):
    """Gradient descent with Newton steps on the log-likelihood of any accepted candidate. known: where the ridge draws to."""
    k = rows[0][0].shape[1]
    weights, total = np.zeros(k), sum(w for _, _, w in rows)
    for _ in range(STEPS):
        slope, curvature = ridge * (weights - known), ridge * np.eye(k)
        for x, good, w in rows:
            p = softmax(x @ weights)
            q = np.where(good, p, 0.0)
            q /= q.sum()
            slope -= w / total * (x.T @ (q - p))
            centred = x - p @ x
            curvature += w / total * (centred * p[:, None]).T @ centred
        step = np.linalg.solve(curvature, slope)
        weights -= step
        if abs(step).max() < 1e-6:
            break
    return weights


def inlet_loss(rows, weights):
    return sum(-w * math.log(max(1e-9, softmax(x @ weights)[good].sum())) for x, good, w in rows)


class Models:
    """Fitted to cases."""

    def __init__(self, cases, ridges, known=0.0):
        some = next(case for case in cases if any(e["odds"]["inlet"] for e in case.ends))
        self.names = {part: names_of(some.ends, part) for part in ("ends", "inlets")}
        self.ends = fitted_ends(end_rows(cases), ridges["ends"])
        self.inlets = fitted_inlets(inlet_rows(cases), ridges["inlets"], known)

    def end_odds(self, case):
        """Likelihoods of the classes, #candidates x 3."""
        x = np.array([list(end["odds"]["features"].values()) for end in case.ends])
        return softmax(x @ self.ends)

    def inlet_odds(self, case, candidates):
        x = np.array([list(case.ends[j]["odds"]["inlet"]["features"].values()) for j in candidates])
        return softmax(x @ self.inlets)

    def tables(self):
        """The texts of the tables by file."""
        def text(names, weights, columns):
            rows = ["feature," + ",".join(columns)]
            rows += [name + "," + ",".join(f"{value:.4f}" for value in np.atleast_1d(row)) for name, row in zip(names, weights)]
            return "\n".join(rows) + "\n"
        return {"end_weights.csv": text(self.names["ends"], self.ends, CLASSES),
                "inlet_weights.csv": text(self.names["inlets"], self.inlets, ("inlet",))}


def present_inlets(file):
    """The weights of a table that `tables` wrote."""
    with open(file) as table:
        rows = [line.split(",") for line in table if line[0] != "#"][1:]
    return np.array([float(row[1]) for row in rows])


def best_ridges(cases, folds, taught):
    """Those with the least log loss on patients left out. taught: cases that every fit sees."""
    losses = {part: dict.fromkeys(RIDGES, 0.0) for part in ("ends", "inlets")}
    for fold in sorted(set(folds.values())):
        seen = taught + [case for case in cases if folds[case.patient] != fold]
        left = [case for case in cases if folds[case.patient] == fold]
        ends, inlets, (x, y, w) = end_rows(seen), inlet_rows(seen), end_rows(left)
        for ridge in RIDGES:
            p = softmax(x @ fitted_ends(ends, ridge))[np.arange(len(y)), y]
            losses["ends"][ridge] -= (w * np.log(np.maximum(p, 1e-9))).sum()
            losses["inlets"][ridge] += inlet_loss(inlet_rows(left), fitted_inlets(inlets, ridge))
    return {part: min(by, key=by.get) for part, by in losses.items()}
