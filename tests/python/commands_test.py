"""Typed results of the real program, on small phantoms."""
import itertools
import json
import math
import os
from pathlib import Path

import vesselbench
from support import CUBE_EDGE, PROGRAM, InFolder


class Surfaces(InFolder):
    def test_a_cube_is_measured(self):
        cube = vesselbench.measure(self.cube())
        self.assertEqual((cube.vertices, cube.triangles, cube.closed, cube.genus, cube.components), (8, 12, True, 0, 1))
        self.assertAlmostEqual(cube.volume, CUBE_EDGE ** 3)
        self.assertAlmostEqual(cube.area, 6 * CUBE_EDGE ** 2)
        self.assertEqual(cube.bounds, (0, 0, 0, CUBE_EDGE, CUBE_EDGE, CUBE_EDGE))
        self.assertAlmostEqual(cube.edge_length.max, CUBE_EDGE * math.sqrt(2))
        self.assertAlmostEqual(cube.edge_length.mean, CUBE_EDGE * (12 + 6 * math.sqrt(2)) / 18)
        self.assertIsNone(cube.reference)

    def test_units_are_an_option(self):
        self.assertAlmostEqual(vesselbench.measure(self.cube(), units="cm").volume, (10 * CUBE_EDGE) ** 3)

    def test_a_surface_is_compared_with_its_like(self):
        same = vesselbench.measure(self.cube(), self.cube("größer -.off"), histogram=0.5).reference
        self.assertAlmostEqual(same.hausdorff, 0)
        self.assertEqual((same.volume_change_percent, same.histogram.vertices), (0, (8,)))

    def test_a_file_whose_name_looks_like_an_option(self):
        self.assertEqual(vesselbench.measure(self.cube("-x.off")).vertices, 8)

    def test_the_patches_of_a_phantom(self):
        tube = vesselbench.phantom("tube", "tube ä")
        self.assertIn("exact.vtp", tube.files)
        measures = vesselbench.measure(tube.folder / "exact.vtp")
        self.assertGreater(measures.patch("wall").area, 0.5 * measures.area)
        with self.assertRaisesRegex(KeyError, "there is no patch 'none', only wall"):
            measures.patch("none")
        picture = vesselbench.picture(tube.folder / "exact.vtp", "p.png", view=(-1, 0, 0), size=64)
        self.assertEqual(picture.read_bytes()[1:4], b"PNG")
        lines = vesselbench.centerlines(tube.folder / "exact.vtp", "lines.vtp")
        self.assertEqual([(branch.start_node, branch.end_node) for branch in lines.branches], [(0, 1)])
        self.assertTrue(all(node.tip for node in lines.nodes))


class Tables(InFolder):
    def test_operations_are_those_of_the_program(self):
        operations = vesselbench.operations()
        self.assertEqual(operations[0].name, "load-surface")
        edge = vesselbench.operation("remesh").parameter("edge")
        self.assertEqual((edge.type, edge.unit, edge.minimum, edge.minimum_allowed), ("real", "mm", 0.0, False))
        self.assertIn(vesselbench.operation("remesh"), operations)

    def test_no_parameter_has_the_name_of_a_keyword_of_apply_or_change(self):
        names = {parameter.name for operation in vesselbench.operations() for parameter in operation.parameters}
        self.assertFalse(names & {"variant", "step", "author", "note", "anew"})

    def test_doctor_and_version(self):
        checks = {check.check: check for check in vesselbench.doctor()}
        self.assertEqual(checks["vesselbench"].value, vesselbench.version())

    def test_any_command_can_be_run(self):
        self.assertEqual(vesselbench.run("operations", "smooth")["name"], "smooth")
        self.assertEqual(vesselbench.run("measure", self.cube(), units="m", program=PROGRAM)["file_units"], "m")


class Projects(InFolder):
    def setUp(self):
        super().setUp()
        self.project = vesselbench.Project.new("mein projekt.vbench", self.cube("würfel 1.off"), units="mm")

    def test_edits_are_applied_changed_undone_and_removed(self):
        project = self.project
        fine = project.apply("subdivide", iterations=2, note="-finer")
        self.assertEqual((fine.edit, fine.given, fine.status, fine.note), (2, {"iterations": 2}, "done", "-finer"))
        self.assertEqual((fine.change.triangles_before, fine.change.triangles_after), (12, 192))
        smooth = project.apply("smooth", filter="laplace", lambda_=0.25, iterations=2)
        self.assertEqual(smooth.resolved["lambda"], 0.25)
        self.assertLess(smooth.change.volume_after_mm3, smooth.change.volume_before_mm3)
        self.assertEqual(project.change(fine, iterations=1).change.triangles_after, 48)
        self.assertEqual(project.undo().undone[0].change, "change")
        self.assertEqual(project.redo().redone[0].edit, fine.edit)
        self.assertEqual(project.remove(smooth).last, fine.edit)
        self.assertEqual([edit.operation for edit in project.log().edits], ["load-surface", "subdivide"])
        project.note(fine, "finer")
        self.assertEqual(project.log().last("subdivide").note, "finer")
        self.assertTrue(project.replay().same)
        self.assertTrue(project.audit().verified)
        self.assertEqual(project.review().status, "not reviewed")

    def test_an_edit_of_the_log_can_be_repeated(self):
        edit = self.project.apply("smooth", filter="laplace", lambda_=0.1, iterations=1, caps="smooth")
        other = vesselbench.Project.new("other.vbench", "würfel 1.off", units="mm")
        self.assertEqual(other.apply(edit.operation, **edit.given).given, edit.given)

    def test_the_model_is_exported_and_measured(self):
        exported = self.project.export("ä b.ply")
        self.assertEqual((exported.triangles, exported.tetrahedra), (12, None))
        self.assertAlmostEqual(vesselbench.measure(exported.file).volume, CUBE_EDGE ** 3)
        self.assertAlmostEqual(self.project.measure("würfel 1.off").reference.hausdorff, 0)

    def test_wrong_names_and_values_are_refused_with_what_is_right(self):
        for apply, text in ((lambda: self.project.apply("smooh"), "did you mean 'smooth'"),
                            (lambda: self.project.apply("smooth", itrations=3), "did you mean 'iterations'"),
                            (lambda: self.project.apply("smooth", iterations=-1), "must be an integer"),
                            (lambda: self.project.export("a.stl", none=True), "--none")):
            with self.assertRaisesRegex(vesselbench.UsageError, text) as caught:
                apply()
            self.assertEqual(caught.exception.exit_code, 2)

    def test_bad_files_are_refused(self):
        Path("bad.stl").write_text("garbage")
        for call in (lambda: vesselbench.measure("bad.stl"), lambda: vesselbench.measure("none.stl"),
                     lambda: vesselbench.Project("bad.stl").log(), lambda: vesselbench.Project.new("b.vbench", "bad.stl")):
            with self.assertRaises(vesselbench.BadInput) as caught:
                call()
            self.assertEqual(caught.exception.exit_code, 3)

    def test_a_project_stays_where_it_is_when_the_folder_changes(self):
        os.chdir("/")
        self.assertEqual(len(self.project.log().edits), 1)


class Models(InFolder):
    def test_a_print_model_with_what_follows_from_it(self):
        vesselbench.phantom("tube", "tube ä")
        made = vesselbench.prepare("tube ä", "rp", Path("drück"), settings={"remesh.edge": 0.8}, author="me")
        self.assertEqual(made.folder, Path("drück").absolute())
        for product in made.products:
            self.assertTrue((made.folder / product).exists(), product)
        self.assertTrue(vesselbench.measure(made.surface).closed)
        self.assertEqual(made.report["purpose"], made.purpose)
        self.assertEqual([warning.code for warning in made.diagnostics], ["hardly-any-staircases"])
        log = made.project.log()
        self.assertEqual((log.last("remesh").resolved["edge"], log.last("remesh").author), (0.8, "me"))
        with self.assertRaises(KeyError):
            log.last("stamp")

    def test_findings_are_dismissed_and_treated(self):
        tumour = vesselbench.phantom("tumour", "tumour")
        project = vesselbench.Project.new("t.vbench", tumour.folder / "exact.vtp", units="mm")
        found = project.findings().findings
        certainties = [finding.certainty for finding in found]
        self.assertEqual(certainties, sorted(certainties, reverse=True))
        self.assertEqual((found[0].kind, found[0].evidence.code), ("bump", "found-bump"))
        left = project.dismiss(found[0], "as in the patient")
        self.assertEqual((len(left.findings), left.dismissed[0].reason), (len(found) - 1, "as in the patient"))
        self.assertEqual(project.treat(left.findings[0]).operation, left.findings[0].operation.name)

    def test_a_model_that_is_not_fit_is_refused_with_its_report(self):
        with self.assertRaisesRegex(vesselbench.ModelRefused, "too coarse for the vessel") as caught:
            vesselbench.prepare(self.cube(), "cfd", "out", units="mm")
        error = caught.exception
        self.assertEqual((error.exit_code, error.report, error.project),
                         (1, self.folder / "out/report.json", self.folder / "out/project.vbench"))
        self.assertEqual(error.code, error.diagnostics[0].code)
        self.assertIn({"iterations": "0"}, [dict(remedy.arguments) for remedy in error.remedies])
        self.assertEqual([edit.operation for edit in vesselbench.Project(error.project).log().edits], ["load-surface", "repair"])

    def test_an_input_that_is_not_there_is_no_refused_model(self):
        for call in itertools.repeat(lambda: vesselbench.prepare("none.stl", "cfd", "out"), 2):
            with self.assertRaises(vesselbench.BadInput):
                call()

    def test_ends_of_a_surface(self):
        vesselbench.phantom("tube", "tube")
        ends = vesselbench.ends("tube", settings={"remove-branch.tip": None})
        self.assertEqual([end.number for end in ends], [1, 2])
        self.assertEqual({end.fate for end in ends}, {"opened"})

    def test_a_folder_without_a_case_has_no_flow(self):
        for call in (vesselbench.run_flow, vesselbench.flow_results):
            with self.assertRaisesRegex(vesselbench.BadInput, "holds no OpenFOAM case"):
                call(".")

    def test_a_flow_that_has_not_converged_is_an_answer(self):
        solution = {"kind": "steady", "solver": "OpenFOAM", "converged": False, "ended_by": "iterations", "iterations": 5,
                    "largest_change_percent": 9.0, "largest_residual": 0.1}
        opening = {"name": "inlet", "kind": "inlet", "area_mm2": 3.0, "diameter_mm": 2.0, "flow_cm3_s": 1.2, "pressure_pa": 100}
        document = {"solution": solution, "figures": {"wall_shear_mean_pa": 2.5}, "definitions": {}, "openings": [opening],
                    "methods": "The flow", "references": []}
        stand_in = self.stand_in(f"echo '{json.dumps(document)}'; exit 1")
        flow = vesselbench.flow_results("case", program=stand_in)
        self.assertFalse(flow.converged)
        self.assertEqual((flow.figures["wall_shear_mean_pa"], flow.opening("inlet").flow_cm3_s), (2.5, 1.2))

    def test_a_batch_goes_on_after_a_case_that_fails(self):
        Path("cases").mkdir()
        self.cube("cases/a.off")
        Path("cases/b.stl").write_text("garbage")
        batch = vesselbench.batch("cases", "planning", "out", settings={"smooth.iterations": 0}, units="mm", jobs=2)
        self.assertEqual(batch.case("b").state, "failed")
        self.assertEqual(batch.case("b").failure.code, "file-not-read")
        self.assertIn("b", batch.failures[0].cases)
        self.assertIsNone(batch.case("a").failure)
        self.assertEqual(batch.case("a").figures["triangles"], 12)
