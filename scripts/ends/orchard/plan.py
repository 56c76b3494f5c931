"""Which cases are made of which source."""
import collections
import zlib

from ends.orchard.model import flows
from ends.orchard.sources import is_surface

# Cases of each kind beside "as-is". Some fail, so that fewer are made.
QUOTAS = {"closed-flat": 72, "closed-domed": 64, "closed-ragged": 54, "closed-oblique": 66, "mixed-closed": 34, "torn": 64,
          "oblique-open": 46, "box-mask": 100, "mask": 90, "box-image": 50, "image": 22, "scaled": 20, "decimated": 44,
          "noisy": 34, "turned": 34, "stub": 90, "not-widest": 270}
ARCH_SHARE = 0.22  # of a kind's quota: 28 sources are aortic arches of one workstation, which must not outnumber the rest
MORE_ARCHES = 20   # of "not-widest" beside that
REPEATS = {"not-widest": 4, "mask": 2, "box-mask": 2}  # cases of a kind from one rare source, where not 1


def applies(truth, kind):
    """Whether a kind can be made of a source at all, as far as its truth says."""
    flowing = [e for e in truth["ends"] if flows(e)]
    inlets = [e for e in flowing if e["role"] == "inlet"]
    if truth.get("acceptable_refusal") or not inlets or truth["kind"] == "intensity":
        return False
    if not is_surface(truth):
        return kind in ("mask", "box-mask")
    if kind == "stub":
        return len(flowing) >= 3 and len(inlets) < len(flowing) and truth["anatomy"] != "heart"
    if kind == "not-widest":
        return len(inlets) == 1 and len(flowing) > 1
    return True


def groups_of(truths, kind, used):
    """Names of the sources that a kind can be made of: rare ones, arches, and cerebral ones of the large collection. The latter
    two begin with those that are used least."""
    def order(name):
        return used[name], zlib.crc32((name + kind).encode())

    fit = [n for n in truths if applies(truths[n], kind)]
    arch = sorted((n for n in fit if truths[n]["anatomy"] == "arch"), key=order)
    head = sorted((n for n in fit if truths[n]["anatomy"] == "cerebral" and n.startswith("intra")), key=order)
    rare = [n for n in fit if n not in arch and n not in head]
    return rare, arch, head


def chosen(truths, kind, quota, used):
    """(source, number) of a kind's cases: rare sources first, then arches up to their share, then cerebral ones up to the quota.
    `used` counts the kinds of each source, and is counted on."""
    rare, arch, head = groups_of(truths, kind, used)
    if kind == "scaled":  # the same surface in other units: a few of each will do
        rare, arch = rare[::3], arch[:4]
    picked = [(n, number) for n in rare for number in range(REPEATS.get(kind, 1))]
    arches = round(ARCH_SHARE * quota)
    if kind == "not-widest":
        arch = [(n, number) for n in arch for number in range(4)]
        arch = [case for i, case in enumerate(arch) if i % 3 != 1]
        head = [(n, number) for number in (0, 2, 1, 3) for n in head]
        arches += MORE_ARCHES
    else:
        arch, head = [(n, 0) for n in arch], [(n, 0) for n in head]
    picked += arch[:max(0, min(arches, quota - len(picked)))]
    picked += head[:max(0, quota - len(picked))]
    used.update({n for n, _ in picked})
    return picked


def plan(truths):
    """Cases of each source, from the truths by name: name of the source to (kind, number)."""
    cases, used = collections.defaultdict(list), collections.Counter()
    for kind, quota in QUOTAS.items():
        for name, number in chosen(truths, kind, quota, used):
            cases[name].append((kind, number))
    for name in truths:
        cases[name].insert(0, ("as-is", 0))
    return cases
