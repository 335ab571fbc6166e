#!/usr/bin/env python3
"""The driver pile_installation as a user runs it: two scales beside grains alone, no pile, restart after a kill, bad input.

Usage: pile_installation.py PROGRAM [TOPIC]
"""

import json
import signal
import subprocess
import sys
import unittest
from pathlib import Path

from driver_process import OneThreadCase, SNAPSHOTS_BY_STEPS, n_rows, renewal, stop_when

PROGRAM = Path(sys.argv.pop(1)).resolve()
FOLDER = Path(__file__).resolve().parents[2] / "drivers" / "pile_installation"

FRICTION = 0.1  # between grains and pile
GRAINS_ALONE = ["Model/kind=grains"]
SHORT = ["Pile/time=8e-3", "Output/samples=40"]
GROWING = [*SHORT, "Model/block depth=7.4e-3", "Model/growth depth=2.6e-3", "Model/beyond bottom=4e-3"]


class Case(OneThreadCase):
    program, parameters = PROGRAM, FOLDER / "smoke.prm"

    def check_balances(self, figures, rows):
        """What holds whatever the sand does: nothing touches at first; tip and shaft are all; what drives the pile is
        what it meets; the account of the energy closes to 1e-4 of the pile's work (what is left is of second
        order in the step), and to 2 % of what grains brought that came (of first order)."""
        self.assertEqual(figures["undecided_contacts"], 0)
        self.assertEqual(rows[0]["tip_normal_N"] + rows[0]["shaft_normal_N"], 0)
        largest = max(row["head_resistance_N"] for row in rows)
        self.assertGreater(largest, 0)
        for row in rows:
            self.assertAlmostEqual(row["tip_resistance_N"] + row["shaft_resistance_N"], row["head_resistance_N"],
                                   delta=1e-10 * largest)
            for part in ("tip", "shaft"):
                self.assertLessEqual(row[f"{part}_shear_N"], FRICTION * (1 + 1e-9) * row[f"{part}_normal_N"])
        work, brought = rows[-1]["pile_work_J"], max(abs(row["energy_weight_work_J"]) for row in rows)
        self.assertGreater(work, 0)
        self.assertLess(figures["energy_residual"], 1e-4 + 0.02 * brought / work)


class Results(Case):
    def test_two_scales_and_grains(self):
        """The same sand: what the pile meets and what the ground bears is alike."""
        command = self.command(self.tmp / "two")
        command.remove("--no-plots")
        self.check_success(subprocess.run(command, capture_output=True, text=True))
        for picture in ("resistance", "section", "energy"):
            self.assertTrue((self.tmp / "two" / "plots" / f"{picture}.png").exists())
        figures = {"two": json.loads((self.tmp / "two" / "summary.json").read_text()),
                   "alone": self.figures("alone", GRAINS_ALONE)}
        rows = {name: self.table(name) for name in figures}
        for name in figures:
            self.check_balances(figures[name], rows[name])
            self.assertEqual(rows[name][0]["way_m"], 0)
            self.assertAlmostEqual(rows[name][-1]["way_m"], 1e-3, delta=0.1 * 8e-6)
        two, alone = figures["two"], figures["alone"]
        self.assertEqual((two["model"], alone["model"]), ("two-scale", "grains"))
        for figure in ("sand_height_m", "sand_level_m", "earth_pressure_at_rest_x"):  # the same sand
            self.assertEqual(two[figure], alone[figure])
        self.assertLess(two["particles"], 0.7 * alone["particles"])
        self.assertGreater(two["elements"], 100)
        # The bottom bears the weight of all ground, of either kind; the sand still swings a little.
        weight = alone["sand_bulk_density_kg_m3"] * 9.81 * 0.024 * 0.0045 * alone["sand_level_m"]
        for name in figures:
            self.assertAlmostEqual(-rows[name][0]["bottom_force_N"], weight, delta=0.15 * weight)
        # No grain between pile and overlap knows of it before a force has come there and back. Later the way of sliding
        # grains differs, and a pile of some grains' width feels each; the work that it takes is alike.
        largest = max(row["head_resistance_N"] for row in rows["alone"])
        ratio = rows["two"][-1]["pile_work_J"] / rows["alone"][-1]["pile_work_J"]
        self.assertGreater(ratio, 0.5)
        self.assertLess(ratio, 2)
        first = next(k for k, row in enumerate(rows["alone"]) if row["head_resistance_N"] > 0.05 * largest)
        self.assertAlmostEqual(rows["two"][first]["head_resistance_N"], rows["alone"][first]["head_resistance_N"],
                               delta=0.05 * rows["alone"][first]["head_resistance_N"])
        self.assertGreater(rows["two"][-1]["largest_element_motion_m"], 1e-6)

    def test_no_pile(self):
        """Ground that is left alone stays where it is as that of grains alone does: the start is in equilibrium."""
        at_rest = ["Pile/speed=0", "Pile/time=4e-3", "Sand/Settling/time=0.1"]
        two, alone = self.figures("two", at_rest), self.figures("alone", at_rest + GRAINS_ALONE)
        self.assertEqual(two["pile_work_J"], 0)
        self.assertEqual(max(row["head_resistance_N"] for row in self.table("two")), 0)
        # Of a grain. Settled sand goes on swinging; the cut and the elements may add a thousandth.
        self.assertLess(alone["drift_over_grain"], 5e-3)
        self.assertLess(two["drift_over_grain"], alone["drift_over_grain"] + 1e-3)

    def test_growing_block(self):
        """A block that grows downwards as the pile comes near its end: grains come, nothing else happens. On two
        threads alike."""
        pressing = [*GROWING, "Model/growth distance=6.2e-3", "Output/pictures=1"]
        figures, rows = self.figures("pressing", pressing), self.table("pressing")
        self.check_balances(figures, rows)
        self.assertEqual(figures["block_growths"], 2)
        # Without a pile, in one go: what comes has lost the springs of friction, no more.
        at_rest = [*GROWING, "Model/growth distance=1", "Pile/speed=0"]
        grown, still = self.figures("grown", at_rest), self.figures("still", [*at_rest, "Model/growth depth=0"])
        self.assertEqual((grown["block_growths"], still["block_growths"]), (2, 0))
        self.assertGreater(grown["particles"], 1.2 * still["particles"])
        self.assertLess(grown["drift_over_grain"], still["drift_over_grain"] + 0.03)
        self.figures("again", pressing, "--threads", "2")
        self.assertEqual(self.table("again"), rows)

    def test_force(self):
        """A pile that its head's force drives: the force is as given, the pile goes down, on two threads alike."""
        settings = ["Pile/drive=force", "Pile/head force=0.01", "Pile/time=0.02", "Output/samples=20"]
        figures, rows = self.figures("force", settings), self.table("force")
        for row in rows:
            self.assertAlmostEqual(row["head_resistance_N"], 0.01 * row["time_s"] / 0.02, delta=1e-5)
        self.assertGreater(rows[-1]["way_m"], 1e-4)
        self.assertGreater(rows[-1]["pile_work_J"], 0)
        self.assertLess(figures["energy_residual"], 1e-4)
        self.figures("again", settings, "--threads", "2")
        self.assertEqual(self.table("again"), rows)


class Restart(Case):
    def test_kill(self):
        """Killed while the sand settles, and stopped by Ctrl-C while the pile goes down: the same to the last bit."""
        # Made anew before and after the stop, and deeper before and after it.
        short = [*GROWING, "Coupling/renewal=2e-3", "Model/growth distance=6.2e-3"]
        whole = self.figures("whole", short)
        self.assertGreater(whole["overlap_renewals"], 3)
        self.assertEqual(whole["block_growths"], 2)
        parts = self.tmp / "parts"
        options = SNAPSHOTS_BY_STEPS
        for rows, send in ((None, signal.SIGKILL), (25, signal.SIGINT)):
            has_snapshot = renewal(parts / "snapshot.h5")
            stop_when(lambda: has_snapshot() and (rows is None or n_rows(parts / "history.csv") > rows),
                      self.command(parts, short, *options), send)
            options = [*SNAPSHOTS_BY_STEPS, "--restart"]
        self.check_success(self.run_driver(parts, short, *options))
        for file in ("history.csv", "grains_0001.vtu", "surfaces_0001.vtu"):
            self.assertEqual((parts / file).read_bytes(), (self.tmp / "whole" / file).read_bytes(), file)
        self.assert_same_results("parts", "whole")


class BadInput(Case):
    def test_parameters(self):
        for setting, words in (("Pile/width=0.03", ("Pile/width is 0.03 m", "Sand/box, 0.024 m")),
                               ("Pile/time=0.2", ("Pile/speed, Pile/time", "Model/block depth")),
                               ("Pile/start time=1", ("Pile/start time is 1 s", "Pile/time")),
                               ("Pile/time step=1e-3", ("Pile/time step is 0.001", "below")),
                               ("Pile/kind=plate", ("Pile/kind",)),
                               ("Model/kind=continuum", ("Model/kind", "two-scale")),
                               ("Model/block width=0.03", ("Model/block width is 0.03 m", "Sand/box, 0.024 m")),
                               ("Model/block width=0.024", ("Model/beyond sides",)),
                               ("Model/block width=0.01", ("Model/block width", "at least 0.0124")),
                               ("Model/block depth=0.0103", ("Model/beyond sides or bottom",)),
                               ("Model/block depth=0.012", ("Model/block depth is 0.012 m", "Sand/box")),
                               ("Model/element size=1e-3", ("Model/element size is 0.001 m", "mean grain")),
                               ("Model/growth=0.5", ("Model/growth",)),
                               ("Model/growth depth=-1", ("Model/growth depth",)),
                               ("Model/growth depth=3e-3", ("may grow to", "Sand/box")),
                               ("Coupling/penalty=-1", ("Coupling/penalty",)),
                               ("Continuum/Young's modulus=1e11", ("Pile/time step is 6e-06 s", "elements"))):
            with self.subTest(setting):
                self.assert_refused([setting], *words)

    def test_end_of_the_block(self):
        """A force that drives the pile through its grains: told by name, with a remedy."""
        self.assert_refused(["Pile/drive=force", "Pile/head force=2", "Pile/time=0.05", "Sand/Settling/time=0.02"],
                            "the pile has come to the end", "Model/block depth", status=1, writes=True)

    def test_parameter_files(self):
        """Every parameter file of the driver is read and valid: what is refused is only the missing snapshot."""
        files = sorted(FOLDER.glob("*.prm"))
        self.assertGreaterEqual(len(files), 4)
        for prm in files:
            with self.subTest(prm.name):
                result = self.run_driver(self.tmp / "none", (), "--restart", file=prm)
                self.assertEqual(result.returncode, 2, result.stderr)
                self.assertIn("snapshot", result.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[1:], verbosity=2)
