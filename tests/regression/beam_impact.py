#!/usr/bin/env python3
"""The driver beam_impact as a user runs it: a sphere on a beam beside Timoshenko's solution, restart after a kill, bad
input.

Usage: beam_impact.py PROGRAM [TOPIC]
"""

import csv
import math
import signal
import sys
import unittest
from pathlib import Path

from driver_process import DriverCase, SNAPSHOTS_BY_STEPS, n_rows, renewal, stop_when

PROGRAM = Path(sys.argv.pop(1)).resolve()
SMOKE = Path(__file__).resolve().parents[2] / "drivers" / "beam_impact" / "smoke.prm"

LENGTH, EDGE, RADIUS, VELOCITY = 0.307, 0.01, 0.02, 0.01
MODULUS, POISSON, DENSITY = 220e9, 0.3, 7960
MASS = 4 / 3 * math.pi * RADIUS**3 * DENSITY
FEW = "Closed form/modes=3"


class Modes:
    """Timoshenko's solution (1913) of three modes, by the leapfrog: sphere, modes and contact are springs and masses."""

    def __init__(self, step):
        self.step = step
        self.stiffness = 4 / 3 * MODULUS / (2 * (1 - POISSON**2)) * math.sqrt(RADIUS)
        inertia = MODULUS * EDGE**4 / 12 / (DENSITY * EDGE**2)
        self.squares = [(k * math.pi / LENGTH)**4 * inertia for k in (1, 3, 5)]
        self.of_force = 2 / (DENSITY * EDGE**2 * LENGTH)
        self.sphere, self.modes = [0, VELOCITY], [[0, 0] for _ in self.squares]

    def force(self):
        return self.stiffness * max(0, self.sphere[0] - self.beam())**1.5

    def beam(self):
        return sum(mode[0] for mode in self.modes)

    def advance(self):
        force = self.force()
        self.sphere[1] -= self.step * force / MASS
        self.sphere[0] += self.step * self.sphere[1]
        for mode, square in zip(self.modes, self.squares):
            mode[1] += self.step * (self.of_force * force - square * mode[0])
            mode[0] += self.step * mode[1]


class Case(DriverCase):
    program, parameters = PROGRAM, SMOKE

    def check_success(self, result):
        super().check_success(result)
        self.assertEqual(result.stderr, "")

    def history(self, name):
        with open(self.tmp / name / "history.csv", newline="") as file:
            return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]


class Results(Case):
    def check_impacts(self, figures, theory=""):
        """Two impacts, the second near 1.5 ms, and departure at 0.35 cm/s (section 4.3.1); what the sphere loses is what
        the contact gives."""
        begins, ends = figures[f"{theory}impact_begins_s"], figures[f"{theory}impact_ends_s"]
        self.assertEqual(len(begins), 2, figures)
        self.assertLess(begins[0], 2e-6)
        self.assertAlmostEqual(ends[0], 0.43e-3, delta=0.01e-3)
        self.assertAlmostEqual(0.5 * (begins[1] + ends[1]), 1.54e-3, delta=0.01e-3)
        departure = figures[f"{theory}departure_velocity_m_s"]
        self.assertAlmostEqual(departure, 0.35e-2, delta=0.01e-2)
        self.assertAlmostEqual(sum(figures[f"{theory}impact_impulses_N_s"]) / (MASS * (VELOCITY + departure)), 1,
                               delta=1e-4)

    def test_dissertation(self):
        """Ten elements of 27 nodes."""
        figures = self.figures("ten", file=SMOKE.parent / "beam_impact.prm")
        for theory in ("", "slender_", "thick_"):
            self.check_impacts(figures, theory)
        self.assertLess(figures["slender_sphere_deviation"], 0.01)
        self.assertLess(figures["slender_beam_deviation"], 0.02)
        self.assertLess(figures["energy_residual"], 1e-9)

    def test_bending_elements(self):
        figures = self.figures("bending")
        self.check_impacts(figures)
        self.assertLess(figures["thick_sphere_deviation"], 0.01)
        self.assertLess(figures["thick_beam_deviation"], 0.02)
        self.assertLess(figures["energy_residual"], 1e-9)

    def test_closed_form(self):
        """Another integration of the same modes, of second order; tenths of the driver's step."""
        figures = self.figures("modes", [FEW])
        rows = self.history("modes")
        fine = 10
        modes = Modes(figures["time_step_s"] / fine)
        n_steps, sphere, beam, force = 0, 0, 0, 0
        for row in rows:
            while n_steps < round(row["time_s"] / modes.step):
                modes.advance()
                n_steps += 1
            sphere = max(sphere, abs(modes.sphere[0] - row["slender_sphere_displacement_m"]))
            beam = max(beam, abs(modes.beam() - row["slender_beam_displacement_m"]))
            force = max(force, abs(modes.force() - row["slender_contact_force_N"]))
        self.assertLess(sphere, 1e-4 * 8e-6)
        self.assertLess(beam, 1e-3 * 8e-6)
        self.assertLess(force, 1e-2 * 10)

    def test_elements(self):
        """More elements come nearer to a beam that shears; the plain ones of 8 nodes do not bend."""
        deviations = [self.figures(n, [f"Beam/elements along={n}"])["thick_beam_deviation"] for n in ("6", "12", "20")]
        self.assertEqual(deviations, sorted(deviations, reverse=True))
        self.assertLess(deviations[2], 0.5 * deviations[1])
        plain = self.figures("plain", ["Beam/element=plain", "Beam/elements along=12"])
        self.assertGreater(plain["thick_beam_deviation"], 0.2)

    def test_threads(self):
        for threads in ("1", "2"):
            self.figures(threads, [FEW, "Output/duration=0.3e-3"], "--threads", threads)
        self.assertEqual(self.history("1"), self.history("2"))


class Restart(Case):
    def test_kill(self):
        """Killed, and stopped by Ctrl-C, both while they touch: the results are the same to the last bit."""
        settings = [FEW, "Output/duration=0.3e-3"]
        self.figures("whole", settings)
        parts = self.tmp / "parts"
        options = SNAPSHOTS_BY_STEPS
        for rows, send in ((5, signal.SIGKILL), (15, signal.SIGINT)):
            has_snapshot = renewal(parts / "snapshot.h5")
            stop_when(lambda: has_snapshot() and n_rows(parts / "history.csv") > rows,
                      self.command(parts, settings, *options), send)
            options = [*SNAPSHOTS_BY_STEPS, "--restart"]
        result = self.run_driver(parts, settings, *options)
        self.check_success(result)
        self.assertEqual((parts / "history.csv").read_text(), (self.tmp / "whole" / "history.csv").read_text())


class BadInput(Case):
    def test_parameters(self):
        for setting, words in (("Beam/elements along=7", ("Beam/elements along is 7", "even")),
                               ("Beam/edge=0", ("Beam/edge",)), ("Material/Poisson's ratio=0.5", ("Poisson",)),
                               ("Beam/element=cubic", ("Beam/element", "quadratic")),
                               ("Output/step share=1", ("Output/step share",))):
            self.assert_refused([setting], *words)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[1:], verbosity=2)
