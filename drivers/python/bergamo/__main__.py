"""Runs of Bergamo in a terminal: python3 -m bergamo show | watch | compare | export ..."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Sequence
from dataclasses import replace

from . import open_run
from .compare import check_columns, compare, draw
from .errors import Error
from .export import DEFAULT, KINDS, export, scene_of
from .run import Run
from .show import show
from .watch import Watch

FINISHED, INTERRUPTED, WRONG, STOPPED = 0, 1, 2, 130


def parser() -> argparse.ArgumentParser:
    whole = argparse.ArgumentParser(prog="python3 -m bergamo", description="Shows, watches, compares and exports runs of Bergamo.")
    commands = whole.add_subparsers(dest="command", required=True, metavar="COMMAND")
    one = commands.add_parser("show", help="what is in a run's folder")
    one.add_argument("run", metavar="RUN")
    two = commands.add_parser("watch", help="follow a run until it ends; status 1 where it was interrupted")
    two.add_argument("run", metavar="RUN")
    two.add_argument("--interval", type=float, default=1., metavar="SECONDS", help="between two looks (default 1)")
    two.add_argument("--columns", default="", metavar="A,B", help="of the history, to show (default: the first four)")
    two.add_argument("--page", action="store_true", help="show it in the browser of this machine instead, until Ctrl-C")
    two.add_argument("--port", type=int, metavar="N", help="of the page (default: any that is free)")
    three = commands.add_parser("compare", help="draw two runs over one another and print how they differ")
    three.add_argument("runs", nargs=2, metavar="RUN")
    three.add_argument("--output", default="comparison.png", metavar="PNG", help="default comparison.png")
    three.add_argument("--columns", default="", metavar="A,B", help="of the histories, to draw (default: all)")
    four = commands.add_parser("export", help="write grains and contacts for other programs")
    four.add_argument("source", metavar="RUN_OR_SNAPSHOT", help="folder of a run, or its snapshot.h5 or the like")
    four.add_argument("--as", dest="kinds", default=",".join(DEFAULT), metavar="A,B",
                      help=f"of {', '.join(KINDS)} (default {','.join(DEFAULT)})")
    four.add_argument("--output", default="export", metavar="FOLDER", help="default export")
    four.add_argument("--picture", type=int, metavar="N",
                      help="of a run, from 0, -1 the last (default: its snapshot, or else its last picture)")
    four.add_argument("--steps", type=int, metavar="N", help="points a quarter turn of surfaces and glyphs, even (default 6 "
                      "for surfaces, 4 for glyphs and for surfaces of more than 10000 grains)")
    return whole


def run_command(words: argparse.Namespace) -> int:
    columns = [name for name in getattr(words, "columns", "").split(",") if name]
    if words.command == "show":
        print(show(open_run(words.run)))
    elif words.command == "watch":
        if not words.interval > 0:
            raise Error(f"--interval is {words.interval}; give a number of seconds above 0")
        if words.port is not None and not words.page:
            raise Error(f"--port {words.port} is of the page; add --page")
        run, look = open_run(words.run), Watch(sys.stdout, words.interval, columns)
        if words.page:
            serve_page(run, look, words.port or 0)
            return FINISHED
        return FINISHED if look.follow(run) else INTERRUPTED
    elif words.command == "export":
        kinds = [kind for kind in words.kinds.split(",") if kind]
        scene = replace(scene_of(words.source, words.picture), steps=words.steps)
        files = export(scene, words.output, kinds)
        print(f"{scene.source}: {len(scene.grains)} grains at {scene.grains.time:.6g} s", *files, sep="\n  ")
    else:
        first, second = map(open_run, words.runs)
        check_columns((first, second), columns)
        print(compare(first, second))
        print(draw(first, second, words.output, columns))
    return FINISHED


def serve_page(run: Run, look: Watch, port: int) -> None:
    """Until Ctrl-C, which is how it ends."""
    from .page import Looks, PageServer  # only here: http.server costs some milliseconds
    with PageServer(Looks(run, look), port, look.interval) as server:
        print(f"{run.folder}: {server.address} (Ctrl-C ends it)", flush=True)
        try:
            server.serve_forever()
        except KeyboardInterrupt:
            print()


def main(arguments: Sequence[str] | None = None) -> int:
    try:
        return run_command(parser().parse_args(arguments))
    except BrokenPipeError:  # whoever reads has had enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return FINISHED
    except (Error, OSError) as error:
        print(f"error: {error}", file=sys.stderr)
        return WRONG
    except KeyboardInterrupt:
        print(file=sys.stderr)
        return STOPPED


if __name__ == "__main__":
    sys.exit(main())
