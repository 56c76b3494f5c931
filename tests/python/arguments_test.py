"""Values of Python become the words of a command line."""
import pathlib
import unittest

from vesselbench.arguments import option_words, parameter_words, setting_words, text_of

try:
    import numpy
except ImportError:
    numpy = None


class Values(unittest.TestCase):
    def test_numbers_keep_all_digits(self):
        for value, text in ((3, "3"), (0.1, "0.1"), (1 / 3, "0.3333333333333333"), (1e-5, "1e-05"), (-2.0, "-2.0")):
            self.assertEqual(text_of(value, "x"), text)

    def test_true_is_not_one(self):
        self.assertEqual((text_of(True, "x"), text_of(False, "x"), text_of(1, "x")), ("true", "false", "1"))

    def test_places_and_lists_are_separated_by_commas(self):
        self.assertEqual(text_of((1, -2.5, 3), "x"), "1,-2.5,3")
        self.assertEqual(text_of([(1, 2, 3), (4, 5, 6)], "x"), "1,2,3,4,5,6")
        self.assertEqual(text_of(range(3), "x"), "0,1,2")
        self.assertEqual(text_of([], "x"), "")

    def test_texts_and_paths_stay(self):
        self.assertEqual(text_of("a b=c,d", "x"), "a b=c,d")
        self.assertEqual(text_of(pathlib.Path("a b/c.stl"), "x"), "a b/c.stl")

    def test_records_are_json(self):
        self.assertEqual(text_of([{"place": (1, 2, 3), "way": "wall"}], "x"), '[{"place": [1, 2, 3], "way": "wall"}]')

    def test_what_cannot_be_written_is_named(self):
        for value in (object(), {"a": 1}, b"bytes", 1j):
            with self.subTest(value), self.assertRaisesRegex(TypeError, "edge = "):
                text_of(value, "edge")

    @unittest.skipUnless(numpy, "no numpy")
    def test_numpy_numbers_and_places_are_those_of_python(self):
        self.assertEqual(text_of(numpy.float64(0.5), "x"), "0.5")
        self.assertEqual(text_of(numpy.int32(7), "x"), "7")
        self.assertEqual(text_of(numpy.bool_(True), "x"), "true")
        self.assertEqual(option_words({"inlet": numpy.array([1.5, 2, 3])}), ["--inlet=1.5,2.0,3.0"])
        self.assertEqual(option_words({"inlet": numpy.eye(2)}), ["--inlet=1.0,0.0", "--inlet=0.0,1.0"])


class Words(unittest.TestCase):
    def test_an_option_is_a_switch_a_value_or_several(self):
        words = option_words({"accept_doubts": True, "inlet": [1, (3.0, 4.0, -5.0)], "for_": "cfd", "resume": False,
                              "mask": None})
        self.assertEqual(words, ["--accept-doubts", "--inlet=1", "--inlet=3.0,4.0,-5.0", "--for=cfd"])

    def test_parameters_may_have_the_names_of_words_of_python(self):
        self.assertEqual(parameter_words({"lambda_": 0.5, "beta_min": 0.1, "mu": None}), ["lambda=0.5", "beta_min=0.1"])

    def test_settings_name_operation_and_parameter(self):
        self.assertEqual(setting_words({"remesh.edge": 0.2, "smooth.staircase": False}),
                         ["--set=remesh.edge=0.2", "--set=smooth.staircase=false"])
        self.assertEqual(setting_words(None), [])
