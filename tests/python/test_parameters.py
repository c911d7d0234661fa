"""Parameters from Python: by name and by the functions of C, their table, and their faults."""

import unittest

import support

import numpy as np

import hrad


class Parameters(support.Case):
    def test_by_name(self):
        solver = self.solver
        solver["accuracy"] = 0.1 + 0.2
        self.assertEqual(solver["accuracy"], 0.1 + 0.2)
        solver["accuracy"] = np.float64(0.25)
        self.assertEqual(solver.get_double("accuracy"), 0.25)
        solver["threads"] = np.int32(2)
        self.assertEqual((solver["threads"], type(solver["threads"])), (2, int))
        solver["linking"] = "rows"
        self.assertEqual(solver["linking"], "rows")
        solver["resumable"] = True
        self.assertEqual(solver["resumable"], 1)

    def test_by_the_functions_of_c(self):
        solver = self.solver
        solver.set_int("bands", 4)
        self.assertEqual(solver.get_int("bands"), 4)
        solver.set_double("accuracy", 0.125)
        self.assertEqual(solver.get_double("accuracy"), 0.125)
        solver.set_text("accuracy", "0.5")
        self.assertEqual(solver.get_text("accuracy"), "0.5")

    def test_faults(self):
        solver = self.solver
        self.assert_misfit("brightness", solver.set_double, "brightness", 1.0)
        self.assert_misfit("brightness", solver.__getitem__, "brightness")
        self.assert_misfit("0.0005", solver.set_double, "accuracy", 7)
        self.assert_misfit("accuracy", solver.set_double, "accuracy", float("nan"))
        self.assert_misfit("value is 18446744073709551619", solver.set_int, "bands", 2**64 + 3)
        self.assert_misfit("NUL", solver.set_text, "linking", "rows\0pairs")
        self.assertRaisesRegex(TypeError, "whole number", solver.set_int, "bands", 3.0)
        self.assertRaises(TypeError, solver.set_int, 3, 3)
        self.assertEqual((solver["bands"], solver["accuracy"], solver["linking"]), (3, 0.02, "auto"))

    def test_table(self):
        table = hrad.params()
        self.assertEqual(table[0], hrad.describe_param(0))
        printed = support.hrad_tool("params").splitlines()[1:]
        self.assertEqual([row.name for row in table], [line.split()[0] for line in printed])
        for row in table:
            self.assertEqual(self.solver.get_text(row.name), row.default_text)
            self.assertEqual(type(self.solver[row.name]),
                             {hrad.PARAM_INT: int, hrad.PARAM_DOUBLE: float,
                              hrad.PARAM_TEXT: str}[row.type])
        (accuracy,) = (row for row in table if row.name == "accuracy")
        self.assertEqual((accuracy.minimum, accuracy.maximum, accuracy.choices), (0.0005, 0.5, None))
        self.assert_misfit("no parameter", hrad.describe_param, len(table))

    def test_statuses(self):
        for name, value in vars(hrad).items():
            if name in ("OK", "NOT_CONVERGED", "STOPPED") or name.startswith("ERROR_"):
                self.assertEqual(hrad.status_name(value), "HRAD_" + name)
        self.assertEqual(hrad.status_name(77), "HRAD_UNKNOWN")
        self.assert_misfit("status", hrad.status_name, 2**32)
        with self.assertRaises(hrad.ArgumentError) as caught:
            self.solver["colour"] = 1
        self.assertEqual(caught.exception.message, hrad.error_message())
        self.assertTrue(str(caught.exception).endswith(" (HRAD_ERROR_ARGUMENT)"))


if __name__ == "__main__":
    unittest.main()
