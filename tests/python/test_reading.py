"""Tables, parameters, figures and the state of a run, from folders written by hand."""

import fcntl
import os
import re
import subprocess
import unittest
from pathlib import Path
from unittest import mock

from small_runs import ROOT, FolderCase

import bergamo
import bergamo.lock

HISTORY = "time_s,stage,stress_xx_Pa,energy_kinetic_J\n0,1,-2.5,0\n0.5,1,-3,1e-3\n1,2,-1e5,nan\n"
PARAMETERS = """# A title
subsection Grains
  # means of the three half-axes [m]. Allowed: 3 numbers > 0, separated by
  # commas.
  set mean half-axes = 0.0005, 0.0004, 3e-04

  # of the uniform distribution; towards 0 a box, 1 an ellipsoid. Allowed: a
  # number > 0 and < 2. Usual: 0.2 to 1.8.
  set exponent       = 1     # default: 0.6

  subsection Clumps
    # how many. Allowed: a whole number >= 0.
    set parts = 3
  end
end


subsection Output
  # . Allowed: true or false.
  set pictures = true # default: false

  # of the diagrams. Allowed: one line of text without '#'.
  set title    = 7
end
"""


class Tables(FolderCase):
    def test_columns_by_name_with_units(self):
        table = bergamo.read_table(self.write("history.csv", HISTORY))
        self.assertEqual(table.n_rows, 3)
        self.assertEqual(table["stress_xx_Pa"].tolist(), [-2.5, -3, -1e5])
        self.assertEqual(table.units, {"time_s": "s", "stage": "", "stress_xx_Pa": "Pa", "energy_kinetic_J": "J"})
        self.assertEqual(table.array["stage"].tolist(), [1, 1, 2])
        self.assertEqual(table.array.shape, (3,))
        self.assertEqual(table.row(-2), {"time_s": 0.5, "stage": 1, "stress_xx_Pa": -3, "energy_kinetic_J": 1e-3})
        with self.assertRaises(bergamo.BadArgument):
            table.row(3)

    def test_a_row_that_is_being_written_is_left_out(self):
        for begun in ("1.5,2,-7", "1.5,2,-7e4,2.", "1"):
            self.assertEqual(bergamo.read_table(self.write("history.csv", HISTORY + begun)).n_rows, 3)
        self.assertEqual(bergamo.read_table(self.write("history.csv", "time_s,x_m\n0,")).n_rows, 0)

    def test_unknown_columns_name_the_nearest(self):
        table = bergamo.read_table(self.write("history.csv", HISTORY))
        for wrong, near in (("stress_x_Pa", "'stress_xx_Pa'"), ("kinetic", "'energy_kinetic_J'"),
                            ("kin", "'energy_kinetic_J'")):
            with self.assertRaises(KeyError) as caught:
                table[wrong]
            self.assertIn(f"no column '{wrong}'; did you mean {near}", str(caught.exception))
        self.assertNotIn("stress_x_Pa", table)

    def test_damaged_files_say_where(self):
        for text, words in ((HISTORY.replace("0.5,1,-3,1e-3", "0.5,1,-3"), ("line 3", "3 values", "4")),
                            (HISTORY.replace("-3", "-3x"), ("'-3x'", "line 3")), ("", ("does not begin",)),
                            ("time_s,x_m", ("does not begin",))):
            with self.assertRaises(bergamo.DamagedFile) as caught:
                bergamo.read_table(self.write("history.csv", text))
            for word in words:
                self.assertIn(word, str(caught.exception))
        with self.assertRaises(bergamo.MissingFile):
            bergamo.read_table(self.tmp / "nothing.csv")

    def test_frame_of_pandas_or_a_word_where_it_is_missing(self):
        table = bergamo.read_table(self.write("history.csv", HISTORY))
        with mock.patch.dict("sys.modules", {"pandas": None}), self.assertRaisesRegex(bergamo.MissingData, "python3-pandas"):
            table.frame()
        with mock.patch.dict("sys.modules", {"pandas": mock.Mock(DataFrame=dict)}):
            self.assertEqual(list(table.frame()), table.names)

    def test_units_are_those_of_the_drivers(self):
        """Every figure that a driver sets with a unit has it in its name."""
        said = re.compile(r'set\("(\w+)",[^;]*?,\s*"([^"]*)"\);')
        found = {match for path in (ROOT / "drivers").glob("*/*.cc") for match in said.findall(path.read_text())}
        self.assertGreater(len(found), 40)
        for name, unit in found:
            self.assertEqual(bergamo.unit_of(name), {"°": "degree", "degrees": "degree"}.get(unit, unit), name)


class Parameters(FolderCase):
    def test_values_units_and_defaults(self):
        parameters = bergamo.read_parameters(self.write("parameters.prm", PARAMETERS))
        self.assertEqual(parameters["Grains"]["mean half-axes"], (5e-4, 4e-4, 3e-4))
        self.assertEqual(parameters["Grains/Clumps/parts"], 3)
        self.assertIs(type(parameters["Grains/exponent"]), float)
        self.assertIs(parameters["Output/pictures"], True)
        self.assertEqual(parameters["Output/title"], "7")
        self.assertEqual(parameters.unit("Grains/mean half-axes"), "m")
        about = parameters.about("Grains/exponent")
        self.assertEqual((about.default, about.text, about.unit, about.allowed, about.usual),
                         ("0.6", "1", "", "a number > 0 and < 2", "0.2 to 1.8"))
        self.assertEqual(about.explanation, "of the uniform distribution; towards 0 a box, 1 an ellipsoid")
        self.assertIsNone(parameters.about("Output/title").default)
        self.assertEqual(list(parameters.flat()), ["Grains/mean half-axes", "Grains/exponent", "Grains/Clumps/parts",
                                                   "Output/pictures", "Output/title"])

    def test_unknown_names(self):
        parameters = bergamo.read_parameters(self.write("parameters.prm", PARAMETERS))
        for name, near in (("Grains/exponents", "'Grains/exponent'"), ("exponent", "'Grains/exponent'"),
                           ("Grain", "'Grains'"), ("Grains/exponent/more", "'Grains/exponent'")):
            with self.assertRaisesRegex(bergamo.UnknownName, f"no parameter '{name}'; did you mean {near}"):
                parameters[name]
            self.assertNotIn(name, parameters)

    def test_damaged_files(self):
        for text, word in ((PARAMETERS.replace("subsection Clumps", ""), "ends a section"), (PARAMETERS[:-4], "has no end"),
                           (PARAMETERS.replace("set parts", "parts"), "line 13")):
            with self.assertRaisesRegex(bergamo.DamagedFile, word):
                bergamo.read_parameters(self.write("parameters.prm", text))

    def test_files_without_explanations(self):
        """Those of the drivers, whose values are what they look like."""
        files = list((ROOT / "drivers").glob("*/*.prm"))
        self.assertGreater(len(files), 30)
        for path in files:
            self.assertGreater(len(bergamo.read_parameters(path).flat()), 0, path)
        parameters = bergamo.read_parameters(ROOT / "drivers" / "penetration" / "smoke.prm")
        self.assertIs(type(parameters["Output/samples"]), int)


class Figures(FolderCase):
    def test_figures_with_units(self):
        summary = bergamo.read_summary(self.write("summary.json", '{"model": "sand", "mass_flow_kg_s": null, "steps": 7}'))
        self.assertEqual((summary["model"], summary["steps"]), ("sand", 7))
        self.assertNotEqual(summary["mass_flow_kg_s"], summary["mass_flow_kg_s"])  # infinite or undefined
        self.assertEqual(summary.units["mass_flow_kg_s"], "kg/s")
        with self.assertRaisesRegex(bergamo.UnknownName, "no figure 'step'; did you mean 'steps'"):
            summary["step"]

    def test_damaged_and_missing(self):
        for text in ('{"steps": ', "[1, 2]"):
            with self.assertRaises(bergamo.DamagedFile):
                bergamo.read_summary(self.write("summary.json", text))
        with self.assertRaisesRegex(bergamo.MissingFile, "at its end"):
            bergamo.read_summary(self.tmp / "no.json")


class Runs(FolderCase):
    def hold(self, folder):
        """The lock that a program holds on its folder."""
        descriptor = os.open(folder, os.O_RDONLY)
        fcntl.flock(descriptor, fcntl.LOCK_EX)
        return descriptor

    def test_state(self):
        """By the kernel's list of locks, and by asking where there is no such list; asking leaves no lock behind."""
        for kernel_list in (bergamo.lock.KERNEL_LIST, Path("/nowhere")):
            with mock.patch("bergamo.lock.KERNEL_LIST", kernel_list):
                history = self.write("run/history.csv", HISTORY)
                run = bergamo.open(history.parent)
                self.assertEqual(run.state, "interrupted")
                descriptor = self.hold(run.folder)
                self.assertEqual(run.state, "running")
                self.write("run/summary.json", "{}")
                self.assertEqual(run.state, "running")  # until the program has ended
                os.close(descriptor)
                self.assertTrue(run.is_finished)
                os.close(self.hold(run.folder))
                (run.folder / "summary.json").unlink()

    def test_folders_that_are_none(self):
        self.write("run_one/history.csv", HISTORY)
        for name, words in (("run_on", f"no such folder of a run; did you mean {self.tmp}/run_one?"),
                            ("run_one/history.csv", "a file, no folder"), ("no/where", f"no folder {self.tmp}/no either"),
                            ("", f"no folder of a run.*runs in it: {self.tmp}/run_one")):
            with self.assertRaisesRegex(FileNotFoundError, words):
                bergamo.open(self.tmp / name)

    def test_what_a_run_has_not(self):
        run = bergamo.open(self.write("run/parameters.prm", PARAMETERS).parent)
        with self.assertRaisesRegex(bergamo.MissingFile, "at its end"):
            run.summary
        with self.assertRaisesRegex(bergamo.MissingFile, "no snapshot"):
            run.snapshot()
        with self.assertRaisesRegex(bergamo.MissingFile, "history.csv"):
            run.history
        with self.assertRaisesRegex(bergamo.UnknownName, "no pictures of 'grains'"):
            run.pictures["grains"]
        with self.assertRaisesRegex(bergamo.UnknownName, "no table 'mould'"):
            run.tables["mould"]

    def test_runs_within_a_run(self):
        self.write("all/parameters.prm", PARAMETERS)
        self.write("all/previous_run/history.csv", HISTORY)
        self.write("all/samples/0001/history.csv", HISTORY)
        self.write("all/samples/0001/figures.csv", "n\n1\n")
        self.write("all/samples/0002/history.csv", HISTORY)
        run = bergamo.open(self.tmp / "all")
        self.assertEqual({path: inner.state for path, inner in run.runs.items()},
                         {"samples/0001": "finished", "samples/0002": "interrupted"})
        alone = bergamo.open(self.tmp / "all" / "samples" / "0002")
        self.assertEqual(alone.parameters["Grains/Clumps/parts"], 3)
        self.assertEqual(list(alone.tables), ["history"])
        self.assertEqual(run.previous.history.n_rows, 3)
        with self.assertRaisesRegex(bergamo.MissingFile, "runs within: samples/0001, samples/0002"):
            run.history

    def test_title(self):
        self.write("run/history.csv", HISTORY)
        run = bergamo.open(self.tmp / "run")
        self.assertEqual((run.title, run.model), ("run", "run"))
        self.write("run/summary.json", '{"model": "sand"}')
        self.assertEqual((run.title, run.model), ("sand – run", "sand"))
        self.write("run/parameters.prm", PARAMETERS)
        self.assertEqual(run.title, "7")


class PlotScripts(FolderCase):
    def test_they_find_the_package_in_the_checkout(self):
        """As a driver starts them: no variable of the environment, no byte code left."""
        self.write("run/history.csv", HISTORY.replace("nan", "2"))
        script = ROOT / "drivers" / "common" / "plots" / "energy.py"
        result = subprocess.run(["/usr/bin/python3", "-B", str(script), str(self.tmp / "run")], capture_output=True, text=True,
                                env={"PATH": "/usr/bin:/bin", "HOME": str(self.tmp)}, cwd=self.tmp)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertTrue((self.tmp / "run" / "plots" / "energy.png").exists())

    def test_they_say_what_is_wrong_in_one_line(self):
        self.write("run/history.csv", HISTORY.replace("-3", "-3x"))
        script = ROOT / "drivers" / "common" / "plots" / "energy.py"
        result = subprocess.run(["/usr/bin/python3", "-B", str(script), str(self.tmp / "run")], capture_output=True, text=True)
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stderr, r"\Aerror: .*'-3x' in line 3.*\n\Z")


if __name__ == "__main__":
    unittest.main()
