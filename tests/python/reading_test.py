"""JSON documents of newer and older programs."""
import pickle
import unittest
from dataclasses import FrozenInstanceError

from vesselbench import Diagnostic, End, MinMeanMax, Parameter, UnexpectedAnswer, VesselbenchError
from vesselbench.reading import read, read_all

END = {"number": None, "place_mm": [1, 2.5, 3], "diameter_mm": 4, "flow_share": None, "direction_sd_deg": None,
       "fate": "closed", "opening": None, "why": "", "odds": {"opening": 0, "sac": 1, "bump": 0, "doubtful": False}}


class Reading(unittest.TestCase):
    def test_fields_have_their_types(self):
        end = read(End, END, "end")
        self.assertEqual(end.place_mm, (1.0, 2.5, 3.0))
        self.assertIsInstance(end.diameter_mm, float)
        self.assertEqual((end.number, end.odds.sac), (None, 1.0))

    def test_results_do_not_change(self):
        with self.assertRaises(FrozenInstanceError):
            read(MinMeanMax, {"min": 1, "mean": 2, "max": 3}, "edges").min = 0

    def test_what_a_newer_program_adds_is_in_the_document(self):
        end = read(End, END | {"colour": "red"}, "end")
        self.assertEqual(end.document["colour"], "red")
        self.assertEqual(end, read(End, END, "end"))

    def test_a_missing_field_is_named_with_its_place(self):
        without = {key: value for key, value in END.items() if key != "fate"}
        with self.assertRaisesRegex(UnexpectedAnswer, r"ends\[1\] has no 'fate'; the program and this package"):
            read_all(End, [END, without], "ends")

    def test_a_field_of_another_type_is_named_with_its_place(self):
        for change, text in (({"fate": 1}, "end.fate is 1, not str"), ({"diameter_mm": None}, "is None, not float"),
                             ({"diameter_mm": True}, "end.diameter_mm is True, not float"),
                             ({"place_mm": [1, 2]}, "end.place_mm has 2 values, not 3"),
                             ({"odds": [1]}, r"end.odds should be an object, not \[1\]")):
            with self.subTest(change), self.assertRaisesRegex(UnexpectedAnswer, text):
                read(End, END | change, "end")

    def test_what_may_be_missing_has_a_default(self):
        parameter = read(Parameter, {"name": "edge", "type": "real", "unit": "mm", "required": False, "default": None,
                                     "help": ""}, "parameter")
        self.assertEqual((parameter.minimum, parameter.choices, parameter.fields), (None, (), ()))


class Errors(unittest.TestCase):
    def test_errors_travel_between_processes(self):
        diagnostic = read(Diagnostic, {"code": "a-code", "severity": "error", "text": "t", "operation": "", "place_mm": [1, 2, 3],
                                       "figures": {"edge_mm": 8}, "words": {}, "remedies": []}, "diagnostic")
        error = pickle.loads(pickle.dumps(VesselbenchError("why", exit_code=1, diagnostics=(diagnostic,), command=("a", "b"))))
        self.assertEqual((str(error), error.exit_code, error.code, error.place_mm, error.command),
                         ("why", 1, "a-code", (1.0, 2.0, 3.0), ("a", "b")))
