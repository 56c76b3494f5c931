"""What the commands return. The fields are the keys of their JSON documents; docs/user says what they mean."""
from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeVar

from .reading import Result

Point = tuple[float, float, float]
T = TypeVar("T")


def _named(named: Mapping[str, T], name: str, what: str) -> T:
    if name not in named:
        raise KeyError(f"there is no {what} '{name}', only {', '.join(named)}")
    return named[name]


# --- what is wrong, and what to do -----------------------------------------------------------------------------------
@dataclass(frozen=True)
class Remedy(Result):
    """An operation with arguments that may help; an argument without a value is yours to choose."""

    operation: str
    arguments: Mapping[str, str]
    before: bool = False  #: as an edit before the one that failed
    action: str = "give"  #: give these arguments; remove the edit; choose-again: without its earlier choices
    commands: tuple[tuple[str, ...], ...] = ()  #: of prepare: run one after the other, they do it


@dataclass(frozen=True)
class Diagnostic(Result):
    """A warning or an error in parts."""

    code: str  #: a name that stays the same, such as 'end-decided'
    severity: str  #: note, warning, error
    text: str
    operation: str  #: empty: of none
    place_mm: Point | None
    figures: Mapping[str, float]  #: their names end in their units
    words: Mapping[str, str]
    remedies: tuple[Remedy, ...]
    edit: int | None = None


# --- measure ---------------------------------------------------------------------------------------------------------
@dataclass(frozen=True)
class MinMeanMax(Result):
    min: float
    mean: float
    max: float


@dataclass(frozen=True)
class MinMean(Result):
    min: float
    mean: float


@dataclass(frozen=True)
class MeanMax(Result):
    mean: float
    max: float


@dataclass(frozen=True)
class MeanCurvature(Result):
    """Of H over the surface; H of a sphere of radius r is +1/r."""

    integral: float  #: [mm]
    integral_abs: float  #: [mm]


@dataclass(frozen=True)
class Patch(Result):
    """A part of the surface: the wall, an inlet, an outlet ..."""

    name: str
    kind: str
    triangles: int
    area: float  #: [mm^2]
    centroid: Point  #: [mm]
    normal: Point  #: outwards
    flatness: float  #: largest distance from its plane [mm]
    diameter: float  #: of a disc of its area [mm]


@dataclass(frozen=True)
class Histogram(Result):
    width: float  #: of a bin [mm]
    vertices: tuple[int, ...]  #: by distance; the first bin begins at 0


@dataclass(frozen=True)
class Deviation(Result):
    """Two-sided distances between a surface and its reference, from points to the surface."""

    hausdorff: float  #: [mm]
    mean_distance: float  #: [mm]
    hausdorff_to_reference: float  #: one-sided [mm]
    mean_to_reference: float  #: one-sided [mm]
    volume_change_percent: float
    histogram: Histogram | None = None


@dataclass(frozen=True)
class Sac(Result):
    """Of an aneurysm beyond its marked neck. docs/user/aneurysms.md defines each; None: the neck is in doubt."""

    in_doubt: bool
    dome: Point  #: a point in it [mm]
    neck: Point  #: middle of the neck [mm]
    normal: Point  #: of the neck's plane, into the sac
    dome_area: float | None = None  #: [mm^2]
    neck_area: float | None = None  #: [mm^2]
    volume: float | None = None  #: [mm^3]
    neck_diameter: float | None = None  #: [mm]
    neck_width: float | None = None  #: [mm]
    neck_hydraulic_diameter: float | None = None  #: [mm]
    height: float | None = None  #: [mm]
    length: float | None = None  #: [mm]
    width: float | None = None  #: [mm]
    diameter: float | None = None  #: [mm]
    aspect_ratio: float | None = None
    size_ratio: float | None = None
    bottleneck_factor: float | None = None
    bulge_location: float | None = None
    undulation: float | None = None
    ellipticity: float | None = None
    nonsphericity: float | None = None
    parent_diameter: float | None = None  #: [mm]


@dataclass(frozen=True)
class Measures(Result):
    """Of a surface. docs/science/measures.md explains each."""

    vertices: int
    triangles: int
    components: int
    boundary_loops: int
    closed: bool
    manifold: bool
    oriented: bool
    self_intersections: int
    genus: int | None  #: None: not defined
    area: float  #: [mm^2]
    volume: float  #: [mm^3]
    bounds: tuple[float, float, float, float, float, float]  #: least x, y, z, largest x, y, z [mm]
    edge_length: MinMeanMax  #: [mm]
    equiangle_skewness: MeanMax  #: 0 is best, 1 worst
    radius_ratio: MinMean  #: twice the inscribed over the circumscribed radius; 1 is best
    normal_curvature_deg: float
    mean_curvature: MeanCurvature
    patches: tuple[Patch, ...]
    reference: Deviation | None = None  #: if one was given
    sac: Sac | None = None  #: of a project where a neck is marked

    def patch(self, name: str) -> Patch:
        """The patch of this name. KeyError if there is none."""
        return _named({patch.name: patch for patch in self.patches}, name, "patch")


# --- centerlines, ends -----------------------------------------------------------------------------------------------
@dataclass(frozen=True)
class Node(Result):
    """Where branches meet or end."""

    position: Point  #: [mm]
    radius: float  #: of the inscribed sphere [mm]
    tip: bool
    branches: tuple[int, ...]  #: indices


@dataclass(frozen=True)
class Branch(Result):
    start_node: int
    end_node: int
    points: int
    length: float  #: [mm]
    radius: MinMeanMax  #: of the inscribed spheres [mm]


@dataclass(frozen=True)
class Centerlines(Result):
    nodes: tuple[Node, ...]
    branches: tuple[Branch, ...]


@dataclass(frozen=True)
class Odds(Result):
    """Of what an end is; their sum is 1."""

    opening: float
    sac: float
    bump: float
    doubtful: bool


@dataclass(frozen=True)
class End(Result):
    """A vessel end, and what `prepare` would make of it."""

    number: int | None  #: for inlet=, open= and close=
    place_mm: Point
    diameter_mm: float
    flow_share: float | None
    direction_sd_deg: float | None
    fate: str
    opening: str | None  #: name of its patch, if it is opened
    why: str
    odds: Odds | None


# --- projects --------------------------------------------------------------------------------------------------------
@dataclass(frozen=True)
class Change(Result):
    """What an edit did to the surface; None: there was nothing to compare."""

    volume_before_mm3: float | None
    volume_after_mm3: float | None
    largest_deviation_mm: float | None
    mean_deviation_mm: float | None
    triangles_before: int
    triangles_after: int
    moved_vertices: int


@dataclass(frozen=True)
class Edit(Result):
    """One operation with its arguments; what follows from running it is None or empty until it has run."""

    edit: int  #: its number
    revision: int
    step: str
    variant: str  #: cfd, rp or a name; empty: of all
    operation: str
    given: Mapping[str, Any]  #: arguments; `apply(edit.operation, **edit.given)` repeats it
    author: str
    time: str
    note: str
    status: str  #: done, pending, stale
    reason: str  #: why it is stale
    resolved: Mapping[str, Any] = field(default_factory=dict, repr=False)  #: all arguments, with what the operation chose
    duration_s: float | None = None
    warnings: tuple[str, ...] = ()
    diagnostics: tuple[Diagnostic, ...] = field(default=(), repr=False)  #: the warnings in parts
    change: Change | None = None
    report: Mapping[str, Any] | None = field(default=None, repr=False)  #: figures that only this operation knows
    pending: tuple[int, ...] = ()  #: edits that run again when their result is needed (apply, change)


@dataclass(frozen=True)
class Log(Result):
    project: str
    read_only: str  #: why the project is open for reading only; empty: it is not
    state: int
    edits: tuple[Edit, ...]  #: in their order
    measures: tuple[Mapping[str, Any], ...]  #: kept in the window

    def last(self, operation: str) -> Edit:
        """The last edit of this operation. KeyError if there is none."""
        return _named({edit.operation: edit for edit in self.edits}, operation, "edit")


@dataclass(frozen=True)
class Moved(Result):
    """A change of the project that was undone or redone."""

    edit: int
    revision: int
    operation: str
    change: str  #: apply, change, remove


@dataclass(frozen=True)
class State(Result):
    """Of a project, after remove, undo or redo."""

    state: int
    edits: int
    last: int | None  #: edit; None: there is none
    pending: tuple[int, ...]  #: edits that run again when their result is needed
    undone: tuple[Moved, ...] = ()
    redone: tuple[Moved, ...] = ()


@dataclass(frozen=True)
class Exported(Result):
    file: Path
    variant: str
    review: str
    triangles: int | None = None
    tetrahedra: int | None = None


@dataclass(frozen=True)
class ReplayedEdit(Result):
    edit: int
    revision: int
    operation: str
    variant: str
    replayed: bool
    differences: tuple[str, ...]
    note: str


@dataclass(frozen=True)
class Replay(Result):
    same: bool  #: all edits gave the stored results
    edits: tuple[ReplayedEdit, ...]


@dataclass(frozen=True)
class AuditEntry(Result):
    number: int
    time: str
    kind: str
    subject: str
    author: str
    version: str
    what: str
    hash: str


@dataclass(frozen=True)
class Audit(Result):
    """The chained record of a project, and whether the project agrees with it."""

    verified: bool
    findings: tuple[str, ...]  #: what does not verify
    diagnostics: tuple[Diagnostic, ...]  #: the same in parts
    verified_parts: tuple[str, ...]
    unverified: tuple[str, ...]
    head: str
    entries: tuple[AuditEntry, ...]


@dataclass(frozen=True)
class ReviewedEdit(Result):
    edit: int
    revision: int
    operation: str
    status: str
    verdicts: tuple[Mapping[str, Any], ...]


@dataclass(frozen=True)
class Review(Result):
    """How the edits were judged, and what to look at first."""

    status: str
    summary: str
    edits: tuple[ReviewedEdit, ...]
    queue: tuple[Mapping[str, Any], ...]
    imported: tuple[Mapping[str, Any], ...]


# --- findings --------------------------------------------------------------------------------------------------------
@dataclass(frozen=True)
class Treatment(Result):
    """The operation that would treat a finding."""

    name: str
    arguments: Mapping[str, str]


@dataclass(frozen=True)
class Reading(Result):
    """One of the things that a finding may be."""

    key: str
    name: str
    anatomy: bool  #: it is kept
    odds: float | None  #: 0 to 1; None: nothing weighs the readings
    text: str
    evidence: tuple[Diagnostic, ...]


@dataclass(frozen=True)
class Finding(Result):
    """What looks like an artefact."""

    id: str
    kind: str
    title: str
    certainty: float  #: 0 to 1
    place_mm: Point
    size_mm: float
    text: str
    evidence: Diagnostic
    operation: Treatment | None  #: None: no operation treats it
    certain_of: str = ""  #: what the certainty is of
    readings: tuple[Reading, ...] = ()  #: likeliest first, where anatomy may be what was found; else empty


@dataclass(frozen=True)
class Dismissal(Result):
    id: str | None  #: None: the model no longer has it
    kind: str
    place_mm: Point
    size_mm: float
    reason: str
    author: str
    time: str


@dataclass(frozen=True)
class NotSearched(Result):
    kind: str
    reason: str


@dataclass(frozen=True)
class Findings(Result):
    variant: str
    findings: tuple[Finding, ...]  #: the most certain one first
    dismissed: tuple[Dismissal, ...]
    not_searched: tuple[NotSearched, ...]


# --- batch -----------------------------------------------------------------------------------------------------------
@dataclass(frozen=True)
class CaseFailure(Result):
    code: str
    text: str
    remedies: tuple[str, ...]


@dataclass(frozen=True)
class BatchCase(Result):
    case: str
    input: str
    state: str  #: done, failed, not run ...
    review: str
    warnings: tuple[str, ...]
    warning_codes: tuple[str, ...]
    findings: int
    requirements_not_met: tuple[str, ...]
    figures: Mapping[str, float | None]  #: their names end in their units
    failure: CaseFailure | None = None


@dataclass(frozen=True)
class BatchFailure(Result):
    """Cases that failed for the same reason."""

    code: str
    cases: tuple[str, ...]
    text: str  #: of the first one
    remedies: tuple[str, ...]


@dataclass(frozen=True)
class Batch(Result):
    purpose: str
    cases: tuple[BatchCase, ...]
    failures: tuple[BatchFailure, ...]  #: empty: no case failed

    def case(self, name: str) -> BatchCase:
        """The case of this name. KeyError if there is none."""
        return _named({case.case: case for case in self.cases}, name, "case")


# --- others ----------------------------------------------------------------------------------------------------------
@dataclass(frozen=True)
class Parameter(Result):
    """Of an operation."""

    name: str
    type: str  #: real, integer, flag, choice, point, list, text, file, records
    unit: str  #: empty: none
    required: bool
    default: Any  #: None: the operation chooses
    help: str
    minimum: float | None = None
    minimum_allowed: bool = True
    maximum: float | None = None
    choices: tuple[str, ...] = ()
    only_with: str | None = None
    fields: tuple[Parameter, ...] = ()  #: of each record


@dataclass(frozen=True)
class Operation(Result):
    name: str
    step: str
    allowed_steps: tuple[str, ...]
    summary: str
    parameters: tuple[Parameter, ...]
    decisions: tuple[Parameter, ...]  #: parameters that it decides itself, and which no one types

    def parameter(self, name: str) -> Parameter:
        """The parameter of this name. KeyError if there is none."""
        return _named({parameter.name: parameter for parameter in self.parameters}, name, "parameter")


# --- run, results ----------------------------------------------------------------------------------------------------
@dataclass(frozen=True)
class FlowSolution(Result):
    """How a flow was solved."""

    kind: str  #: steady
    solver: str
    converged: bool
    ended_by: str  #: figures, residuals; iterations: it has not converged
    iterations: int
    largest_change_percent: float  #: of a figure over the last 50 iterations
    largest_residual: float


@dataclass(frozen=True)
class FlowOpening(Result):
    name: str
    kind: str
    area_mm2: float
    diameter_mm: float
    flow_cm3_s: float  #: in through an inlet, out of an outlet
    pressure_pa: float  #: mean
    reynolds: float | None = None  #: of an inlet


@dataclass(frozen=True)
class FlowResults(Result):
    """Of a steady flow."""

    solution: FlowSolution
    figures: Mapping[str, float]  #: their names end in their units
    definitions: Mapping[str, str]  #: of the figures
    openings: tuple[FlowOpening, ...]
    methods: str = field(repr=False)  #: a paragraph for a paper
    references: tuple[str, ...] = field(repr=False)

    @property
    def converged(self) -> bool:
        """Whether the figures can be used."""
        return self.solution.converged

    def opening(self, name: str) -> FlowOpening:
        """The opening of this name. KeyError if there is none."""
        return _named({opening.name: opening for opening in self.openings}, name, "opening")


@dataclass(frozen=True)
class Phantom(Result):
    """Files of a vessel whose true surface is known."""

    name: str
    seed: int
    folder: Path
    files: tuple[str, ...]


@dataclass(frozen=True)
class Check(Result):
    """What the program found on this machine."""

    check: str
    ok: bool
    value: str
    lacking: str  #: what is missing, and how to get it
