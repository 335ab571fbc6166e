"""Panels of the ground about the pile, each drawn into one pair of axes; for the pictures of a run and of its film."""

import numpy as np

LINES = "#666666"
PRESSURES = "YlOrRd"  # colours
FRACTIONS = (0.55, 0.7)  # of solid, that colours tell apart


def reach_of_grains(ground):
    """Half the width of the grains about the pile's axis [mm]."""
    return np.abs(np.concatenate(ground.outlines)[:, 0]).max()


def goes_far(ground):
    """Whether elements go on so far beyond the grains that pictures show those beside them alone."""
    return ground.elements and np.abs(np.concatenate(ground.elements.outlines)[:, 0]).max() > 2.5 * reach_of_grains(ground)


def frame(axes, ground, top):
    """What all panels share: equal scales, the pile, the height of the picture [mm]."""
    from matplotlib.patches import Polygon
    axes.figure.set_layout_engine("compressed")  # for axes of equal scales
    axes.add_patch(Polygon(ground.pile_outline(), facecolor="#D9D9D9", edgecolor="#222222", linewidth=1.2, zorder=3))
    axes.set_aspect("equal")
    axes.autoscale_view()
    axes.set_ylim(top=top)
    if goes_far(ground):
        reach = reach_of_grains(ground)
        axes.set_xlim(-1.5 * reach, 1.5 * reach)
        axes.set_ylim(bottom=np.concatenate(ground.outlines)[:, 1].min() - 0.5 * reach)
    axes.grid(False)
    axes.set_ylabel("z in mm")


def colour_bar(axes, shown, label):
    axes.figure.colorbar(shown, ax=axes, label=label, shrink=0.85)


def no_bar(axes):
    """Room for one, so that panels with and without are equally wide."""
    from matplotlib.cm import ScalarMappable
    axes.figure.colorbar(ScalarMappable(), ax=axes, label=" ", shrink=0.85).ax.set_visible(False)


def draw_both(axes, ground, values, colours, limits, width=0.2):
    """Grains and elements by a value each. @param values of the grains, of the elements. @return the grains"""
    from matplotlib.collections import PolyCollection
    if ground.elements:
        axes.add_collection(PolyCollection(ground.elements.outlines, array=values[1], cmap=colours, clim=limits,
                                           linewidths=2 * width, edgecolors=LINES))
    grains = PolyCollection(ground.outlines, array=values[0], cmap=colours, clim=limits, linewidths=width,
                            edgecolors=LINES)
    axes.add_collection(grains)
    return grains


def draw_bands(axes, ground, planes):
    """Bands of the height at first, which show how the ground has moved. @param planes between them [mm]"""
    band = lambda heights: np.digitize(heights, planes) % 2 + 0.5 * np.digitize(heights, planes) / len(planes)
    elements = band(ground.elements.height) if ground.elements else None
    draw_both(axes, ground, (band(ground.height), elements), "copper", (0, 1.5))


def bands_of(ground):
    """Heights between ten bands of the ground, in mm."""
    return np.linspace(0, ground.height.max(), 11)


def scaled(field, factor):
    return *field[:2], factor * field[2]


def draw_field(axes, field, colours, limits):
    """A field on a grid, white where it is below the limits. @param field planes across x and z, values, not a number
    where there are none"""
    from matplotlib import colormaps
    shown = axes.pcolormesh(*field[:2], np.ma.masked_invalid(field[2]), vmin=limits[0], vmax=limits[1], shading="flat",
                            cmap=colormaps[colours].with_extremes(under="white"))
    return shown


def draw_outlines(axes, ground, grains=True, width=0.25):
    """Grains and elements as thin lines."""
    from matplotlib.collections import PolyCollection
    shapes = list(ground.outlines if grains else []) + list(ground.elements.outlines if ground.elements else [])
    axes.add_collection(PolyCollection(shapes, facecolors="none", edgecolors="#AAAAAA", linewidths=width))


def draw_chains(axes, ground, greatest):
    """Contacts as lines whose width goes with the normal force. @param greatest with the widest line [N]"""
    from matplotlib.collections import LineCollection
    draw_outlines(axes, ground)
    branches, force = ground.chains()
    seen = force > 0.02 * greatest
    axes.add_collection(LineCollection(branches[seen], colors="#8B1A1A", capstyle="round",
                                       linewidths=4 * np.minimum(force[seen] / greatest, 1)))
