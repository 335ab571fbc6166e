#!/usr/bin/env python3
"""The driver strip_footing as a user runs it: limit loads against closed forms, threads, restart after a kill, bad
input.

Usage: strip_footing.py PROGRAM [TOPIC]
"""

import csv
import json
import os
import shlex
import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path

from driver_process import DriverCase, SNAPSHOTS_BY_STEPS, n_rows, renewal, stop_when

PROGRAM = Path(sys.argv.pop(1)).resolve()
FOLDER = Path(__file__).resolve().parents[2] / "drivers" / "strip_footing"
SMOKE = FOLDER / "smoke.prm"


# Sand of Janbu's law, m = 1, five times as stiff under the footing in the end as at the start.
STIFFENING = ["Ground/surcharge=10e3", "Continuum/friction angle=35", "Continuum/dilation angle=35",
              "Continuum/cohesion=1e3", "Continuum/reference pressure=100e3", "Continuum/stiffness exponent=1"]


class Case(DriverCase):
    program, parameters = PROGRAM, SMOKE


class Results(Case):
    def test_cohesive(self):
        """Prandtl's (2 + pi) c. Displacement elements give too much; with a mean dilatation they do not lock, and the
        half element beside the edge counts: some percent are left at three elements under half the footing."""
        figures = self.figures("cohesive")
        self.assertAlmostEqual(figures["limit_pressure_Pa"], (2 + 3.141592653589793) * 10e3, delta=1e-6)
        self.assertTrue(1.0 < figures["bearing_over_limit"] < 1.03, figures)
        self.assertLess(figures["energy_residual"], 1e-11)  # rounding of some thousand steps
        self.assertLess(figures["kinetic_over_elastic_energy"], 0.01)
        self.assertLess(figures["time_step_s"], figures["stable_time_step_s"])
        self.assertIn("set settlement", (self.tmp / "cohesive" / "parameters.prm").read_text())  # what it was run with
        with open(self.tmp / "cohesive" / "history.csv", newline="") as file:
            rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
        self.assertAlmostEqual(rows[-1]["settlement_m"], 0.03, delta=1e-4)
        self.assertLess(rows[-1]["footing_pressure_Pa"] / rows[-6]["footing_pressure_Pa"], 1.01)  # a plateau
        # Smooth, the limit is the same without weight; the edge is less sharp, so that the half element beside it, a
        # seventh of the footing's half, is known to its half only.
        smooth = self.figures("smooth", ["Footing/rough=false"])
        self.assertAlmostEqual(smooth["bearing_over_limit"], 1, delta=1 / 14)

    def test_bending_elements(self):
        """They hold no more than the strength either: what is stiff in them fades where the ground flows. Three of them
        under half the footing are some percent more above the limit, and the energy balance closes with their modes."""
        figures = self.figures("bending", ["Ground/bending elements=true"])
        self.assertTrue(1.0 < figures["bearing_over_limit"] < 1.09, figures)
        self.assertLess(figures["energy_residual"], 1e-11)
        with open(self.tmp / "bending" / "history.csv", newline="") as file:
            pressure = [float(row["footing_pressure_Pa"]) for row in csv.DictReader(file)]
        self.assertLess(pressure[-1] / pressure[-6], 1.01)  # a plateau

    def test_large_strain(self):
        """At a settlement of some percent of the width the present shape tells little: the same limit within 5 %."""
        limits = [self.figures(f"large_{large}", [f"Ground/large strain={large}"]) for large in ("false", "true")]
        self.assertAlmostEqual(limits[1]["bearing_over_limit"] / limits[0]["bearing_over_limit"], 1, delta=0.05)
        self.assertNotEqual(limits[1]["bearing_over_limit"], limits[0]["bearing_over_limit"])
        self.assertLess(limits[1]["energy_residual"], 1e-6)

    def test_frictional(self):
        """c Nc + q Nq at 20 degrees, associated: above it, and nearer on the finer mesh."""
        deviations = []
        for elements in (2, 4):
            figures = self.figures(f"frictional_{elements}",
                                   [f"Ground/elements under half the footing={elements}", "Footing/loading time=3",
                                    "Footing/settlement=0.05", "Ground/width=3.5", "Ground/depth=2"],
                                   file=FOLDER / "frictional.prm")
            self.assertLess(figures["start_out_of_balance"], 1e-12)
            deviations.append(figures["bearing_over_limit"] - 1)
        self.assertTrue(0 < deviations[1] < 0.14, deviations)
        self.assertLess(deviations[1], 0.8 * deviations[0])

    def test_flow_that_is_not_associated(self):
        """Compared with Davis' reduced strength: at 30 and 0 degrees tan phi and c times cos 30. Its history wanders."""
        figures = self.figures("davis", ["Continuum/friction angle=30", "Continuum/dilation angle=0",
                                         "Ground/elements under half the footing=4", "Footing/loading time=3",
                                         "Footing/settlement=0.06"], file=FOLDER / "frictional.prm")
        self.assertAlmostEqual(figures["limit_pressure_Pa"], 226.3e3, delta=100)
        self.assertAlmostEqual(figures["limit_pressure_associated_Pa"], 334.7e3, delta=100)
        self.assertLess(figures["bearing_pressure_lowest_Pa"], figures["bearing_pressure_Pa"])
        self.assertGreater(figures["bearing_pressure_highest_Pa"], figures["bearing_pressure_Pa"])
        # This mesh gives 14 % too much with associated flow, whose limit is 1.48 times as high.
        self.assertTrue(0.95 < figures["bearing_over_limit"] < 1.2, figures)

    def test_stiffness_by_pressure(self):
        """Ground whose stiffness grows with the pressure: the step follows, so its share is of no account (the step of
        the start would give a tenth of the pressure), and what the law has no potential for is seen."""
        bearing = []
        for share in (0.9, 0.3):
            figures = self.figures(f"share_{share}", [*STIFFENING, f"Output/step share={share}"])
            bearing.append(figures["bearing_pressure_Pa"])
            self.assertLess(figures["time_step_s"], 1.001 * share * figures["stable_time_step_s"])
            self.assertLess(figures["energy_residual"], 1e-11)
            self.assertTrue(0 < figures["stiffness_loss_over_footing_work"] < 0.5, figures)
            self.assertTrue(0 < figures["kinetic_over_elastic_energy"] < 0.01, figures)
        self.assertAlmostEqual(bearing[0] / bearing[1], 1, delta=0.01)
        self.assertGreater(bearing[0], 100e3)

    def test_ground_at_rest(self):
        """With weight and K0 the ground starts as it lies, and the footing's pressure at first is the surcharge."""
        figures = self.figures("rest", ["Ground/gravity=9.81", "Ground/surcharge=5e3", "Ground/earth pressure at rest=0.8",
                                        "Footing/settlement=1e-9", "Footing/loading time=0.2"])
        self.assertLess(figures["start_out_of_balance"], 1e-12)
        self.assertAlmostEqual(figures["bearing_pressure_Pa"], 5e3, delta=1)

    def test_layers(self):
        """Layers of one material are the homogeneous ground; a stronger layer below bears more."""
        for bending in ("false", "true"):
            with self.subTest(bending):
                self.check_layers(bending)

    def check_layers(self, bending):
        settings = ["Footing/loading time=0.5", "Footing/settlement=0.02", f"Ground/bending elements={bending}"]
        same = [f"Layer 2/{name}" for name in ("cohesion=10e3", "Young's modulus=20e6")]
        pressures = []
        for name, more in (("one", []), ("equal", ["Ground/layer depths=0.3", *same]),
                           ("strong", ["Ground/layer depths=0.3, 0.9", "Layer 2/cohesion=30e3", "Layer 3/cohesion=50e3"])):
            figures = self.figures(name + bending, settings + more)
            self.assertEqual("limit_pressure_Pa" in figures, name == "one")
            with open(self.tmp / (name + bending) / "history.csv", newline="") as file:
                pressures.append([row["footing_pressure_Pa"] for row in csv.DictReader(file)])
        self.assertEqual(pressures[0], pressures[1])
        self.assertGreater(float(pressures[2][-1]), 1.1 * float(pressures[0][-1]))

    def test_layers_at_rest(self):
        """Ground of layers of different weight lies still, on boundaries that hold and on quiet ones."""
        for far, bending in (("held", "false"), ("quiet", "false"), ("held", "true"), ("quiet", "true")):
            figures = self.figures(f"rest_{far}_{bending}", [f"Ground/bending elements={bending}", "Ground/gravity=9.81", "Ground/surcharge=5e3", "Ground/layer depths=0.4, 1",
                                                   "Layer 2/density=2300", "Layer 3/density=1500", "Footing/settlement=1e-9",
                                                   "Footing/loading time=0.2", f"Ground/far boundaries={far}"])
            self.assertLess(figures["start_out_of_balance"], 1e-12)
            self.assertAlmostEqual(figures["bearing_pressure_Pa"], 5e3, delta=1)

    def test_quiet_boundaries(self):
        """A fast push sends out waves: they leave, the energies close, and a footing that stands still then stands on
        ground that has come to rest sooner."""
        push = ["Footing/settlement=1e-4", "Footing/loading time=0.05", "Continuum/damping=0"]
        held, quiet = (self.figures(far, [*push, f"Ground/far boundaries={far}"]) for far in ("held", "quiet"))
        radiated = []
        for far in ("held", "quiet"):
            with open(self.tmp / far / "history.csv", newline="") as file:
                radiated.append([float(row["energy_radiated_J"]) for row in csv.DictReader(file)])
        self.assertEqual(set(radiated[0]), {0.0})
        self.assertGreater(radiated[1][-1], 0)
        self.assertEqual(radiated[1], sorted(radiated[1]))
        self.assertLess(quiet["energy_residual"], 1e-11)
        self.assertLess(quiet["bearing_pressure_Pa"], held["bearing_pressure_Pa"])

    def test_threads(self):
        one, two = self.figures("one", (), "--threads", "1"), self.figures("two", (), "--threads", "2")
        self.assertEqual((self.tmp / "one" / "history.csv").read_text(), (self.tmp / "two" / "history.csv").read_text())
        self.assertEqual(one["bearing_pressure_Pa"], two["bearing_pressure_Pa"])


    def test_plots(self):
        """Linear and quadratic elements can be drawn."""
        for degree in (1, 2):
            out = self.tmp / f"degree_{degree}"
            command = self.command(out, [f"Ground/element degree={degree}", "Footing/loading time=0.05",
                                         "Footing/settlement=1e-4"])
            command.remove("--no-plots")
            result = subprocess.run(command, capture_output=True, text=True)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertTrue((out / "plots" / "strip_footing.png").exists(), result.stderr)


class Sand(Case):
    """Hypoplastic sand, the ground of sand.prm coarse and fast."""

    COARSE = ["Ground/elements under half the footing=2", "Ground/width=2.5", "Ground/depth=1.5",
              "Footing/loading time=1", "Footing/settlement=0.05"]
    LOOSE = ["Continuum/Sand/void ratio=0.85", "Continuum/density=1430"]

    def sand(self, name, settings=(), *options):
        return self.figures(name, [*self.COARSE, *settings], *options, file=FOLDER / "sand.prm")

    def test_density(self):
        """Dense sand bears several times what loose sand does, and more than the critical friction of both would; the
        energies close although it stores none, and the ground starts as it lies."""
        dense, loose = self.sand("dense"), self.sand("loose", self.LOOSE)
        for figures in (dense, loose):
            self.assertLess(figures["start_out_of_balance"], 1e-9)
            self.assertLess(figures["energy_residual"], 1e-11)
            self.assertLess(figures["kinetic_energy_over_footing_work"], 0.01)
            self.assertNotIn("kinetic_over_elastic_energy", figures)
        # q Nq + gamma B Ngamma/2 of the critical friction, 33 degrees, by Davis' reduction 28.6: as gamma, but for q Nq.
        self.assertAlmostEqual(loose["limit_pressure_Pa"] / dense["limit_pressure_Pa"], 1430 / 1656, delta=0.05)
        self.assertGreater(dense["peak_pressure_Pa"], 3 * loose["peak_pressure_Pa"])
        self.assertGreater(dense["peak_pressure_Pa"], dense["limit_pressure_associated_Pa"])
        self.assertLess(loose["peak_pressure_Pa"], loose["limit_pressure_Pa"])
        # Loose sand has no peak.
        self.assertGreater(loose["peak_settlement_m"], 0.0495)

    def test_bending_elements(self):
        """With one law an element they bear somewhat more on this coarse mesh, and the energies close with their modes."""
        plain, bending = self.sand("plain"), self.sand("bending", ["Ground/bending elements=true"])
        self.assertLess(bending["start_out_of_balance"], 1e-9)
        self.assertLess(bending["energy_residual"], 1e-11)
        ratio = bending["peak_pressure_Pa"] / plain["peak_pressure_Pa"]
        self.assertTrue(1 < ratio < 1.15, ratio)

    def test_vibration(self):
        """Damped enough, neither rate nor damping matter; the law would lose stress to small vibrations."""
        slow = self.sand("slow", [*self.LOOSE, "Footing/loading time=2", "Continuum/damping=100"])
        fast = self.sand("fast", self.LOOSE)
        self.assertAlmostEqual(slow["bearing_pressure_Pa"] / fast["bearing_pressure_Pa"], 1, delta=0.05)
        faint = self.sand("faint", [*self.LOOSE, "Continuum/damping=1"])
        self.assertLess(faint["bearing_pressure_Pa"], 0.95 * fast["bearing_pressure_Pa"])

    def test_threads(self):
        for threads in ("1", "2"):
            self.sand(f"on_{threads}", ["Footing/loading time=0.1", "Footing/settlement=0.01"], "--threads", threads)
        self.assertEqual((self.tmp / "on_1" / "history.csv").read_text(), (self.tmp / "on_2" / "history.csv").read_text())

    def test_restart(self):
        """Killed after the peak, which vibration brings early: stresses, void ratios and the peak survive with the same
        bits."""
        settings = [*self.COARSE, *self.LOOSE, "Continuum/damping=0", "Footing/loading time=2"]
        file = FOLDER / "sand.prm"
        whole = self.figures("whole", settings, file=file)
        with open(self.tmp / "whole" / "history.csv", newline="") as rows:
            pressures = [float(row["footing_pressure_Pa"]) for row in csv.DictReader(rows)]
        peak = pressures.index(max(pressures))
        self.assertLess(peak, 0.9 * len(pressures))  # else this shows nothing of it
        parts = self.tmp / "parts"
        has_snapshot = renewal(parts / "snapshot.h5")
        stop_when(lambda: n_rows(parts / "history.csv") > peak + 3 and has_snapshot(),
                  self.command(parts, settings, *SNAPSHOTS_BY_STEPS, file=file))
        result = self.run_driver(parts, settings, *SNAPSHOTS_BY_STEPS, "--restart", file=file)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual((parts / "history.csv").read_text(), (self.tmp / "whole" / "history.csv").read_text())
        figures = json.loads((parts / "summary.json").read_text())
        for name in ("peak_pressure_Pa", "peak_settlement_m", "bearing_pressure_Pa"):
            self.assertEqual(figures[name], whole[name])

    def test_bad_input(self):
        for setting, words in {
                "Continuum/Sand/void ratio=0.4": ("initial_void_ratio = 0.4", "e_d ="),
                "Continuum/Sand/void ratio=1.04": ("initial_void_ratio = 1.04", "e_i ="),
                "Continuum/Sand/least pressure=5e3": ("Continuum/Sand/least pressure is 5000", "Ground/surcharge"),
                "Continuum/Sand/critical void ratio=0.5": ("critical_void_ratio = 0.5", "densest"),
                "Continuum/law=sand": ("Continuum/law", "hypoplastic sand"),
                "Continuum/Sand/compression exponent=1.2": ("compression exponent", "1.2")}.items():
            with self.subTest(setting):
                out = self.tmp / "refused"
                result = self.run_driver(out, [*self.COARSE, setting], file=FOLDER / "sand.prm")
                self.assertEqual(result.returncode, 2, result.stderr)
                self.assertEqual(result.stderr.count("error:"), 1, result.stderr)
                for word in words:
                    self.assertIn(word, result.stderr)
                self.assertFalse(out.exists())


class Restart(Case):
    def test_kill(self):
        self.check_kill(STIFFENING)

    def test_kill_of_bending_elements(self):
        self.check_kill([*STIFFENING, "Ground/bending elements=true"])

    def check_kill(self, settings):
        """Killed, and stopped by Ctrl-C: what it gives in the end is the same to the last bit, the step that follows the
        stiffness included."""
        self.figures("whole", settings)
        parts = self.tmp / "parts"
        options = SNAPSHOTS_BY_STEPS
        for rows, send in ((10, signal.SIGKILL), (20, signal.SIGINT)):
            has_snapshot = renewal(parts / "snapshot.h5")
            stop_when(lambda: has_snapshot() and n_rows(parts / "history.csv") > rows,
                      self.command(parts, settings, *options), send)
            options = [*SNAPSHOTS_BY_STEPS, "--restart"]
        result = self.run_driver(parts, settings, *options)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual((parts / "history.csv").read_text(), (self.tmp / "whole" / "history.csv").read_text())
        summaries = [json.loads((self.tmp / name / "summary.json").read_text()) for name in ("whole", "parts")]
        for name in ("bearing_pressure_Pa", "energy_residual", "stable_time_step_s", "time_step_s"):
            self.assertEqual(summaries[0][name], summaries[1][name])

    def test_kill_with_quiet_boundaries(self):
        """What they hold is in the snapshot: layered ground under its weight goes on as it would have."""
        settings = ["Ground/far boundaries=quiet", "Ground/layer depths=0.5", "Layer 2/density=2200", "Ground/gravity=9.81",
                    "Footing/loading time=0.3", "Footing/settlement=1e-3"]
        self.figures("whole", settings)
        parts = self.tmp / "parts"
        has_snapshot = renewal(parts / "snapshot.h5")
        stop_when(lambda: has_snapshot() and n_rows(parts / "history.csv") > 10,
                  self.command(parts, settings, *SNAPSHOTS_BY_STEPS), signal.SIGKILL)
        result = self.run_driver(parts, settings, *SNAPSHOTS_BY_STEPS, "--restart")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual((parts / "history.csv").read_text(), (self.tmp / "whole" / "history.csv").read_text())


class StaticStart(Case):
    def test_interrupt(self):
        """The first Ctrl-C ends it, once MPI runs: nothing is written yet that one could go on from."""
        out = self.tmp / "run"
        settings = ["Ground/gravity=9.81", "Ground/elements under half the footing=100"]  # a start of many seconds
        scratch = self.tmp / "scratch"
        scratch.mkdir()
        process = subprocess.Popen(self.command(out, settings), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                   env=os.environ | {"TMPDIR": str(scratch)})

        def catches_interrupts():
            status = Path(f"/proc/{process.pid}/status").read_text()
            return int(status.split("SigCgt:")[1].split()[0], 16) >> (signal.SIGINT - 1) & 1

        def has_mpi():
            return "mca_pml" in Path(f"/proc/{process.pid}/maps").read_text()  # the last of its parts to be loaded

        while process.poll() is None and not (catches_interrupts() and has_mpi()):
            time.sleep(0.001)
        process.send_signal(signal.SIGINT)
        _, stderr = process.communicate()
        self.assertEqual(process.returncode, -signal.SIGINT, stderr)
        self.assertIn("stopped", stderr)
        self.assertFalse(out.exists())
        self.assertEqual(list(scratch.iterdir()), [])  # nor does MPI leave anything


class Mpi(Case):
    def test_where_it_cannot_start(self):
        """One message with the remedy instead of MPI's own pages."""
        result = subprocess.run(["bash", "-c", f"ulimit -n 20; exec {shlex.join(self.command(self.tmp / 'run'))}"],
                                capture_output=True, text=True)
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
        for word in ("20 files", "ulimit -n 64"):
            self.assertIn(word, result.stderr)
        self.assertFalse((self.tmp / "run").exists())

    def test_without_a_folder_of_its_own(self):
        """It needs none."""
        result = subprocess.run(self.command(self.tmp / "run", ["Footing/loading time=0.02", "Footing/settlement=1e-5"]),
                                capture_output=True, text=True, env=os.environ | {"TMPDIR": "/proc/none"})
        self.assertEqual((result.returncode, result.stderr), (0, ""))


class BadInput(Case):
    def assert_refused(self, settings, *words, status=2):
        out = self.tmp / "refused"
        result = self.run_driver(out, settings)
        self.assertEqual(result.returncode, status, result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)
        self.assertEqual(result.stderr.count("error:"), 1, result.stderr)
        self.assertFalse(out.exists())  # nothing is written before the work

    def test_parameters(self):
        self.assert_refused(["Ground/width=0.8"], "Ground/width is 0.8", "Footing/width")
        self.assert_refused(["Footing/settlement=0.5"], "Footing/settlement is 0.5")
        self.assert_refused(["Continuum/cohesion=0"], "cohesion", "no strength")
        self.assert_refused(["Continuum/cohesion=0", "Continuum/friction angle=30"], "bears no footing",
                            "Continuum/cohesion", "Ground/surcharge", "Ground/gravity")
        self.assert_refused(["Output/step share=1.5"], "step share", "1.5")
        self.assert_refused(["Ground/element degree=3"], "element degree", "3")
        self.assert_refused(["Ground/element degree=2", "Ground/bending elements=true"], "bending elements", "degree is 2")

    def test_layers(self):
        self.assert_refused(["Ground/layer depths=0.5, 0.4"], "Ground/layer depths", "0.4 m follows 0.5 m")
        self.assert_refused(["Ground/layer depths=0.2, 0.4, 0.6, 0.8"], "Ground/layer depths has 4 depths", "Layer 4")
        self.assert_refused(["Ground/layer depths=5"], "material id 1", "no cell's centre")
        self.assert_refused(["Ground/layer depths=0.5, 0.501"], "material is given for the id 1", "no cell")
        self.assert_refused(["Ground/layer depths=0.5", "Layer 2/cohesion=-1"], "Layer 2", "cohesion")

    def test_numbers_that_overflow(self):
        """What would take more steps or elements than there are numbers is refused by the parameter's name."""
        self.assert_refused(["Footing/loading time=1e30"], "Footing/loading time is 1e+30 s", "steps")
        for setting in ("Ground/width=1e30", "Ground/depth=1e10", "Footing/width=1e-9"):
            with self.subTest(setting):
                self.assert_refused([setting, "Footing/settlement=1e-10"], "Ground/width", "Ground/depth",
                                    "more than can be numbered")

    def test_ground_that_cannot_rest(self):
        """K0 far from what the ground bears: refused with the place, before a file is written."""
        self.assert_refused(["Ground/gravity=9.81", "Ground/earth pressure at rest=0", "Continuum/cohesion=1e3"],
                            "initial stress at", "beyond the yield surface")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[1:], verbosity=2)
