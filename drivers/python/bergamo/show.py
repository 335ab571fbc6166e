"""What is in a run's folder, in short: `python3 -m bergamo show RUN`."""

from __future__ import annotations

from .errors import Error
from .run import Run
from .table import Table
from .text import aligned, short


def show(run: Run) -> str:
    """A text for a terminal; its state, parameters that are not the defaults, figures, tables, pictures, snapshots."""
    lines = [f"{run.title}: {run.state}", f"  {run.folder}"]
    for heading, content in (("Parameters that are not the defaults", changed_parameters(run)), ("Figures", figures(run)),
                             ("Tables", tables(run)), ("Pictures", pictures(run)), ("Snapshots", snapshots(run)),
                             ("Runs within", runs(run))):
        if content:
            lines += [heading, *content]
    return "\n".join(lines)


def changed_parameters(run: Run) -> list[str]:
    try:
        found = [parameter for parameter in run.parameters.flat().values() if parameter.default is not None]
    except Error as error:
        return [f"  {error}"]
    return aligned([parameter.path, f"{parameter.text} {parameter.unit}".strip(),
                    f"(default {parameter.default or 'empty'})"] for parameter in found)


def figures(run: Run) -> list[str]:
    if not (run.folder / "summary.json").exists():
        return []
    try:
        summary = run.summary
    except Error as error:
        return [f"  {error}"]
    return aligned([name, short(value), summary.units[name]] for name, value in summary.items())


def tables(run: Run) -> list[str]:
    rows = []
    for name in run.tables:
        try:
            rows.append([name, described(run.tables[name])])
        except Error as error:
            rows.append([name, str(error)])
    return aligned(rows)


def described(table: Table) -> str:
    span = ""
    if "time_s" in table and table.n_rows:
        span = f", {short(float(table['time_s'][0]))} to {short(float(table['time_s'][-1]))} s"
    names = ", ".join(table.names[:6]) + (f", ... ({len(table)} columns)" if len(table) > 6 else "")
    return f"{table.n_rows} rows{span}: {names}"


def pictures(run: Run) -> list[str]:
    rows = []
    for name in run.pictures:
        try:
            series = run.pictures[name]
            rows.append([name, str(len(series)), f"to {short(float(series.times[-1]))} s" if len(series) else ""])
        except Error as error:
            rows.append([name, "", str(error)])
    return aligned(rows, right=(1,))


def snapshots(run: Run) -> list[str]:
    rows = []
    for name in run.archives:
        try:
            snapshot = run.snapshot(name)
            has_grains = "dem/time" in snapshot
            content = f"{len(snapshot.grains)} grains at {short(snapshot.time)} s" if has_grains else "no grains"
            rows.append([name, f"{snapshot.kind}, {content}"])
        except (Error, ImportError) as error:
            rows.append([name, str(error)])
    return aligned(rows)


def runs(run: Run) -> list[str]:
    return aligned([path, inner.state] for path, inner in run.runs.items())
