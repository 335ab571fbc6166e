"""What the scripts of this folder share: reading a run's folder, the look of the diagrams, saving pictures."""

import csv
import json
import os
import sys

import numpy as np

# Colours that people with colour-blindness can tell apart (Okabe and Ito, 2008).
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#000000"]


def fail(message):
    sys.exit(f"error: {message}")


def read_history(folder):
    """The columns of history.csv."""
    return read_table(folder, "history.csv")


def read_table(folder, name):
    """The columns of a file by name, each an array with one number a row; an incomplete last row is left out."""
    path = os.path.join(folder, name)
    try:
        with open(path, newline="") as file:
            lines = file.read().splitlines(keepends=True)
    except OSError as error:
        fail(f"{path}: {error.strerror}; name the folder of a run")
    rows = list(csv.reader(line for line in lines if line.endswith("\n")))
    if len(rows) < 2:
        fail(f"{path} has no samples yet")
    try:
        table = np.array(rows[1:], dtype=float)
    except ValueError as error:
        fail(f"{path} is damaged: {error}")
    return dict(zip(rows[0], table.T))


def read_summary(folder):
    """The figures of summary.json; none where the run is not at its end."""
    try:
        with open(os.path.join(folder, "summary.json")) as file:
            return json.load(file)
    except (OSError, ValueError):
        return {}


def read_parameters(folder):
    """The texts of parameters.prm by 'Section/name'; none where there is no such file."""
    values, sections = {}, []
    try:
        with open(os.path.join(folder, "parameters.prm")) as file:
            lines = [line.split("#")[0].strip() for line in file]
    except OSError:
        return {}
    for line in lines:
        if line.startswith("subsection "):
            sections.append(line[len("subsection "):].strip())
        elif line == "end" and sections:
            sections.pop()
        elif line.startswith("set ") and "=" in line:
            name, value = line[len("set "):].split("=", 1)
            values["/".join(sections + [name.strip()])] = value.strip()
    return values


def folder_name(folder):
    return os.path.basename(os.path.abspath(folder))


def model_of(folder):
    """The name of the model in a legend: the summary's "model", or the folder's name."""
    return str(read_summary(folder).get("model") or folder_name(folder))


def title_of(folder):
    """The title of a run's diagrams: its parameter named title, or else model and folder."""
    for path, value in read_parameters(folder).items():
        if path.split("/")[-1].lower() == "title" and value:
            return value
    model = read_summary(folder).get("model")
    return f"{model} – {folder_name(folder)}" if model else folder_name(folder)


def time_axis(time):
    """Times in a unit that suits their size, and that unit's name."""
    longest = np.nanmax(np.abs(time)) if len(time) else 0
    return (time * 1e3, "ms") if 0 < longest < 0.1 else (time, "s")


def new_diagram_look():
    """Light grid, no frame on top and right; needs no screen."""
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    pyplot.rcParams.update({
        "font.size": 11, "axes.titlesize": 12, "axes.spines.top": False, "axes.spines.right": False,
        "axes.grid": True, "grid.color": "#DDDDDD", "grid.linewidth": 0.6, "axes.axisbelow": True,
        "lines.linewidth": 1.6, "legend.frameon": False, "axes.formatter.useoffset": False})


def new_diagram(n_rows=1, height_ratios=None):
    """A figure and its axes one above the other, with one scale across, in the project's look."""
    new_diagram_look()
    from matplotlib import pyplot
    return pyplot.subplots(n_rows, 1, sharex=True, squeeze=False, figsize=(8.0, 4.8 if n_rows == 1 else 6.4),
                           gridspec_kw={"height_ratios": height_ratios or [1] * n_rows}, layout="constrained")


def new_panels(n_rows, n_columns):
    """A figure and its axes in rows and columns, each with scales of its own, in the project's look."""
    new_diagram_look()
    from matplotlib import pyplot
    return pyplot.subplots(n_rows, n_columns, squeeze=False, figsize=(5.6 * n_columns, 4.2 * n_rows),
                           layout="constrained")


def mark_stages(axes, time, columns):
    """A thin upright line where the run went from one stage to the next."""
    stages = columns.get("stage")
    if stages is not None:
        for i in np.flatnonzero(np.diff(stages)):
            axes.axvline(time[i + 1], color="#999999", linewidth=0.8, linestyle=(0, (2, 2)), zorder=0)


def picture_path(folder, name):
    """The path of a picture in the run's folder plots/, which is made, as a folder in the name is."""
    path = os.path.join(folder, "plots", name)
    plots = os.path.dirname(path)
    try:
        os.makedirs(plots, exist_ok=True)
    except OSError as error:
        fail(f"{plots}: {error.strerror}; the run's folder must be writable")
    return path


def save_diagram(figure, folder, name, dots_per_inch=150):
    """Saves a PNG whole or not at all, and prints its path."""
    path = picture_path(folder, name)
    part = path + ".part"
    try:
        figure.savefig(part, dpi=dots_per_inch, format="png")
        os.replace(part, path)
    except OSError as error:
        fail(f"{path}: {error.strerror}")
    print(path)
