"""What the scripts of this folder share: a run's folder as the package bergamo reads it, errors for a terminal, saving
pictures in the run."""

import os
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "python"))
import bergamo
from bergamo.diagram import (COLOURS, mark_stages, new_diagram, new_diagram_look, new_panels, save_whole,  # noqa: F401
                             time_axis)


def fail(message):
    sys.exit(f"error: {message}")


def read_history(folder):
    """The columns of history.csv."""
    return read_table(folder, "history.csv")


def read_table(folder, name):
    """The columns of a file by name, each an array with one number a row; an incomplete last row is left out."""
    try:
        table = bergamo.read_table(os.path.join(folder, name))
    except bergamo.Error as error:
        fail(error)
    if table.n_rows == 0:
        fail(f"{table.path} has no samples yet")
    return table


def read_summary(folder):
    """The figures of summary.json; none where the run is not at its end."""
    try:
        return bergamo.read_summary(os.path.join(folder, "summary.json"))
    except bergamo.Error:
        return {}


def read_parameters(folder):
    """The texts of parameters.prm by 'Section/name'; none where there is no such file."""
    try:
        parameters = bergamo.read_parameters(os.path.join(folder, "parameters.prm"))
    except bergamo.MissingFile:
        return {}
    return {path: parameter.text for path, parameter in parameters.flat().items()}


def pictures_of(folder, name):
    """The series of pictures of this name, maybe an empty one."""
    pictures = bergamo.Pictures(Path(folder))
    return pictures[name] if name in pictures else bergamo.Series(name, [], [])


def folder_name(folder):
    return os.path.basename(os.path.abspath(folder))


def model_of(folder):
    """The name of the model in a legend: the summary's "model", or the folder's name."""
    return bergamo.open(folder).model


def title_of(folder):
    """The title of a run's diagrams: its parameter named title, or else model and folder."""
    return bergamo.open(folder).title


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
    try:
        save_whole(figure, path, dots_per_inch)
    except OSError as error:
        fail(f"{path}: {error.strerror}")
    print(path)
