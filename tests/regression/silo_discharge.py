#!/usr/bin/env python3
"""The driver silo_discharge as a user runs it: weights and masses that add up, flows, restart after a kill, bad input.

Usage: silo_discharge.py PROGRAM [TOPIC]
"""

import json
import shutil
import signal
import subprocess
import sys
import unittest
from pathlib import Path

from driver_process import OneThreadCase, SNAPSHOTS_BY_STEPS, n_rows, renewal, stop_when

PROGRAM = Path(sys.argv.pop(1)).resolve()
SMOKE = Path(__file__).resolve().parents[2] / "drivers" / "silo_discharge" / "smoke.prm"
GRAVITY, DEPTH = 9.81, 0.01
SURFACES = ["left", "right", "front", "back", "floor"]


class Case(OneThreadCase):
    program, parameters = PROGRAM, SMOKE


class Results(Case):
    def test_weight_at_rest(self):
        """Floor and walls bear the weight and nothing else: forces and moments of grains at rest are in balance. What is
        left is the last bit of motion."""
        figures = self.figures("rest", ["Filling/rest share=1e-7", "Discharge/time=0.001"])
        rest = self.table("rest", "filling.csv")[-1]
        weight = GRAVITY * figures["filled_mass_kg"]
        names = [*SURFACES, "plug_1"]
        for axis, force in zip("xyz", (0, 0, -weight)):
            self.assertAlmostEqual(sum(rest[f"{name}_force_{axis}_N"] for name in names) / weight, force / weight,
                                   delta=0.01)
        on_floor = -(rest["floor_force_z_N"] + rest["plug_1_force_z_N"]) / weight
        self.assertAlmostEqual(figures["floor_share_of_weight"], on_floor, delta=1e-9)
        self.assertTrue(0.5 < on_floor < 1, on_floor)  # some hangs on the walls
        for name, axis, sign in (("left", "x", -1), ("right", "x", 1), ("front", "y", -1), ("back", "y", 1)):
            self.assertGreater(sign * rest[f"{name}_force_{axis}_N"], 0)
        # The weight of an even filling has no moment about the middle of the floor.
        for axis in "xyz":
            moment = sum(rest[f"{name}_moment_{axis}_Nm"] for name in names)
            self.assertLess(abs(moment), 0.05 * weight * 0.04)
        self.assertAlmostEqual(figures["bulk_density_kg_m3"] / 2500, 0.53, delta=0.05)  # narrow for its beads

    def test_discharge(self):
        """What has passed and what is left are all; the velocity field carries the mass that flows out."""
        figures = self.figures("silo")
        row, = self.table("silo", "discharges.csv")
        self.assertEqual(row["discharged_grains"] + row["grains_left"], figures["grains"])
        self.assertTrue(0.5 < row["discharged_mass_kg"] / figures["filled_mass_kg"] < 1, row)
        history = self.table("silo", "history.csv")
        masses = [sample["discharged_mass_kg"] for sample in history]
        self.assertEqual(masses, sorted(masses))
        self.assertEqual(masses[0], 0)
        self.assertAlmostEqual(masses[-1], row["discharged_mass_kg"], delta=1e-12)
        self.assertAlmostEqual(masses[-1] / row["discharged_grains"], figures["filled_mass_kg"] / figures["grains"],
                               delta=1e-6)
        flow, = figures["mass_flows_kg_s"]
        usual, = figures["usual_beverloo_flows_kg_s"]
        self.assertTrue(0.6 < flow / usual < 1.1, (flow, usual))
        self.assertTrue(0 < figures["mass_flow_deviations_kg_s"][0] < 0.3 * flow, figures)
        windows = self.table("silo", "mass_flow.csv")
        self.assertEqual(len(windows), 10)
        self.assertAlmostEqual(sum(window["mass_flow_kg_s"] for window in windows) / 10, flow, delta=1e-9)
        for time, share in ((windows[0]["begin_s"], 0.1), (windows[-1]["end_s"], 0.4)):
            before = max(sample["discharged_mass_kg"] for sample in history if sample["time_s"] <= time)
            after = min(sample["discharged_mass_kg"] for sample in history if sample["time_s"] >= time)
            self.assertTrue(before <= share * figures["filled_mass_kg"] <= after, (before, after))

        profile = self.table("silo", "profiles.csv")
        self.assertEqual({sample["height_m"] for sample in profile}, {0.015})
        through = sum(-0.5 * (a["velocity_z_m_s"] + b["velocity_z_m_s"]) * (b["x_m"] - a["x_m"]) * DEPTH
                      for a, b in zip(profile, profile[1:]))
        self.assertAlmostEqual(through * figures["bulk_density_kg_m3"] / flow, 1, delta=0.2)  # flowing grains are looser
        middle = min(sample["velocity_z_m_s"] for sample in profile)
        self.assertLess(middle, 2 * max(profile[0]["velocity_z_m_s"], profile[-1]["velocity_z_m_s"]))

        self.assertLess(figures["energy_residual"], 1e-3)  # half a step's work of what leaves while it is touched
        self.assertEqual(figures["undecided_contacts"], 0)
        self.assertLess(figures["max_overlap_over_radius"], 0.05)

    def test_several_orifices(self):
        """Each of the same filled silo, with a folder of its own; flows follow Beverloo's law."""
        figures = self.figures("several", ["Silo/orifice widths=0.012, 0.015, 0.018", "Discharge/last share=0.4",
                                           "Discharge/time=1"])
        flows = figures["mass_flows_kg_s"]
        self.assertEqual(flows, sorted(flows))
        self.assertTrue(0.5 < figures["beverloo_k"] < 3, figures)
        self.assertTrue(0.5 < figures["beverloo_c"] < 2, figures)
        self.assertLess(figures["beverloo_largest_relative_miss"], 0.1)
        folders = self.tmp / "several" / "discharges"
        self.assertEqual(sorted(path.name for path in folders.iterdir()), ["12mm", "15mm", "18mm"])
        starts = [self.table("several", "discharges", name, "history.csv")[0] for name in ("12mm", "15mm", "18mm")]
        for start in starts:
            self.assertEqual(start["time_s"], 0)
            self.assertEqual(start["energy_gravity_work_J"], 0)
        self.assertAlmostEqual(starts[0]["energy_kinetic_J"], starts[2]["energy_kinetic_J"], delta=1e-9)
        for mass in figures["discharged_masses_kg"]:
            self.assertAlmostEqual(mass / figures["filled_mass_kg"], 0.4, delta=0.05)  # it ends with a sample

    def test_narrow_orifice(self):
        """A slot that is hardly wider than a bead is blocked, and the discharge ends by itself."""
        figures = self.figures("blocked", ["Silo/orifice widths=0.004"])
        row, = self.table("blocked", "discharges.csv")
        self.assertEqual(row["stopped_by_itself"], 1)
        self.assertEqual(figures["mass_flows_kg_s"], [0])
        self.assertLess(figures["discharge_times_s"][0], 0.3)

    def test_files(self):
        command = self.command(self.tmp / "files", ["Discharge/last share=0.4"])
        command.remove("--no-plots")
        result = subprocess.run(command, capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, result.stderr)
        folder = self.tmp / "files"
        for name in ("discharge", "velocity", "grains"):
            self.assertTrue((folder / "plots" / f"{name}.png").exists(), result.stderr)
        for name in ("grains", "surfaces", "velocity"):
            self.assertTrue((folder / f"{name}_0001.vtu").exists())
            self.assertTrue((folder / f"{name}.pvd").exists())
        self.assertTrue((folder / "mean_velocity.vtu").exists())

    def test_threads(self):
        for threads in ("1", "2"):
            self.figures(threads, ["Discharge/last share=0.4"], "--threads", threads)
        self.assertEqual(self.table("1", "history.csv"), self.table("2", "history.csv"))


class Restart(Case):
    def test_kill(self):
        """Stopped before or while it is packed, killed while it is filled, and stopped by Ctrl-C in the steady flow of its second discharge, when grains have been
        taken away: the same to the last bit."""
        settings = ["Silo/orifice widths=0.015, 0.018", "Discharge/last share=0.4"]
        self.figures("whole", settings)
        parts = self.tmp / "parts"
        options = SNAPSHOTS_BY_STEPS
        for table, rows, send in (("filling.csv", -1, signal.SIGINT), ("filling.csv", 1, signal.SIGKILL),
                                  ("discharges/18mm/history.csv", 18, signal.SIGINT)):
            has_snapshot = renewal(parts / "snapshot.h5")
            stop_when(lambda: has_snapshot() and n_rows(parts / table) > rows,
                      self.command(parts, settings, *options), send)
            options = [*SNAPSHOTS_BY_STEPS, "--restart"]
        result = self.run_driver(parts, settings, *options)
        self.assertEqual(result.returncode, 0, result.stderr)
        whole = self.tmp / "whole"
        for file in ("filling.csv", "discharges.csv", *(f"discharges/{width}/{name}.csv" for width in ("15mm", "18mm")
                                                        for name in ("history", "profiles", "mass_flow"))):
            self.assertEqual((parts / file).read_text(), (whole / file).read_text(), file)
        self.assert_same_results("parts", "whole")
        picture = "discharges/18mm/mean_velocity.vtu"
        self.assertEqual((parts / picture).read_bytes(), (whole / picture).read_bytes())


class BadInput(Case):
    def test_parameters(self):
        self.assert_refused(["Silo/orifice widths="], "Silo/orifice widths has no number")
        self.assert_refused(["Silo/orifice widths=0.02, 0.01"], "0.01 follows 0.02")
        self.assert_refused(["Silo/orifice widths=0.04"], "0.04 m leaves no floor", "0.04 m")
        self.assert_refused(["Filling/expected solid fraction=0.3"], "Filling/expected solid fraction is 0.3", "0.4")
        self.assert_refused(["Steady flow/first share=0.5"], "Steady flow/last share is 0.4", "0.5")
        self.assert_refused(["Discharge/last share=0.2"], "Discharge/last share, 0.2")
        self.assert_refused(["Velocity field/cells=4.5, 1, 1"], "Velocity field/cells: 4.5 is no whole number")
        self.assert_refused(["Velocity field/profile heights=1"], "1 m is above the grid")
        self.assert_refused(["Output/time step=1e-30"], "Output/time step", "steps")

    def test_failures(self):
        self.assert_refused(["Filling/solid fraction=0.6"], "geometric packing got stuck", "Filling/solid fraction",
                            status=1, writes=True)
        shutil.rmtree(self.tmp / "refused")
        self.assert_refused(["Filling/longest time=0.07"], "have not come to rest after Filling/longest time", status=1,
                            writes=True)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[1:], verbosity=2)
