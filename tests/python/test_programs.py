"""show, watch and compare as a user starts them, on folders written by hand."""

import fcntl
import io
import os
import subprocess
import unittest

import numpy as np
from small_runs import ROOT, FolderCase, run_of

import bergamo
from bergamo.compare import history_differences
from bergamo.watch import Watch

HANGS_AFTER = 120  # s, of a program that takes one
NAMES = "time_s,stage,force_N,zero_J"


def rows(count, factor=1., step=0.1):
    return "".join(f"{k * step!r},1,{factor * k ** 2!r},0\n" for k in range(count))


class Case(FolderCase):
    def program(self, *words):
        return subprocess.run(["/usr/bin/python3", "-B", "-m", "bergamo", *map(str, words)], capture_output=True, text=True,
                              env={**os.environ, "PYTHONPATH": str(ROOT / "drivers" / "python")}, cwd=self.tmp,
                              timeout=HANGS_AFTER)

    def write_run(self, name, count=11, factor=1., summary='{"model": "spring", "steps": 100, "stiffness": %r}', **more):
        self.write(f"{name}/history.csv", f"{NAMES}\n{rows(count, factor, **more)}")
        self.write(f"{name}/parameters.prm",
                   f"subsection Output\n  set samples = 10\n  set factor = {factor} # default: 1\nend\n")
        if summary:
            self.write(f"{name}/summary.json", summary % factor)


class Show(Case):
    def test_a_run_by_hand(self):
        self.write_run("one", factor=2.)
        self.write("one/strips.csv", "time_s,x_m\n0,1,2\n")
        result = self.program("show", "one")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        for line in (r"spring – one: finished", r"Output/factor +2.0 +\(default 1\)", r"stiffness +2", r"steps +100",
                     r"history +11 rows, 0 to 1 s: time_s, stage, force_N, zero_J", r"strips .*line 2 has 3 values"):
            self.assertRegex(result.stdout, line)
        self.assertNotIn("Output/samples", result.stdout)  # as by default

    def test_a_run_of_a_driver(self):
        result = self.program("show", run_of("silo_discharge"))
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        for line in (r"silo – .*: finished", r"filled_mass_kg +0\.0\d+ +kg", r"grains +3 +to 0\.\d+ s",
                     r"filled\.h5 +filled silo, 591 grains at", r"snapshot\.h5 .*no grains"):
            self.assertRegex(result.stdout, line)

    def test_a_folder_that_is_none(self):
        self.write_run("one")
        result = self.program("show", "on")
        self.assertEqual((result.returncode, result.stdout), (2, ""))
        self.assertEqual(result.stderr, "error: on: no such folder of a run; did you mean one?\n")


class Numpy(Case):
    def test_a_python_without_it_is_told_where_there_is_one(self):
        result = subprocess.run(["/usr/bin/python3", "-B", "-S", "-m", "bergamo"], capture_output=True, text=True, cwd=self.tmp,
                                env={**os.environ, "PYTHONPATH": str(ROOT / "drivers" / "python")})
        self.assertRegex(result.stderr.splitlines()[-1], "needs NumPy, which .*python3 has not; take Debian's")


class WatchARun(Case):
    """The clock is the test's: what happens between two looks is what sleep() does."""

    def follow(self, between, **options):
        """@param between what happens in each interval; @return whether the run was finished, and what was printed"""
        events, stream, now = iter(between), io.StringIO(), [0.]

        def sleep(seconds):
            now[0] += seconds
            next(events)()

        watch = Watch(stream, clock=lambda: now[0], sleep=sleep, **options)
        finished = watch.follow(bergamo.open(self.tmp / "one"))
        self.assertIsNone(next(events, None), "it ended before the run")
        return finished, stream.getvalue().splitlines()

    def hold(self):
        self.lock = os.open(self.tmp / "one", os.O_RDONLY)
        fcntl.flock(self.lock, fcntl.LOCK_EX)

    def append(self, text):
        with open(self.tmp / "one" / "history.csv", "a") as file:
            file.write(text)

    def end(self, *, finished):
        if finished:
            self.write("one/summary.json", '{"steps": 100, "wall_time_s": 75}')
        os.close(self.lock)

    def test_a_run_that_ends(self):
        self.write_run("one", count=0, summary=None)
        self.hold()
        finished, lines = self.follow([
            lambda: self.append("0.0,1,0.0,"),  # half a row
            lambda: self.append("0\n0.1,1,1.0,0\n"),
            lambda: self.append("0.2,1,4.0,0\n0.3,1,9.0,0\n0.4,"),
            lambda: None,
            lambda: self.append("1,16.0,0\n"),
            lambda: (self.append("0.5,1,25.0,0\n"), self.end(finished=True)),
        ], interval=2.)
        self.assertTrue(finished)
        self.assertEqual(lines, [
            "no samples yet",
            "t = 0.1 s  row 2 of about 10  force_N = 1  zero_J = 0",
            "t = 0.3 s  row 4 of about 10  6 s left  force_N = 9  zero_J = 0",  # 2 rows in 2 s
            "t = 0.3 s  row 4 of about 10  12 s left  force_N = 9  zero_J = 0",
            "t = 0.4 s  row 5 of about 10  10 s left  force_N = 16  zero_J = 0",
            "t = 0.5 s  row 6 of about 10  8 s left  force_N = 25  zero_J = 0",  # written as it ended
            "finished in 1 min 15 s: steps = 100",
        ])

    def test_a_history_that_begins_anew(self):
        """As with --force: another file of that name, of other columns."""
        self.write_run("one", count=3, summary=None)
        self.hold()

        def begin_anew():
            self.write("one/new.csv", "time_s,length_m\n" + "".join(f"{k},7\n" for k in range(20)))  # longer, too
            os.replace(self.tmp / "one" / "new.csv", self.tmp / "one" / "history.csv")

        _, lines = self.follow([begin_anew, lambda: self.end(finished=False)])
        self.assertIn("t = 0.2 s  row 3 of about 10  force_N = 4", lines[0])
        self.assertEqual(lines[1], "t = 19 s  row 20 of about 10  length_m = 7")

    def test_a_run_that_is_killed(self):
        self.write_run("one", count=3, summary=None)
        self.hold()
        finished, lines = self.follow([lambda: self.end(finished=False)], columns=["force_N"])
        self.assertFalse(finished)
        self.assertEqual(lines[-2:], ["t = 0.2 s  row 3 of about 10  force_N = 4", "interrupted"])

    def test_samples_of_an_ensemble(self):
        self.write_run("one", count=1, summary=None)
        (self.tmp / "one" / "history.csv").unlink()
        self.hold()
        for number in (1, 2):
            self.write(f"one/samples/000{number}/history.csv", f"{NAMES}\n{rows(number)}")
        self.write("one/samples/0001/figures.csv", "n\n1\n")
        os.utime(self.tmp / "one" / "samples" / "0001" / "history.csv", (1, 1))
        self.write("one/samples/0002/snapshot.h5", "")
        finished, lines = self.follow([lambda: self.end(finished=False)])
        self.assertEqual(lines[-2], "samples/0002  t = 0.1 s  row 2  1 of 2 runs within are finished  force_N = 1  zero_J = 0")
        self.assertEqual(lines[-1], "interrupted; --restart goes on with it")

    def test_the_program(self):
        self.write_run("one")
        result = self.program("watch", "one")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("finished: steps = 100", result.stdout)
        self.assertIn("force_N = 100", result.stdout)
        (self.tmp / "one" / "summary.json").unlink()
        self.assertEqual(self.program("watch", "one").returncode, 1)
        for words, text in ((["--columns", "forc_N"], "no column 'forc_N'; did you mean 'force_N'"),
                            (["--interval", "0"], "above 0")):
            result = self.program("watch", "one", *words)
            self.assertEqual(result.returncode, 2)
            self.assertRegex(result.stderr, f"\\Aerror: .*{text}.*\n\\Z")


class Compare(Case):
    def test_differences_at_other_times(self):
        """The second run has rows twice as often; between its rows it is a straight line, so at those of the first exact."""
        self.write_run("one", count=6)
        self.write("two.csv", NAMES + "\n" + "".join(f"{0.05 * k!r},1,{1.5 * (k / 2) ** 2!r},0\n" for k in range(9)))
        first, second = (bergamo.read_table(self.tmp / name) for name in ("one/history.csv", "two.csv"))
        found = {one.name: one for one in history_differences(first, second)}
        force = found["force_N"]
        self.assertAlmostEqual(force.largest, 0.5 * 16)  # at 0.4 s, where the second ends
        self.assertAlmostEqual(force.time, 0.4)
        self.assertAlmostEqual(force.relative, 0.5)
        self.assertEqual((force.first, force.second), (16, 24))
        self.assertEqual((found["zero_J"].largest, found["zero_J"].relative), (0, 0))
        one, two = (bergamo.Table({"time_s": np.array([0., 1.]), "place_m": np.array([-4., end])}) for end in (-2., -1.))
        self.assertEqual([(found.largest, found.relative) for found in history_differences(one, two)], [(1, 0.25)])
        later = bergamo.Table({"time_s": np.array([7., 8.]), "force_N": np.zeros(2)})
        with self.assertRaisesRegex(bergamo.MissingData, "no time in common"):
            history_differences(first, later)

    def test_the_program(self):
        self.write_run("one")
        self.write_run("two", factor=1.25)
        result = self.program("compare", "one", "two", "--output", "both.png")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        for line in (r"Output/factor +1.0 +1.25\n", r"stiffness +1 +1.25 +0.25 +\+25 %", r"steps +100 +100 +0 +\+0 %",
                     r"force_N +25 +25 % +1 +100 +125\n", r"zero_J +0 +0 %", r"both.png\n\Z"):
            self.assertRegex(result.stdout, line)
        self.assertEqual((self.tmp / "both.png").read_bytes()[:4], b"\x89PNG")
        self.assertFalse((self.tmp / "both.png.part").exists())

    def test_unfinished_runs_and_columns_that_are_not_there(self):
        self.write_run("one")
        self.write_run("two", summary=None)
        result = self.program("compare", "one", "two", "--columns", "force_N")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("two/summary.json", result.stdout)
        result = self.program("compare", "one", "two", "--columns", "force_N,froce_N", "--output", "no.png")
        self.assertEqual((result.returncode, result.stdout), (2, ""))
        self.assertIn("no column 'froce_N'; did you mean 'force_N'", result.stderr)
        self.assertFalse((self.tmp / "no.png").exists())
        self.write("two/history.csv", NAMES + "\n")
        self.assertIn("no samples yet", self.program("compare", "one", "two").stderr)


if __name__ == "__main__":
    unittest.main()
