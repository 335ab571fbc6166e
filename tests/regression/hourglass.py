#!/usr/bin/env python3
"""The driver hourglass as a user runs it: flow and load, restart after a kill, bad input.

Usage: hourglass.py PROGRAM [TOPIC]
"""

import json
import signal
import subprocess
import sys
import unittest
from pathlib import Path

from driver_process import OneThreadCase, SNAPSHOTS_BY_STEPS, n_rows, renewal, stop_when

PROGRAM = Path(sys.argv.pop(1)).resolve()
SMOKE = Path(__file__).resolve().parents[2] / "drivers" / "hourglass" / "smoke.prm"


class Case(OneThreadCase):
    program, parameters = PROGRAM, SMOKE


class Results(Case):
    def test_flow(self):
        """The sand runs out at some flow of Beverloo's law; the glass bears nothing while all falls, and more than the
        weight where the first sand lands."""
        command = self.command(self.tmp / "sand")
        command.remove("--no-plots")
        result = subprocess.run(command, capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stderr, "")
        figures = self.figures("again", ["Discharge/last share=0.4"], "--threads", "2")  # the same on two threads
        history = self.table("sand", "history.csv")
        for one, other in zip(history, self.table("again", "history.csv")[:-1]):
            self.assertEqual(one, other)
        self.assertEqual(figures["undecided_contacts"], 0)
        self.assertLess(figures["energy_residual"], 5e-3)
        self.assertLess(figures["max_overlap_over_radius"], 0.1)
        self.assertLess(figures["time_step_s"], figures["stable_time_step_s"])
        self.assertTrue(0.8 < figures["mass_flow_kg_s"] / figures["usual_beverloo_flow_kg_s"] < 2, figures)
        self.assertTrue(0.5 < figures["bulk_density_kg_m3"] / 2650 < 0.7, figures)

        self.assertEqual(history[0]["load_over_weight"], 0)
        self.assertTrue(all(sample["load_over_weight"] < 1 for sample in history if sample["time_s"] < 0.02))
        self.assertGreater(max(sample["load_over_weight"] for sample in history), 1.2)
        weight = 9.81 * figures["mass_kg"]
        for sample in history:
            self.assertAlmostEqual(sample["load_over_weight"], -sample["glass_force_z_N"] / weight, delta=1e-9)
        masses = [sample["discharged_mass_kg"] for sample in history]
        self.assertEqual(masses, sorted(masses))
        self.assertTrue(0.95 <= masses[-1] / figures["mass_kg"] < 1, masses[-1])
        for picture in ("hourglass", "grains", "energy"):
            self.assertTrue((self.tmp / "sand" / "plots" / f"{picture}.png").exists())

    def test_narrow_neck(self):
        """A neck of hardly more than one grain is blocked, and the run ends by itself."""
        figures = self.figures("blocked", ["Glass/neck radius=0.5e-3", "Filling/bottom=1.5e-3",
                                           "Filling/solid fraction=0.2", "Discharge/patience=0.06"])
        self.assertIs(figures["stopped_by_itself"], True)
        self.assertLess(figures["discharged_mass_kg"], 0.5 * figures["mass_kg"])
        self.assertLess(figures["discharge_time_s"], 0.25)  # of 0.3


class Restart(Case):
    def test_kill(self):
        settings = ["Discharge/last share=0.2", "Steady flow/last share=0.2"]
        whole = self.figures("whole", settings)
        parts = self.tmp / "parts"
        options = SNAPSHOTS_BY_STEPS
        for rows, send in ((-1, signal.SIGINT), (5, signal.SIGKILL), (20, signal.SIGINT)):  # while it is packed, and twice in its flow
            has_snapshot = renewal(parts / "snapshot.h5")
            stop_when(lambda: has_snapshot() and n_rows(parts / "history.csv") > rows,
                      self.command(parts, settings, *options), send)
            options = [*SNAPSHOTS_BY_STEPS, "--restart"]
        result = self.run_driver(parts, settings, *options)
        self.assertEqual(result.returncode, 0, result.stderr)
        for file in ("history.csv", "mass_flow.csv"):
            self.assertEqual((parts / file).read_text(), (self.tmp / "whole" / file).read_text(), file)
        self.assert_same_results("parts", "whole")


class BadInput(Case):
    def test_parameters(self):
        for settings, *words in ((["Glass/chamber radius=3e-3"], "Glass/chamber radius is 0.003", "0.003 m"),
                                 (["Filling/height=0.1"], "Filling/height is 0.1 m", "Glass/cylinder height"),
                                 (["Steady flow/last share=0.05"], "Steady flow/last share is 0.05"),
                                 (["Glass/facets=2"], "Glass/facets"),
                                 (["Filling/bottom=6e-3"], "Filling/height is 0.005 m", "Filling/bottom, 0.006 m"),
                                 (["Output/time step=1e-30"], "Output/time step", "steps")):
            result = self.run_driver(self.tmp / "refused", settings)
            self.assertEqual(result.returncode, 2, result.stderr)
            for word in words:
                self.assertIn(word, result.stderr)
            self.assertEqual(result.stderr.count("error:"), 1, result.stderr)
            self.assertFalse((self.tmp / "refused").exists())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[1:], verbosity=2)
