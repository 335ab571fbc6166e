#!/usr/bin/env python3
"""The driver rubber_block as a user runs it: a block on sand, restart after a kill, bad input.

Usage: rubber_block.py PROGRAM [TOPIC]
"""

import signal
import sys
import unittest
from pathlib import Path

from driver_process import DriverCase, SNAPSHOTS_BY_STEPS, n_rows, renewal, stop_when

PROGRAM = Path(sys.argv.pop(1)).resolve()
SMOKE = Path(__file__).resolve().parents[2] / "drivers" / "rubber_block" / "smoke.prm"

FRICTION = 1  # between grains and block
PRESSURE, AREA = 250e3, 6e-3 * 4e-3

# Fewer and larger grains, for what needs no sand: two layers.
COARSE = ["Sand/mean half-axes=0.7e-3, 0.6e-3, 0.5e-3", "Sand/smallest half-axis=0.4e-3", "Sand/largest half-axis=0.9e-3",
          "Sand/box=0.014, 0.009, 0.0055", "Sand/Settling/time=0.6e-3"]
SHORT = COARSE + ["Pull/loading time=0.1e-3", "Pull/holding time=0.05e-3", "Pull/start time=0.02e-3", "Pull/time=0.1e-3", "Pull/time step=1.6e-7"]


class Case(DriverCase):
    program, parameters = PROGRAM, SMOKE

    def check_success(self, result):
        super().check_success(result)
        self.assertEqual(result.stderr, "")


class Results(Case):
    def test_block(self):
        figures, rows = self.figures("run"), self.table("run")
        self.assertEqual(figures["elements"], 5 * 3 * 4 - 3)
        self.assertAlmostEqual(figures["sand_floor_share"], 1, delta=0.1)  # walls carry some, and it still settles
        self.assertTrue(0 < figures["max_overlap_over_radius"] < 0.5, figures)
        self.check_balance(figures, rows)
        self.check_friction(figures, rows)
        self.check_motion(rows)
        self.check_strips(rows)

    def check_balance(self, figures, rows):
        """What pull and pressure put in is in motion, springs and losses."""
        self.assertLess(figures["energy_residual"], 1e-3)
        last = rows[-1]
        put_in = last["work_pressure_J"] + last["work_pull_J"]
        self.assertGreater(last["energy_friction_loss_J"], 0.3 * put_in)
        self.assertLess(last["energy_friction_loss_J"], put_in)

    def check_friction(self, figures, rows):
        """No contact has more than Coulomb's force, so their sum has not, either."""
        for row in rows:
            self.assertLessEqual(row["mobilized_friction"], FRICTION * (1 + 1e-9))
        self.assertGreater(figures["mobilized_friction"], 0.24)  # the grains' own coefficient
        self.assertGreater(figures["friction_coefficient"], 0.1)  # with what lies in front of it, it may exceed Coulomb's
        self.assertLess(figures["friction_coefficient"], 2 * FRICTION)

    def check_motion(self, rows):
        """The ground carries the pressure: some metres per second of the block, a tenth of a gram, over 0.4 ms, are
        a tenth of it. The top goes as fast as it is told."""
        self.assertEqual(rows[0]["top_pressure_Pa"], 0)
        self.assertEqual(rows[-1]["top_pressure_Pa"], PRESSURE)
        self.assertAlmostEqual(rows[-1]["position_m"], 30 / 3.6 * (0.25e-3 - 0.5 * 0.05e-3), delta=1e-6)
        carried = [row["contact_force_z_N"] for row in rows if row["time_s"] > 0.3e-3]
        self.assertAlmostEqual(sum(carried) / len(carried) / (PRESSURE * AREA), 1, delta=0.15)

    def check_strips(self, rows):
        """Pressures over the strips add up to the normal forces, about the vertical force."""
        strips = self.table("run", "pressure.csv")
        self.assertEqual([row["time_s"] for row in strips], [row["time_s"] for row in rows])
        held = [(s, r) for s, r in zip(strips, rows) if 0.3e-3 < r["time_s"] < 0.45e-3]
        for pressures, row in held:
            force = sum(value for key, value in pressures.items() if key.startswith("strip")) * AREA / 5
            self.assertAlmostEqual(force / row["contact_force_z_N"], 1, delta=0.2)

    def test_balance_over_the_step(self):
        """The balance misses the less the shorter the step."""
        settings = SHORT + ["Pull/pressure=100e3", "Pull/time=1e-5", "Output/samples=20"]
        residuals = [self.figures(step, settings + [f"Pull/time step={step}"])["energy_residual"]
                     for step in ("2e-7", "5e-8")]
        self.assertLess(residuals[0], 1e-3)
        self.assertLess(residuals[1], 0.5 * residuals[0])

    def test_threads(self):
        for threads in ("1", "2"):
            self.figures(threads, SHORT, "--threads", threads)
        for file in ("history.csv", "pressure.csv"):
            self.assertEqual(self.table("1", file), self.table("2", file))


class Restart(Case):
    def test_kill(self):
        """Killed while the sand settles, and stopped by Ctrl-C while it is pulled: the same to the last bit."""
        whole = self.figures("whole", SHORT)
        self.assertGreater(whole["mean_vertical_force_N"], 1)  # it has come to the sand
        parts = self.tmp / "parts"
        options = SNAPSHOTS_BY_STEPS
        for rows, send in ((None, signal.SIGKILL), (40, signal.SIGINT)):
            has_snapshot = renewal(parts / "snapshot.h5")
            stop_when(lambda: has_snapshot() and (rows is None or n_rows(parts / "history.csv") > rows),
                      self.command(parts, SHORT, *options), send)
            options = [*SNAPSHOTS_BY_STEPS, "--restart"]
        self.check_success(self.run_driver(parts, SHORT, *options))
        for file in ("history.csv", "pressure.csv"):
            self.assertEqual((parts / file).read_text(), (self.tmp / "whole" / file).read_text())
        self.assert_same_results("parts", "whole")


class BadInput(Case):
    def test_parameters(self):
        for setting, words in (("Block/notch elements along=2", ("Block/notch elements along is 2", "groove")),
                               ("Block/notch elements high=4", ("Block/notch elements high is 4", "top layers")),
                               ("Pull/time=2e-3", ("Sand/box is 0.014 m long", "Pull/time")),
                               ("Block/edges=0.006, 0.008, 0.003", ("Block/edges is 0.008 m across",)),
                               ("Pull/time step=1e-5", ("Pull/time step is 1e-05", "below")),
                               ("Block/Rubber/second share=2", ("Block/Rubber/second share",)),
                               ("Block/Top layer/Poisson's ratio=0.5", ("Poisson",))):
            self.assert_refused([setting], *words)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[1:], verbosity=2)
