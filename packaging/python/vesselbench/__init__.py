"""Runs the program vesselbench from Python, and returns typed results.

Every function is a command of the program, every keyword one of its options or an operation's parameter, and every field of
a result a field of the JSON document that the command prints with --json; `result.document` is the whole document. Lengths
are in mm, areas in mm^2, volumes in mm^3, angles in degrees, places in patient coordinates (LPS).

    import vesselbench

    prepared = vesselbench.prepare("aneurysm", "cfd", "case", settings={"remesh.edge": 0.4})
    print(vesselbench.measure(prepared.surface).volume)

The program is the argument `program`, else the environment variable VESSELBENCH, else the `vesselbench` of the PATH.
"""
from .commands import (batch, centerlines, doctor, ends, flow_results, measure, operation, operations, phantom, picture,
                       prepare, run, run_flow, version)
from .errors import (BadInput, Cancelled, ModelRefused, ProgramNotFound, UnexpectedAnswer, UsageError, VesselbenchError)
from .project import Prepared, Project
from .results import (Audit, AuditEntry, Batch, BatchCase, BatchFailure, Branch, CaseFailure, Centerlines, Change, Check,
                      Deviation, Diagnostic, Dismissal, Edit, End, Exported, Finding, Findings, FlowOpening, FlowResults,
                      FlowSolution, Histogram, Log, MeanCurvature, MeanMax, Measures, MinMean, MinMeanMax, Moved, Node,
                      NotSearched, Odds, Operation, Parameter, Patch, Phantom, Reading, Remedy, Replay, ReplayedEdit,
                      Review, ReviewedEdit, Sac, State, Treatment)

__all__ = [
    "batch", "centerlines", "doctor", "ends", "flow_results", "measure", "operation", "operations", "phantom", "picture",
    "prepare", "run", "run_flow", "version",
    "BadInput", "Cancelled", "ModelRefused", "ProgramNotFound", "UnexpectedAnswer", "UsageError", "VesselbenchError",
    "Prepared", "Project",
    "Audit", "AuditEntry", "Batch", "BatchCase", "BatchFailure", "Branch", "CaseFailure", "Centerlines", "Change", "Check",
    "Deviation", "Diagnostic", "Dismissal", "Edit", "End", "Exported", "Finding", "Findings", "FlowOpening", "FlowResults",
    "FlowSolution", "Histogram", "Log", "MeanCurvature", "MeanMax", "Measures", "MinMean", "MinMeanMax", "Moved", "Node",
    "NotSearched", "Odds", "Operation", "Parameter", "Patch", "Phantom", "Reading", "Remedy", "Replay", "ReplayedEdit",
    "Review", "ReviewedEdit", "Sac", "State", "Treatment",
]
