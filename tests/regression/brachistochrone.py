#!/usr/bin/env python3
"""The driver brachistochrone as a user runs it: spheres on facets against closed forms, restart after a kill, bad
input.

Usage: brachistochrone.py PROGRAM [TOPIC]
"""

import csv
import math
import signal
import subprocess
import sys
import unittest
from pathlib import Path

from driver_process import DriverCase, SNAPSHOTS_BY_STEPS, n_rows, renewal, stop_when

PROGRAM = Path(sys.argv.pop(1)).resolve()
FOLDER = Path(__file__).resolve().parents[2] / "drivers" / "brachistochrone"
SMOKE = FOLDER / "smoke.prm"

RUN, DROP, GRAVITY = 0.2, 0.1, 9.81
PLANE_TIME = math.sqrt(2 * (RUN**2 + DROP**2) / (GRAVITY * DROP))


def cycloid():
    """Radius of the rolling circle and its angle at the end, by bisection."""
    low, high = 1.0, 2 * math.pi
    for _ in range(100):
        middle = 0.5 * (low + high)
        is_before = (middle - math.sin(middle)) * DROP < (1 - math.cos(middle)) * RUN
        low, high = (middle, high) if is_before else (low, middle)
    return DROP / (1 - math.cos(low)), low


RADIUS, ANGLE = cycloid()
CYCLOID_TIME = ANGLE * math.sqrt(RADIUS / GRAVITY)
BEND = 0.5 * ANGLE  # of the whole way


def time_without_bounces(facets):
    """Of a point on the chords of the cycloid that loses at each edge the velocity normal to the chord to come."""
    places = [(RADIUS * (t - math.sin(t)), -RADIUS * (1 - math.cos(t)))
              for t in (ANGLE * k / facets for k in range(facets + 1))]
    speed = time = slope = 0
    for (x1, z1), (x2, z2) in zip(places, places[1:]):
        speed *= math.cos(math.atan2(z2 - z1, x2 - x1) - slope)
        slope = math.atan2(z2 - z1, x2 - x1)
        faster = math.sqrt(speed**2 + 2 * GRAVITY * (z1 - z2))
        time += 2 * math.hypot(x2 - x1, z2 - z1) / (speed + faster)
        speed = faster
    return time


class Case(DriverCase):
    program, parameters = PROGRAM, SMOKE

    def check_success(self, result):
        super().check_success(result)
        self.assertEqual(result.stderr, "")

    def slides(self, name):
        with open(self.tmp / name / "slides.csv", newline="") as file:
            return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]

    def assert_below(self, values, limit):
        self.assertTrue(all(0 <= value < limit for value in values), (values, limit))


class Results(Case):
    def test_sliding(self):
        """Plane within the dissertation's 5 um and cycloid within its 7 mm, section 4.3.2. The plane's deviation is the
        sphere's overlap, whatever its facets; the cycloid's falls with the square of their number down to that."""
        figures = self.figures("sliding")
        self.assertEqual(figures["facets"], [20, 40, 80, 160, 320])
        self.assertAlmostEqual(figures["plane_exact_travel_time_s"], PLANE_TIME, delta=1e-12)
        self.assertAlmostEqual(figures["cycloid_exact_travel_time_s"], CYCLOID_TIME, delta=1e-12)
        end_speed = math.sqrt(2 * GRAVITY * DROP)
        for quantity in ("distances_from_path_m", "x_differences_m", "z_differences_m"):
            plane, bent = figures[f"plane_{quantity}"], figures[f"cycloid_{quantity}"]
            self.assert_below(plane, 5e-6)
            self.assertLess(max(plane) - min(plane), 1e-10)  # triangles in one plane are the plane
            self.assert_below(bent, 7e-3)
        self.assert_below([abs(t - PLANE_TIME) * end_speed for t in figures["plane_travel_times_s"]], 5e-6)
        self.assert_below([t - CYCLOID_TIME for t in figures["cycloid_travel_times_s"]], PLANE_TIME - CYCLOID_TIME)

        self.assert_below(figures["cycloid_z_differences_m"][-1:], 5e-6)
        for order in figures["cycloid_z_difference_orders"][:3]:
            self.assertTrue(1.8 < order < 2.4, figures)
        self.assertTrue(all(order > 1.8 for order in figures["cycloid_distance_orders"][:3]), figures)
        times = figures["cycloid_travel_times_s"]
        self.assertEqual(times, sorted(times, reverse=True))
        self.assertEqual(figures["undecided_contacts"], 0)
        for slide in self.slides("sliding"):
            if not slide["cycloid"] or slide["facets"] <= 80:
                self.assertLess(slide["energy_residual"], 1e-11)  # rounding

    def test_energy_over_edges(self):
        """Where the sphere is on several facets and edges at once, the balance closes to third order in the step."""
        residuals = [self.figures(step, ["Track/facets=320", "Sphere/relaxation time=0", f"Output/time step={step}"])
                     ["energy_residual"] for step in ("8e-6", "4e-6")]
        self.assertLess(residuals[1], 1e-7)
        self.assertTrue(residuals[1] < 1e-11 or residuals[1] < residuals[0] / 6, residuals)

    def test_start(self):
        """It is at rest at time 0, whatever the step: travel times do not follow half a step of fall."""
        times = [self.figures(step, ["Track/facets=20", f"Output/time step={step}"])["plane_travel_times_s"][0]
                 for step in ("2e-6", "2e-5")]
        self.assertAlmostEqual(times[0], times[1], delta=1e-6)

    def test_bounces(self):
        """It bounces over long facets and not over those it passes faster than a contact lasts; without losses the time
        is of second order, too."""
        figures = self.figures("lossless", ["Sphere/relaxation time=0", "Track/facets=10, 20, 40, 80, 320"])
        for order in figures["cycloid_travel_time_orders"][:3]:
            self.assertTrue(1.9 < order < 2.4, figures)
        airborne = [slide["airborne_share"] for slide in self.slides("lossless") if slide["cycloid"]]
        self.assertGreater(airborne[0], 0.5)
        self.assertLess(airborne[-1], 1e-3)

    def test_without_bounces(self):
        """Critically damped and stiff, it stays on the chords and loses what is normal to them: the time is of first
        order, in closed form, and the distance that of chords of equal turns, 4 a BEND^2/(8 n^2)."""
        facets = [10, 20, 40]
        figures = self.figures("damped", ["Sphere/damping ratio=1", "Track/facets=" + ",".join(map(str, facets)),
                                          "Sphere/Young's modulus=1e10", "Output/time step=2e-6"])
        for n, time, distance in zip(facets, figures["cycloid_travel_times_s"],
                                     figures["cycloid_distances_from_path_m"]):
            late, expected = time - CYCLOID_TIME, time_without_bounces(n) - CYCLOID_TIME
            self.assertAlmostEqual(late / expected, 1, delta=0.01)
            self.assertAlmostEqual(distance / (0.5 * RADIUS * (BEND / n)**2), 1, delta=0.01)

    def test_rolling(self):
        """A sphere that rolls has two sevenths of its energy in the rotation. What deviates on the plane is the lever arm
        of friction, shorter by half of the overlap; on the cycloid it bounces on few facets and rolls on many."""
        figures = self.figures("rolling", ["Track/facets=160, 640", "Output/time step=4e-6"],
                               file=FOLDER / "rolling.prm")
        self.assertEqual(figures["model"], "rolling sphere")
        for curve, exact in (("plane", PLANE_TIME), ("cycloid", CYCLOID_TIME)):
            self.assertAlmostEqual(figures[f"{curve}_exact_travel_time_s"], math.sqrt(7 / 5) * exact, delta=1e-12)
        for quantity in ("distances_from_path_m", "x_differences_m", "z_differences_m"):
            self.assert_below(figures[f"plane_{quantity}"], 5e-6)
        self.assert_below(figures["cycloid_z_differences_m"], 1e-3)
        self.assert_below(figures["cycloid_z_differences_m"][1:], 1e-5)
        self.assert_below(figures["cycloid_x_differences_m"][1:], 2e-5)
        self.assertLess(figures["energy_residual"], 1e-6)

    def test_files(self):
        """A folder for each slide, with pictures of sphere and track; no stage shows a rate of none."""
        command = self.command(self.tmp / "files", ["Track/facets=20, 40"])
        command.remove("--no-plots")
        command.remove("--quiet")
        result = subprocess.run(command, capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertNotIn("  0 steps/s", result.stdout + result.stderr)
        self.assertTrue((self.tmp / "files" / "plots" / "brachistochrone.png").exists(), result.stderr)
        for curve in ("plane_20", "plane_40", "cycloid_20", "cycloid_40"):
            folder = self.tmp / "files" / "slides" / curve
            self.assertEqual(sorted(path.name for path in folder.iterdir()),
                             ["grains.pvd", "grains_0000.vtu", "grains_0001.vtu", "history.csv", "surfaces.pvd",
                              "surfaces_0000.vtu", "surfaces_0001.vtu"])
            self.assertEqual(n_rows(folder / "history.csv"), 51)

    def test_threads(self):
        for threads in ("1", "2"):
            self.figures(threads, ["Track/facets=40"], "--threads", threads)
        self.assertEqual(self.slides("1"), self.slides("2"))


class Restart(Case):
    def test_kill(self):
        """Killed in the first slide and stopped by Ctrl-C in a later one: the results are the same to the last bit."""
        settings = ["Track/facets=40, 320", "Output/time step=2e-5"]
        self.figures("whole", settings)
        parts = self.tmp / "parts"
        options = SNAPSHOTS_BY_STEPS
        for slide, send in (("plane_40", signal.SIGKILL), ("cycloid_40", signal.SIGINT)):
            has_snapshot = renewal(parts / "snapshot.h5")
            history = parts / "slides" / slide / "history.csv"
            stop_when(lambda: has_snapshot() and n_rows(history) > 10, self.command(parts, settings, *options), send)
            options = [*SNAPSHOTS_BY_STEPS, "--restart"]
        result = self.run_driver(parts, settings, *options)
        self.assertEqual(result.returncode, 0, result.stderr)
        for file in ("slides.csv", *(f"slides/{name}/history.csv" for name in
                                     ("plane_40", "plane_320", "cycloid_40", "cycloid_320"))):
            self.assertEqual((parts / file).read_text(), (self.tmp / "whole" / file).read_text(), file)


class BadInput(Case):
    def test_parameters(self):
        self.assert_refused(["Track/facets="], "Track/facets has no number")
        self.assert_refused(["Track/facets=10.5"], "Track/facets", "10.5", "whole")
        self.assert_refused(["Track/facets=20, 10"], "Track/facets", "10 follows 20")
        self.assert_refused(["Track/facets=0"], "Track/facets", "'0' is out of range")
        self.assert_refused(["Track/friction=0.1"], "Track/friction is 0.1", "slips", "0.142857")
        self.assert_refused(["Track/drop=0"], "Track/drop")
        self.assert_refused(["Sphere/radius=-1"], "Sphere/radius", "-1")
        self.assert_refused(["Output/time step=1e-30"], "Output/time step", "steps")

    def test_a_sphere_that_does_not_arrive(self):
        """Few facets take so much from it that it does not come up again to the end."""
        self.assert_refused(["Sphere/damping ratio=1", "Track/facets=2", "Track/horizontal distance=0.6"],
                            "has not reached the end", "Track/facets", status=1, writes=True)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[1:], verbosity=2)
