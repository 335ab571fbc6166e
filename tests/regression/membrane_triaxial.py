#!/usr/bin/env python3
"""The driver membrane_triaxial as a user runs it: beads in a membrane, restart after a kill, bad input.

Usage: membrane_triaxial.py PROGRAM [TOPIC]
"""

import math
import signal
import sys
import unittest
from pathlib import Path

from driver_process import DriverCase, SNAPSHOTS_BY_STEPS, n_rows, renewal, stop_when

PROGRAM = Path(sys.argv.pop(1)).resolve()
SMOKE = Path(__file__).resolve().parents[2] / "drivers" / "membrane_triaxial" / "smoke.prm"

PRESSURE, GRAVITY, DENSITY = 100e3, 9.81, 2550
N_AROUND, N_HIGH = 12, 6

# Fewer beads, for what needs no sample.
SHORT = ["Mould/diameter=0.018", "Mould/height=0.02", "Mould/solid fraction=0.35", "Mould/force tolerance=0.8",
         "Test/loading time=2e-4", "Test/force tolerance=0.5", "Test/pressure tolerance=0.1", "Test/axial strain=5e-3",
         "Test/start strain=1e-3", "Output/samples=100"]


class Case(DriverCase):
    program, parameters = PROGRAM, SMOKE

    def check_success(self, result):
        super().check_success(result)
        self.assertEqual(result.stderr, "")


class Results(Case):
    def test_beads(self):
        figures, rows = self.figures("run"), self.table("run")
        self.assertEqual(figures["elements"], N_AROUND * N_HIGH)
        self.assertEqual(figures["nodes"], N_AROUND * (N_HIGH + 1))
        self.check_loading(figures)
        self.check_volume(figures, rows)
        self.check_compression(figures, rows)
        self.check_shape(figures, rows)
        self.assertLess(figures["energy_residual"], 1e-4)

    def check_loading(self, figures):
        """Under the pressure alone the grains have it on all sides. Across, the rims take up to half of that on the rows
        beside them, and the plates' friction up to (2/3) 0.1 R/h."""
        first = self.table("run", "loading.csv")[0]
        self.assertAlmostEqual(first["grain_axial_stress_Pa"] / 1e3, 1, delta=0.15)  # of the mould
        self.assertAlmostEqual(first["grain_lateral_stress_Pa"] / 1e3, 1, delta=0.15)
        self.assertAlmostEqual(figures["loaded_grain_axial_stress_over_pressure"], 1, delta=0.06)
        self.assertGreater(figures["loaded_grain_lateral_stress_over_pressure"], 1 - 1 / N_HIGH - 0.02)
        self.assertLess(figures["loaded_grain_lateral_stress_over_pressure"], 1.03)

    def check_volume(self, figures, rows):
        """Where the membrane has taken the mould's place it is a prism; the beads' volume stays what it was."""
        first = self.table("run", "loading.csv")[0]
        radius, height = figures["mould_diameter_m"] / 2, figures["mould_height_m"]
        prism = N_AROUND / 2 * radius**2 * math.sin(2 * math.pi / N_AROUND) * height
        self.assertAlmostEqual(first["volume_m3"] / prism, 1, delta=1e-7)  # digits of the table
        beads = first["volume_m3"] * first["solid_fraction"]
        for row in rows:
            self.assertAlmostEqual(row["volume_m3"] * row["solid_fraction"] / beads, 1, delta=1e-7)

    def check_compression(self, figures, rows):
        """The plates go as far as they are told, both bear the same but for the sample's weight and its motion, and what
        they bear is the mean stress of the grains."""
        self.assertAlmostEqual(rows[-1]["axial_strain"], 0.04, delta=1e-5)
        late = [row for row in rows if row["axial_strain"] > 0.01]
        for row in late:
            self.assertEqual(row["lateral_pressure_Pa"], PRESSURE)
        mean = lambda name: sum(row[name] for row in late) / len(late)
        self.assertAlmostEqual(mean("axial_stress_Pa") / mean("grain_axial_stress_Pa"), 1, delta=0.08)
        axial_force = mean("axial_stress_Pa") * late[0]["volume_m3"] / late[0]["height_m"]
        self.assertLess(abs(mean("plate_force_difference_N")), 0.1 * axial_force)
        self.assertGreater(mean("stress_ratio"), 1.3)
        self.assertLess(mean("stress_ratio"), 2.6)

    def check_shape(self, figures, rows):
        """The rims stay where they were, between them the sample grows."""
        shapes = self.table("run", "shape.csv")
        self.assertEqual([row["time_s"] for row in shapes], [row["time_s"] for row in rows])
        for row in shapes:
            for rim in (1, N_HIGH + 1):
                self.assertAlmostEqual(row[f"radius_{rim}_m"], figures["mould_diameter_m"] / 2, delta=1e-12)
        middle = f"radius_{N_HIGH // 2 + 1}_m"
        self.assertGreater(shapes[-1][middle] / shapes[0][middle], 1.005)
        self.assertGreater(figures["final_middle_radius_over_rim"], 1)

    def test_smooth_beads(self):
        """Without friction little is borne beyond the pressure."""
        smooth = ["Grains/friction=0", "Grains/plate friction=0", "Membrane/friction=0", "Mould/friction=0",
                  "Test/axial strain=0.02"]
        self.figures("smooth", smooth)
        late = [row["stress_ratio"] for row in self.table("smooth") if row["axial_strain"] > 0.01]
        self.assertLess(sum(late) / len(late), 1.5)

    def test_threads_and_samples(self):
        """The same on two threads, and in a test that begins from the other's sample."""
        self.figures("whole", SHORT, "--threads", "1")
        self.figures("threads", SHORT, "--threads", "2")
        sample = f"Mould/sample={self.tmp / 'whole' / 'sample.h5'}"
        self.figures("sample", [*SHORT, sample])
        for other in ("threads", "sample"):
            for file in ("loading.csv", "history.csv", "shape.csv"):
                self.assertEqual(self.table("whole", file), self.table(other, file))
        self.assert_refused([*SHORT, sample, "Mould/friction=0.1"], "set friction", "0.1")
        self.assert_refused([*SHORT, "Mould/sample=none.h5"], "none.h5", status=1)


class Restart(Case):
    def test_kill(self):
        """Killed while the mould shrinks and while the pressure grows, stopped by Ctrl-C under compression: the same to
        the last bit."""
        self.figures("whole", SHORT)
        parts = self.tmp / "parts"
        options = SNAPSHOTS_BY_STEPS
        for file, rows, send in ((None, 0, signal.SIGKILL), ("loading.csv", 5, signal.SIGKILL),
                                 ("history.csv", 20, signal.SIGINT)):
            has_snapshot = renewal(parts / "snapshot.h5")
            stop_when(lambda: has_snapshot() and (file is None or n_rows(parts / file) > rows),
                      self.command(parts, SHORT, *options), send)
            options = [*SNAPSHOTS_BY_STEPS, "--restart"]
        self.check_success(self.run_driver(parts, SHORT, *options))
        for file in ("mould.csv", "loading.csv", "history.csv", "shape.csv"):
            self.assertEqual((parts / file).read_text(), (self.tmp / "whole" / file).read_text())
        self.assert_same_results("parts", "whole")


class BadInput(Case):
    def test_parameters(self):
        for setting, words in (("Test/lateral pressure=500", ("Test/lateral pressure is 500", "Mould/pressure")),
                               ("Test/start strain=0.06", ("Test/start strain is 0.06", "Test/axial strain")),
                               ("Test/time step=1e-4", ("Test/time step is 0.0001", "below")),
                               ("Mould/time step=1e-4", ("Mould/time step is 0.0001", "below")),
                               ("Membrane/moduli=1, -1, 0", ("Ogden",)),
                               ("Membrane/elements around=2", ("Membrane/elements around",))):
            self.assert_refused([setting], *words)

    def test_space(self):
        """Beads that do not fit are refused once they are to be placed."""
        self.assert_refused(["Mould/diameter=0.004"], "small", status=2, writes=True)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[1:], verbosity=2)
