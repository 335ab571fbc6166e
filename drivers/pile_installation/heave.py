"""How far the ground beside the shaft has gone up or down, over its distance from the shaft, and how dense it is below the
tip (Wellmann 6.4.3)."""

import numpy as np

import panels
from run_data import COLOURS


def rise_beside(ground):
    """Of all grains in the plane and all elements that were at first between the height of the tip and the surface, and
    are beside the shaft now: distance from it, rise, both in mm."""
    half = ground.pile_half_width()
    distance, height, rise = np.abs(ground.centres[:, 0]) - half, ground.height, -ground.sinking
    if ground.elements:
        beyond = np.abs(ground.elements.centres[:, 0]) > np.abs(ground.centres[:, 0]).max()
        distance = np.append(distance, np.abs(ground.elements.centres[beyond, 0]) - half)
        height = np.append(height, ground.elements.height[beyond])
        rise = np.append(rise, ground.elements.rise[beyond])
    beside = (height > ground.tip()) & (distance > 0)
    return distance[beside], rise[beside]


def means(distance, values, step):
    """Mean and quartiles over steps of the distance, where there are three values and more. @return their middles, mean,
    lower, upper quartile"""
    bins = np.floor(distance / step).astype(int)
    rows = [(np.mean(distance[inside]), np.mean(values[inside]), *np.quantile(values[inside], (0.25, 0.75)))
            for inside in (bins == b for b in np.unique(bins)) if inside.sum() >= 3]
    return np.array(rows).reshape(-1, 4).T


def zero_of(x, y):
    """Where a line first comes from below to 0; nothing if it does not."""
    for k in range(1, len(x)):
        if y[k - 1] < 0 <= y[k]:
            return x[k - 1] - y[k - 1] * (x[k] - x[k - 1]) / (y[k] - y[k - 1])
    return None


def draw_heave(axes, ground, first):
    """Over the distance in mean grains; beside it the solid fraction below the tip. @param axes of both"""
    grain = ground.mean_grain
    distance, rise = rise_beside(ground)
    middle, mean, low, high = means(distance / grain, rise, 1)
    left, right = axes
    left.axhline(0, color="#999999", linewidth=0.8)
    left.fill_between(middle, low, high, color=COLOURS[4], alpha=0.3, linewidth=0, label="half of the ground")
    left.plot(middle, mean, color=COLOURS[0], label="mean")
    left.set_xlabel(f"distance from the shaft in grains of {grain:.2g} mm")
    left.set_ylabel("gone up by, in mm")
    if panels.goes_far(ground):
        left.set_xlim(right=2 * panels.reach_of_grains(ground) / grain)
    turn = zero_of(middle, mean)
    highest = middle[np.argmax(mean)] if len(middle) else 0
    left.set_title("ground beside the shaft" + (f": dragged down within {turn:.1f} grains, highest at {highest:.1f}"
                                                if turn else ""), loc="left", fontsize=10)
    left.legend(fontsize=8)
    draw_below_tip(right, ground, first)


def draw_below_tip(axes, ground, first):
    """Mean over the pile's width of the solid fraction at the start and at the end, over the depth below the tip."""
    for state, label, colour in ((first, "at the start", "#999999"), (ground, "at the end", COLOURS[0])):
        x, z, values = state.solid_fraction()
        middles = 0.5 * (z[1:] + z[:-1])
        under = np.abs(0.5 * (x[1:] + x[:-1])) < ground.pile_half_width()
        known = (middles < ground.tip()) & np.isfinite(values[:, under]).all(axis=1)
        axes.plot(values[known][:, under].mean(axis=1), ground.tip() - middles[known], color=colour, label=label)
    axes.invert_yaxis()
    axes.set_xlabel("solid fraction over the pile's width")
    axes.set_ylabel("below the tip, in mm")
    axes.legend(fontsize=8)
