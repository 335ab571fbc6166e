#!/usr/bin/env python3
"""The driver pile_installation as a user runs it: two scales beside grains alone, no pile, restart after a kill, bad input.

Usage: pile_installation.py PROGRAM [TOPIC]
"""

import json
import math
import os
import re
import signal
import struct
import subprocess
import sys
import unittest
from pathlib import Path

from driver_process import OneThreadCase, SNAPSHOTS_BY_STEPS, n_rows, renewal, stop_when
from vtu_file import read_vtu

PROGRAM = Path(sys.argv.pop(1)).resolve()
FOLDER = Path(__file__).resolve().parents[2] / "drivers" / "pile_installation"

FRICTION = 0.1  # between grains and pile
GRAINS_ALONE = ["Model/kind=grains"]
SHORT = ["Pile/time=8e-3", "Output/samples=40"]
GROWING = [*SHORT, "Model/block depth=7.4e-3", "Model/growth depth=2.6e-3", "Model/beyond bottom=4e-3"]
FIELD_FILES = ("grains_0001.vtu", "surfaces_0001.vtu", "contacts_0001.vtu", "solid_fraction_0001.vtu", "stress_0001.vtu")


def highest_point(path):
    """Of the elements at a picture [m]; their files are compressed, so VTK reads them."""
    script = "import sys, bergamo; print(bergamo.read_grid(sys.argv[1]).GetBounds()[5])"
    environment = {**os.environ, "PYTHONPATH": str(FOLDER.parent / "python")}
    return float(subprocess.run(["/usr/bin/python3", "-B", "-c", script, path], env=environment, check=True,
                                capture_output=True, text=True).stdout)


class Field:
    """Cells of a layer of hexahedra, by their centres x and z [m]."""

    def __init__(self, path, name):
        arrays = read_vtu(path)
        planes = [sorted({round(place, 12) for place in arrays["Points"][axis::3]}) for axis in range(3)]
        self.breadth = planes[1][-1] - planes[1][0]
        self.x, self.z = ([0.5 * (low + high) for low, high in zip(p, p[1:])] for p in (planes[0], planes[2]))
        self.edge = planes[0][1] - planes[0][0]
        self.values = {(x, z): arrays[name][i + len(self.x) * k] for k, z in enumerate(self.z) for i, x in enumerate(self.x)}

    def mean(self, wanted=lambda x, z: True):
        values = [value for place, value in self.values.items() if wanted(*place)]
        return sum(values) / len(values)


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

    def force_on_row(self, name, number, z):
        """That the row of cells about a height bears at one of the pictures, downwards [N]."""
        stress = Field(self.tmp / name / f"stress_{number:04d}.vtu", "stress_zz")
        return -sum(stress.values[x, z] for x in stress.x) * stress.edge * stress.breadth

    def check_weight(self, name, figures, tolerance):
        """At the start each row of cells bears the weight of the sand above its middle; from three grains below the level on,
        which tells nothing of the uppermost grains."""
        stress = Field(self.tmp / name / "stress_0000.vtu", "stress_zz")
        level, weight = figures["sand_level_m"], figures["sand_bulk_density_kg_m3"] * 9.81 * 0.024 * 0.0045
        deep = [z for z in stress.z if z < level - 3.5e-3]
        self.assertGreaterEqual(len(deep), 5)
        for z in deep:
            above = weight * (level - z)
            self.assertAlmostEqual(self.force_on_row(name, 0, z), above, delta=tolerance * above, msg=f"{name} at {z} m")
        for z in filter(lambda z: z > figures["sand_height_m"] + 1e-3, stress.z):
            self.assertLess(max(abs(stress.values[x, z]) for x in stress.x), 1e-9)


class Results(Case):
    SAND = 1555  # density of the settled sand in bulk [kg/m3]

    def test_two_scales_and_grains(self):
        """The same sand: what the pile meets and what the ground bears is alike."""
        command = self.command(self.tmp / "two")
        command.remove("--no-plots")
        self.check_success(subprocess.run(command, capture_output=True, text=True))
        for picture in ("resistance", "section", "fields", "chains", "energy"):
            self.assertTrue((self.tmp / "two" / "plots" / f"{picture}.png").exists())
        self.check_film(self.tmp / "two")
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
        # To what the start moves them by. What lies above the level holds the ground about the pile down.
        self.assertAlmostEqual(highest_point(self.tmp / "two" / "continuum_0000.vtu"), two["sand_level_m"], delta=0.05e-3)
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
        self.check_pile_in_fields(figures)

    def check_film(self, folder):
        """A frame of each picture, all of one size, and none unless asked for."""
        self.assertFalse((folder / "plots" / "film").exists())
        subprocess.run(["/usr/bin/python3", "-B", FOLDER / "plot.py", folder, "--film"], check=True, capture_output=True)
        sizes = [struct.unpack(">II", frame.read_bytes()[16:24]) for frame in sorted((folder / "plots/film").iterdir())]
        self.assertEqual(len(sizes), len(list(folder.glob("stress_*.vtu"))))
        self.assertEqual(len(set(sizes)), 1)
        self.assertEqual([length % 2 for length in sizes[0]], [0, 0])  # as films of most formats have it

    def check_pile_in_fields(self, figures):
        """Each row of cells below the tip bears what the pile is pressed with, through the overlap, too. The pressure has
        grown most of all there; the strongest contact is stronger; nothing is denser than grains can be."""
        for name in figures:
            folder = self.tmp / name
            start, end = (Field(folder / f"stress_000{n}.vtu", "pressure") for n in (0, 1))
            tip = figures[name]["sand_level_m"] - figures[name]["depth_m"]
            for z in filter(lambda z: z < tip - 2e-3, end.z):
                grown = self.force_on_row(name, 1, z) - self.force_on_row(name, 0, z)
                self.assertAlmostEqual(grown, figures[name]["head_resistance_N"],  # waves under way; the sand still swings
                                       delta=0.25 * figures[name]["head_resistance_N"], msg=f"{name} at {z} m")
            below = lambda x, z: abs(x) < 2e-3 and tip - 4e-3 < z < tip
            beside = lambda x, z: abs(x) > 8e-3 and tip - 4e-3 < z < tip
            self.assertGreater(end.mean(below), 2 * start.mean(below))
            self.assertGreater(end.mean(below), 2 * end.mean(beside))
            self.assertGreater(min(end.values.values()), -1e-9)
            grains, continuum = (Field(folder / "stress_0001.vtu", f"pressure_of_{part}") for part in ("grains", "continuum"))
            self.assertEqual(max(continuum.values.values()) > 0, name == "two")
            for place, pressure in end.values.items():
                self.assertAlmostEqual(grains.values[place] + continuum.values[place], pressure, delta=1e-9)
            self.assertGreater(min(Field(folder / "stress_0001.vtu", "deviatoric_stress").values.values()), -1e-9)
            fractions = [f for f in Field(folder / "solid_fraction_0001.vtu", "solid_fraction").values.values()
                         if not math.isnan(f)]
            self.assertLess(max(fractions), 0.8)
            self.assertEqual(min(fractions), 0)  # above the sand
            contacts, before = (read_vtu(folder / f"contacts_000{n}.vtu") for n in (1, 0))
            self.assertGreater(max(contacts["normal_force"]), max(before["normal_force"]))
            self.assertGreaterEqual(min(contacts["normal_force"]), 0)

    def test_no_pile(self):
        """Ground that is left alone stays where it is as that of grains alone does: the start is in equilibrium."""
        at_rest = ["Pile/speed=0", "Pile/time=4e-3", "Sand/Settling/time=0.1", f"Continuum/density={self.SAND}"]
        two, alone = self.figures("two", at_rest), self.figures("alone", at_rest + GRAINS_ALONE)
        self.assertEqual(two["pile_work_J"], 0)
        self.assertEqual(max(row["head_resistance_N"] for row in self.table("two")), 0)
        # Of a grain. Settled sand goes on swinging; the cut and the elements may add a thousandth.
        self.assertLess(alone["drift_over_grain"], 5e-3)
        self.assertLess(two["drift_over_grain"], alone["drift_over_grain"] + 1e-3)
        self.check_fields_at_rest(two, alone)

    def test_tiles(self):
        """Sand of two copies of a tile: as still without a pile as sand settled as a whole, it bears its weight, and a pile
        meets it, on two threads alike."""
        at_rest = ["Sand/tiles=2", "Pile/speed=0", "Pile/time=4e-3", "Sand/Settling/time=0.1",
                   f"Continuum/density={self.SAND}"]
        still = self.figures("still", at_rest)
        self.assertEqual(still["pile_work_J"], 0)
        self.assertLess(still["drift_over_grain"], 6e-3)  # as test_no_pile() has it
        self.check_weight("still", still, 0.06)
        self.assertLess(abs(still["sand_floor_share"] - 1), 0.1)
        figures = self.figures("pressed", ["Sand/tiles=2", *SHORT])
        self.check_balances(figures, self.table("pressed"))
        self.figures("again", ["Sand/tiles=2", *SHORT], "--threads", "2")
        self.assertEqual(self.table("again"), self.table("pressed"))

    def check_fields_at_rest(self, two, alone):
        """Ground that stands still bears its weight, inside of the overlap as well as outside."""
        self.assertAlmostEqual(alone["sand_bulk_density_kg_m3"], self.SAND, delta=0.02 * self.SAND)
        self.check_weight("alone", alone, 0.03)  # as well as it rests
        self.check_weight("two", two, 0.06)  # half of it elements, which go higher by 5 % and are the less dense
        # In the overlap neither model bears it alone. Columns of its cells at the sides, and its row at the bottom.
        block = {"side": lambda x, z: 4e-3 < abs(x) < 8e-3 and 6e-3 < z < 10e-3,
                 "bottom": lambda x, z: abs(x) < 4e-3 and 4e-3 < z < 6e-3}
        for place, inside in block.items():
            stress = Field(self.tmp / "two" / "stress_0000.vtu", "stress_zz")
            depth = two["sand_level_m"] - (8e-3 if place == "side" else 5e-3)
            weight = two["sand_bulk_density_kg_m3"] * 9.81 * depth
            self.assertAlmostEqual(-stress.mean(inside), weight, delta=0.1 * weight, msg=place)  # some ten grains a cell
            for part in ("pressure_of_grains", "pressure_of_continuum"):
                self.assertGreater(Field(self.tmp / "two" / "stress_0000.vtu", part).mean(inside), 0.1 * weight)
        # The same sand: where grains are alone, the same fields but for the step in which the block is cut out.
        own = lambda x, z: abs(x) < 4e-3 and z > 8e-3
        stress, expected = (Field(self.tmp / name / "stress_0000.vtu", "pressure") for name in ("two", "alone"))
        self.assertEqual(stress.values.keys(), expected.values.keys())
        greatest = max(expected.values.values())
        for cell in filter(lambda place: own(*place), expected.values):
            self.assertAlmostEqual(stress.values[cell], expected.values[cell], delta=0.01 * greatest)
        fraction, expected = (Field(self.tmp / name / "solid_fraction_0000.vtu", "solid_fraction") for name in ("two", "alone"))
        known = [cell for cell, value in fraction.values.items() if not math.isnan(value)]
        self.assertTrue(30 < len(known) < 0.6 * len(expected.values))
        for cell in known:
            self.assertAlmostEqual(fraction.values[cell], expected.values[cell], delta=1e-6)

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
        """A pile that its head's force drives: the force is as given, the pile goes down."""
        settings = ["Pile/drive=force", "Pile/head force=0.01", "Pile/time=0.02", "Output/samples=20"]
        figures, rows = self.figures("force", settings), self.table("force")
        for row in rows:
            self.assertAlmostEqual(row["head_resistance_N"], 0.01 * row["time_s"] / 0.02, delta=1e-5)
        self.assertGreater(rows[-1]["way_m"], 1e-4)
        self.assertGreater(rows[-1]["pile_work_J"], 0)
        self.assertLess(figures["energy_residual"], 1e-4)


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
        for file in ("history.csv", *FIELD_FILES, "stress.pvd"):
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
                               ("Sand/tiles=4", ("Sand/tiles is 4", "0.006 m", "choose fewer")),
                               ("Fields/sphere radius=3e-3", ("Fields/sphere radius is 0.003 m", "at most 0.00225")),
                               ("Fields/stress cell=0.03", ("Fields/stress cell is 0.03 m", "Sand/box, 0.024 m")),
                               ("Fields/spacing=1e-6", ("Fields/spacing", "more than a million cells")),
                               ("Coupling/penalty=-1", ("Coupling/penalty",)),
                               ("Continuum/Young's modulus=1e11", ("Pile/time step is 6e-06 s", "elements"))):
            with self.subTest(setting):
                self.assert_refused([setting], *words)

    def test_tiles_of_grains_alone(self):
        self.assert_refused(["Sand/tiles=2", *GRAINS_ALONE], "Sand/tiles is 2", "walls at its ends", "two-scale")

    def test_end_of_the_block(self):
        """A force that drives the pile through its grains: told by name, with a remedy."""
        self.assert_refused(["Pile/drive=force", "Pile/head force=2", "Pile/time=0.05", "Sand/Settling/time=0.02"],
                            "the pile has come to the end", "Model/block depth", status=1, writes=True)

    def test_parameter_files(self):
        """Every parameter file of the driver is read and valid, those that say "After X.prm Y.prm:" after them: refused is
        only the missing snapshot."""
        files = sorted(FOLDER.glob("*.prm"))
        self.assertGreaterEqual(len(files), 4)
        for prm in files:
            with self.subTest(prm.name):
                before = re.match(r"# After ((?:\S+\.prm )*\S+\.prm):", prm.read_text())
                given = [*(FOLDER / name for name in before[1].split()), prm] if before else [prm]
                result = self.run_driver(self.tmp / "none", (), "--restart", *map(str, given[1:]), file=given[0])
                self.assertEqual(result.returncode, 2, result.stderr)
                self.assertIn("snapshot", result.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[1:], verbosity=2)
