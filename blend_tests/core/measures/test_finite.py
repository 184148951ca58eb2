"""Which arrays may reach the sinks."""

import math
import unittest
import warnings

import numpy as np

import support

finite = support.addon("core.measures.finite")


@support.in_one_blender
class Finite(unittest.TestCase):
    def test_few_numbers_and_many(self):
        """A number that single precision does not hold counts as infinite, wherever it stands, and nothing warns of it."""
        for shape in ((1,), (10,), (5, 3), (64,), (65,), (100, 10)):
            for number in (0.0, -1e-300, 1e38, -3e38, 1e39, -1e200, math.inf, -math.inf, math.nan):
                for place in (0, -1):
                    numbers = np.ones(shape)
                    numbers.reshape(-1)[place] = number
                    with self.subTest(shape=shape, number=number), warnings.catch_warnings():
                        warnings.simplefilter("error")
                        self.assertIs(finite.is_finite(numbers), abs(number) < 3.4e38)

    def test_opposite_numbers_do_not_cancel(self):
        for numbers in ((1e300, -1e300), (math.inf, -math.inf)):
            self.assertFalse(finite.is_finite(np.array(numbers)))

    def test_no_number(self):
        self.assertTrue(finite.is_finite(np.empty((0, 3))))
