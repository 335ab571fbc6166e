#!/usr/bin/env python3
"""The driver overlap_waves as a user runs it: pulses through an overlap beside closed forms, restart after a kill, bad
input.

Usage: overlap_waves.py PROGRAM [TOPIC]
"""

import math
import signal
import subprocess
import sys
import unittest
from pathlib import Path

from driver_process import OneThreadCase, SNAPSHOTS_BY_STEPS, n_rows, renewal, stop_when

PROGRAM = Path(sys.argv.pop(1)).resolve()
SMOKE = Path(__file__).resolve().parents[2] / "drivers" / "overlap_waves" / "smoke.prm"

RADIUS, PRESSURE, MODULUS, POISSON, DENSITY = 0.5e-3, 1e5, 50e9, 0.2, 2650
ALONE = "Column/kind=grains"
SHEAR = "Pulse/wave=shear"
FROM_CONTINUUM = "Pulse/from=continuum"


def largest_frequencies():
    """Of a chain of spheres under the pressure [1/s]: 2 sqrt(k / m) by Hertz' normal and Mindlin's tangential stiffness."""
    force = PRESSURE * (2 * RADIUS)**2  # but for the overlap, a share of 3e-4
    stiffness = 4 / 3 * MODULUS / (2 * (1 - POISSON**2)) * math.sqrt(RADIUS / 2)
    normal = 1.5 * stiffness**(2 / 3) * force**(1 / 3)
    mass = 4 / 3 * math.pi * RADIUS**3 * DENSITY
    return 2 * math.sqrt(normal / mass), 2 * math.sqrt(normal * 2 * (1 - POISSON) / (2 - POISSON) / mass)


def group_velocity(wave, length):
    """Over the speed of long waves; lengths in distances of grains. In a shear of displacement u and turn t a layer's
    contacts are stretched by 2 s u - c t, s and c sine and cosine of half the phase between layers, and those within it by
    t: 2x2 equations of motion, masses 1 and 2/5 of the radius squared."""
    def frequency(q):
        s, c = math.sin(q / 2), math.cos(q / 2)
        if wave == "compression":
            return 2 * s
        inertia = 0.4 * 0.25
        a, b, d = 4 * s * s, -2 * s * c / math.sqrt(inertia), (1 + c * c) / inertia
        return math.sqrt(a + d - math.sqrt((a - d)**2 + 4 * b * b))  # of the lower root, times sqrt(2)

    q, small = 2 * math.pi / length, 1e-4
    return (frequency(q + small) - frequency(q - small)) / (2 * small)


class Case(OneThreadCase):
    program, parameters = PROGRAM, SMOKE


class Results(Case):
    def check_pulse(self, figures):
        """A wave has as much energy of motion as it stores: by the leapfrog's velocities in the middle of steps, a share of
        1 / (1 + cos(w dt)). The account of all energies is closed."""
        half_turn = math.pi * figures["speed_m_s"] * figures["time_step_s"] / figures["wave_length_m"]  # of long waves
        self.assertAlmostEqual(figures["sent_kinetic_share"], 1 / (1 + math.cos(2 * half_turn)), delta=4e-4)
        self.assertLess(figures["energy_residual"], 1e-4)
        self.assertEqual(figures["undecided_contacts"], 0)

    def test_grains_alone(self):
        """Nothing comes back where there is no overlap; long waves have the speeds of Hertz and Mindlin: half of a shear
        turns the spheres, so their stiffness across is half."""
        compression, shear = largest_frequencies()
        for wave, speed in (("compression", RADIUS * compression), ("shear", RADIUS * shear / math.sqrt(2))):
            figures = self.figures("alone", [ALONE, f"Pulse/wave={wave}"], "--force")
            self.check_pulse(figures)
            self.assertLess(figures["reflected_share"], 1e-4)
            self.assertAlmostEqual(figures["gained_share"], 0, delta=1e-3)
            self.assertAlmostEqual(figures["speed_m_s"] / speed, 1, delta=1e-3)
            self.check_speed(figures, wave)

    def check_speed(self, figures, wave):
        """The middle of the energy moves with the group velocity."""
        rows = self.table("alone", "waves.csv")
        middles = []
        for time in sorted({row["time_s"] for row in rows})[2:]:
            layers = [row for row in rows if row["time_s"] == time]
            energy = sum(row["velocity_m_s"]**2 for row in layers)
            middles.append((time, sum(row["place_m"] * row["velocity_m_s"]**2 for row in layers) / energy))
        (start, top), (end, bottom) = middles[0], middles[-1]
        self.assertAlmostEqual((top - bottom) / (end - start) / figures["speed_m_s"], group_velocity(wave, 12), delta=3e-3)

    def test_overlap(self):
        """Waves of six elements, longer than the overlap, go through in both ways."""
        for name, settings in (("compression", []), ("shear", [SHEAR]), ("compression back", [FROM_CONTINUUM]),
                               ("shear back", [SHEAR, FROM_CONTINUUM])):
            with self.subTest(name):
                figures = self.figures(name, settings)
                self.check_pulse(figures)
                self.assertLess(figures["reflected_share"], 0.03)
                self.assertLess(figures["held_share"], 0.03)
                self.assertGreater(figures["transmitted_share"], 0.97)
                self.assertLess(figures["transmitted_share"], 1.03)

    def test_short_waves(self):
        """What the elements do not carry, less than three to a wave, comes back; the same wave in grains alone does not."""
        short = ["Pulse/wave length=5"]
        self.assertGreater(self.figures("short", short)["reflected_share"], 0.5)
        self.assertLess(self.figures("alone", [*short, ALONE])["reflected_share"], 0.01)
        self.assertLess(self.figures("fine", [*short, "Column/element size=1", "Column/overlap layers=4"])
                        ["reflected_share"], 0.03)

    def test_files_and_threads(self):
        command = self.command(self.tmp / "1")
        command.remove("--no-plots")
        self.check_success(subprocess.run(command, capture_output=True, text=True))
        for picture in ("waves", "energy"):
            self.assertTrue((self.tmp / "1" / "plots" / f"{picture}.png").exists())
        self.figures("2", [], "--threads", "2")
        for file in ("history.csv", "waves.csv"):
            self.assertEqual((self.tmp / "1" / file).read_text(), (self.tmp / "2" / file).read_text())


class Restart(Case):
    def test_kill(self):
        """Killed while the pulse is sent, and stopped by Ctrl-C on its way: the results are the same to the last bit."""
        self.figures("whole", [FROM_CONTINUUM])
        parts = self.tmp / "parts"
        options = SNAPSHOTS_BY_STEPS
        for rows, send in ((3, signal.SIGKILL), (12, signal.SIGINT)):
            has_snapshot = renewal(parts / "snapshot.h5")
            stop_when(lambda: has_snapshot() and n_rows(parts / "history.csv") > rows,
                      self.command(parts, [FROM_CONTINUUM], *options), send)
            options = [*SNAPSHOTS_BY_STEPS, "--restart"]
        self.check_success(self.run_driver(parts, [FROM_CONTINUUM], *options))
        for file in ("history.csv", "waves.csv"):
            self.assertEqual((parts / file).read_text(), (self.tmp / "whole" / file).read_text(), file)
        self.assert_same_results("parts", "whole")


class BadInput(Case):
    def test_parameters(self):
        for settings, words in (([FROM_CONTINUUM, "Pulse/wave length=5"], ("Pulse/wave length is 5", "Column/element size")),
                                (["Output/time step=1e-5"], ("Output/time step is 1e-05 s", "below")),
                                (["Column/width=2"], ("Column/width",)),
                                (["Grains/pressure=1e9"], ("Grains/pressure is 1e+09 Pa", "Young's modulus")),
                                (["Grains/Poisson's ratio=0"], ("Grains/Poisson's ratio is 0", "raise")),
                                (["Pulse/wave=surface"], ("Pulse/wave", "compression")),
                                (["Coupling/transfer time=0"], ("Coupling/transfer time",))):
            self.assert_refused(settings, *words)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[1:], verbosity=2)
