#!/usr/bin/env python3
"""The driver penetration as a user runs it: a pile, a cone and a plate in sand, restart after a kill, bad input.

Usage: penetration.py PROGRAM [TOPIC]
"""

import json
import signal
import subprocess
import sys
import unittest
from pathlib import Path

from driver_process import OneThreadCase, SNAPSHOTS_BY_STEPS, n_rows, renewal, stop_when

PROGRAM = Path(sys.argv.pop(1)).resolve()
SMOKE = Path(__file__).resolve().parents[2] / "drivers" / "penetration" / "smoke.prm"

FRICTION = 0.1  # between grains and intruder
SHORT = ["Sand/Settling/time=0.02", "Penetration/depth=1e-3", "Penetration/start time=2e-3", "Output/samples=40"]


class Case(OneThreadCase):
    program, parameters = PROGRAM, SMOKE

    def check_balances(self, figures, rows):
        """What holds whatever the grains do: nothing touches at first; tip and shaft are all; what drives the body is
        what it meets; momentum and energy."""
        self.assertEqual(figures["undecided_contacts"], 0)
        self.assertEqual(rows[0]["resistance_N"], 0)
        self.assertEqual(rows[0]["tip_normal_N"] + rows[0]["shaft_normal_N"], 0)
        largest = max(row["resistance_N"] for row in rows)
        self.assertGreater(largest, 0)
        for row in rows:
            self.assertAlmostEqual(row["tip_resistance_N"] + row["shaft_resistance_N"], row["resistance_N"],
                                   delta=1e-12 * largest)
            self.assertAlmostEqual(-row["drive_force_N"], row["resistance_N"], delta=1e-10 * largest)
            for part in ("tip", "shaft"):
                self.assertLessEqual(row[f"{part}_shear_N"], FRICTION * (1 + 1e-9) * row[f"{part}_normal_N"])
            self.assertEqual(row["sides_force_N"], 0)  # smooth
        self.assertLess(figures["momentum_residual"], 1e-10)
        self.assertLess(figures["energy_residual"], 5e-3)


class Results(Case):
    def test_pile(self):
        command = self.command(self.tmp / "pile")
        command.remove("--no-plots")
        self.check_success(subprocess.run(command, capture_output=True, text=True))
        for picture in ("penetration", "force_chains", "energy"):
            self.assertTrue((self.tmp / "pile" / "plots" / f"{picture}.png").exists())
        figures, rows = json.loads((self.tmp / "pile" / "summary.json").read_text()), self.table("pile")
        self.check_balances(figures, rows)
        for row in rows:  # the shaft is upright: what bears there is friction
            self.assertLessEqual(abs(row["shaft_resistance_N"]), row["shaft_shear_N"] * (1 + 1e-9))
        self.assertGreater(max(row["shaft_shear_N"] for row in rows), 0)
        self.assertAlmostEqual(rows[-1]["way_m"], 4e-3, delta=0.1 * 1.2e-5)
        self.assertAlmostEqual(rows[0]["way_m"], 0, delta=1e-15)
        # The floor bears the sand, which still settles, and then what the pile exerts, but for what changes the sand's
        # momentum. Any sand bears several times its weight above.
        self.assertAlmostEqual(figures["sand_floor_share"], 1, delta=0.2)
        self.assertAlmostEqual(-rows[0]["floor_force_N"] / figures["sand_weight_N"], 1, delta=0.2)
        deep = [row for row in rows if row["way_m"] > 2e-3]
        mean = {name: sum(row[name] for row in deep) / len(deep) for name in ("floor_force_N", "resistance_N")}
        self.assertAlmostEqual(-mean["floor_force_N"], figures["sand_weight_N"] + mean["resistance_N"],
                               delta=0.3 * mean["resistance_N"])
        self.assertGreater(figures["bearing_factor"], 3)
        for row in rows:
            self.assertTrue(0.1 < row["solid_fraction_below_tip"] < 0.8, row["solid_fraction_below_tip"])
            self.assertTrue(1 < row["coordination_number"] < 9, row["coordination_number"])
            held = row["coordination_number_without_rattlers"]
            self.assertTrue(held == 0 or held >= 4, held)  # what has fewer contacts is a rattler
            self.assertTrue(0.5 < row["coordination_number_deviation"] < 4)

    def test_cone_and_plate(self):
        """Points and flat edges; on two threads the same."""
        for name, settings in (("cone", ["Intruder/kind=cone", "Intruder/tip angle=60", "Intruder/facets=12"]),
                               ("plate", ["Intruder/kind=plate", "Intruder/breadth=3e-3"])):
            self.check_balances(self.figures(name, SHORT + settings), self.table(name))
            self.figures(f"{name} again", SHORT + settings, "--threads", "2")
            self.assertEqual(self.table(name), self.table(f"{name} again"))

    def test_without_friction(self):
        """A smooth pile has no friction, and so its shaft bears nothing."""
        figures = self.figures("smooth", ["Intruder/friction=0"])
        self.assertEqual(figures["largest_shaft_friction"], 0)
        rows = self.table("smooth")
        self.assertGreater(max(row["shaft_normal_N"] for row in rows), 0)
        for row in rows:
            self.assertEqual(row["tip_shear_N"] + row["shaft_shear_N"], 0)
            self.assertLessEqual(abs(row["shaft_resistance_N"]), 1e-12 * row["shaft_normal_N"])


class Restart(Case):
    def test_kill(self):
        """Killed while the sand settles, and stopped by Ctrl-C while the pile goes down: the same to the last bit."""
        self.figures("whole", SHORT)
        parts = self.tmp / "parts"
        options = SNAPSHOTS_BY_STEPS
        for rows, send in ((None, signal.SIGKILL), (25, signal.SIGINT)):
            has_snapshot = renewal(parts / "snapshot.h5")
            stop_when(lambda: has_snapshot() and (rows is None or n_rows(parts / "history.csv") > rows),
                      self.command(parts, SHORT, *options), send)
            options = [*SNAPSHOTS_BY_STEPS, "--restart"]
        self.check_success(self.run_driver(parts, SHORT, *options))
        for file in ("history.csv", "grains_0001.vtu", "contacts_0001.vtu", "surfaces_0001.vtu"):
            self.assertEqual((parts / file).read_bytes(), (self.tmp / "whole" / file).read_bytes(), file)
        self.assert_same_results("parts", "whole")


class BadInput(Case):
    def test_parameters(self):
        for setting, words in (("Intruder/width=0.012", ("Intruder/width is 0.012 m", "Sand/box, 0.012 m")),
                               ("Penetration/depth=8e-3", ("Penetration/depth is 0.008 m", "Sand/box")),
                               ("Penetration/start time=1", ("Penetration/start time is 1 s", "Penetration/depth")),
                               ("Penetration/time step=1e-3", ("Penetration/time step is 0.001", "below")),
                               ("Sand/Settling/time step=1e-3", ("Sand/Settling/time step is 0.001", "below")),
                               ("Intruder/kind=needle", ("Intruder/kind",)),
                               ("Intruder/tip angle=0", ("Intruder/tip angle",))):
            self.assert_refused([setting], *words)
        for settings, word in ((["Intruder/kind=cone", "Intruder/width=7e-3"], "Intruder/width"),
                               (["Intruder/kind=plate", "Intruder/breadth=7e-3"], "Intruder/breadth")):
            self.assert_refused(settings, "the intruder is 0.007 m across", word)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[1:], verbosity=2)
