"""By how much the ground about the pile differs between two runs over the same sand: motion of the grains, solid fraction
and pressure in the zone twice as wide and deep as the pile below its tip (Wellmann 6.4.3)."""

import numpy as np

from ground import Ground, numbers_of
from run_data import pictures_of, read_history

COLUMNS = ["way_mm", "displacement_percent", "solid_fraction_below_tip", "its_difference", "its_mean_square_difference",
           "pressure_percent", "pressure_mean_square_percent"]


def motions(folder, number):
    """How each grain has moved since the first picture, by id [m]."""
    first, now = (pictures_of(folder, "grains")[k] for k in (0, number))
    places = dict(zip(first.id.tolist(), first.position))
    return {i: place - places[i] for i, place in zip(now.id.tolist(), now.position) if i in places}


def rms(values):
    return np.sqrt(np.mean(np.square(values)))


def differences_at(folder, alone, number):
    """A row of COLUMNS at one picture: the ways of grains that both runs have, over those of the second one; solid fraction
    of the second run, and what the first one has more of it, in the mean and from place to place; the same of the
    pressure, over its mean."""
    own, other = motions(folder, number), motions(alone, number)
    common = sorted(own.keys() & other.keys())
    moved = rms([own[i] - other[i] for i in common]) / rms([other[i] for i in common])
    history, time = read_history(alone), pictures_of(alone, "grains")[number].time
    row = [1e3 * np.interp(time, history["time_s"], history["way_m"]), 100 * moved]
    grounds = [Ground(str(f), number) for f in (folder, alone)]
    for field in (Ground.solid_fraction, Ground.stress):
        x, z, of_alone = field(grounds[1])
        of_run = field(grounds[0])[2]
        across, upright = np.meshgrid(0.5 * (x[1:] + x[:-1]), 0.5 * (z[1:] + z[:-1]))
        below = grounds[1].tip() - upright
        width = 2 * grounds[1].pile_half_width()
        zone = (np.abs(across) < width) & (below > 0) & (below < 2 * width) & np.isfinite(of_run) & np.isfinite(of_alone)
        mean, difference = of_alone[zone].mean(), (of_run - of_alone)[zone]
        row += ([mean, difference.mean(), rms(difference)] if field is Ground.solid_fraction
                else [100 * difference.mean() / mean, 100 * rms(difference) / mean])
    return row


def all_differences(folder, alone):
    """A row at each picture after the first."""
    return [differences_at(folder, alone, number) for number in list(numbers_of(str(alone)))[1:]]
