# SPDX-License-Identifier: GPL-2.0-or-later
"""The colour maps of page, film and picture, from matplotlib: viridis for magnitudes, Moreland's
coolwarm, whose middle is grey, for what has two signs; for magnitudes of the flow, which is as large as
the view, one that begins at the colour of paper."""
import matplotlib
import numpy as np

MAPS = {"magnitude": "viridis", "signed": "coolwarm", "flow": "PuBu"}


def colour_table(kind):
    """(256, 3) from 0 to 255."""
    return np.round(255 * matplotlib.colormaps[MAPS[kind]](np.arange(256))[:, :3])
