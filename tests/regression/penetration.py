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


class GrainsFile(Case):
    """A packing of the user's own, which settles instead of one that the driver makes."""

    HALF_AXES = 0.7e-3, 0.6e-3, 0.5e-3
    NAMES = "id,x_m,y_m,z_m,qx,qy,qz,qw,a_m,b_m,c_m,exponent_1,exponent_2,material"

    def rows(self, count=(7, 4, 7), spacing=(1.6e-3, 1.45e-3, 1.2e-3)):
        """Ellipsoids in a lattice, those of every second layer shifted and turned about z; the box holds all of them."""
        for number in range(count[0] * count[1] * count[2]):
            k, j, i = number // (count[0] * count[1]), number // count[0] % count[1], number % count[0]
            x, y = (spacing[0] * (i - 3) + 1e-4 * (k % 2), spacing[1] * (j - 1.5))
            turn = 0.1 * (k % 2)
            yield (number, x, y, 0.6e-3 + spacing[2] * k, 0., 0., turn, (1 - turn ** 2) ** 0.5, *self.HALF_AXES, 0.9, 1.1, 0)

    def write(self, name, rows):
        path = self.tmp / name
        path.write_text("\n".join([self.NAMES, *(",".join(map(repr, row)) for row in rows)]) + "\n")
        return path

    def test_a_table(self):
        rows = list(self.rows())
        setting = f"Sand/grains file={self.write('own.csv', rows)}"
        command = self.command(self.tmp / "own", [*SHORT, setting])
        command.remove("--quiet")
        result = subprocess.run(command, capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("own.csv: 196 grains with half-axes of 0.0005 to 0.0007 m in [", result.stderr)
        figures = json.loads((self.tmp / "own" / "summary.json").read_text())
        self.check_balances(figures, self.table("own"))
        self.assertEqual(figures["particles"], len(rows))
        self.assertLess(figures["sand_height_m"], 7 * 1.2e-3)  # the lattice has fallen in
        other = [*rows[:-1], (*rows[-1][:1], rows[-1][1] - 1e-6, *rows[-1][2:])]
        self.figures("moved", [*SHORT, f"Sand/grains file={self.write('moved.csv', other)}"])
        self.assertNotEqual(self.table("moved"), self.table("own"))

    def test_a_dump_is_the_same_as_a_table(self):
        """LIGGGHTS' names and order, and blockiness that is two over our exponents, exactly: 2 / 0.8 and 2 / 1."""
        rows = [(*row[:11], 1., 0.8, 0) for row in self.rows()]
        lines = ["ITEM: TIMESTEP", "7", "ITEM: NUMBER OF ATOMS", str(len(rows)), "ITEM: BOX BOUNDS ff ff ff",
                 *["-0.01 0.01"] * 3,
                 "ITEM: ATOMS id type x y z quat1 quat2 quat3 quat4 shapex shapey shapez blockiness1 blockiness2"]
        for number, x, y, z, *turn, a, b, c, _, _, _ in rows:
            lines.append(" ".join(map(repr, (number + 1, 1, x, y, z, turn[3], *turn[:3], a, b, c, 2.5, 2))))
        dump = self.tmp / "own.liggghts"
        dump.write_text("\n".join(lines) + "\n")
        for name, file in (("table", self.write("own.csv", rows)), ("dump", dump)):
            self.figures(name, [*SHORT, f"Sand/grains file={file}"])
        self.assertEqual(self.table("dump"), self.table("table"))

    def test_bad_files(self):
        rows = list(self.rows())
        for row, words in (((999, 0, 0, "x", *rows[0][4:]), ("bad.csv, line 198: column 4 (z_m) is ", "no finite number")),
                           ((999, 5.6e-3, *rows[0][2:]), ("bad.csv: the grain 196", "x = 0.0063 m", "0.006 m")),
                           ((999, 0, 0, 4e-3, 0, 0, 0, 1, 1e-3, 6e-4, 6e-4, 1, 1, 0),
                            ("bad.csv: the grain 196", "0.0006 to 0.001 m", "Sand/largest half-axis (0.0009 m)"))):
            self.assert_refused([f"Sand/grains file={self.write('bad.csv', [*rows, row])}"], *words)
        self.assert_refused([f"Sand/grains file={self.tmp}/none.csv"], "none.csv")


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
