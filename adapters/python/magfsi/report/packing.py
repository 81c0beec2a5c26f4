# SPDX-License-Identifier: GPL-2.0-or-later
"""Numbers as text that a page holds."""
import base64

import numpy as np


def packed(array, kind):
    return base64.b64encode(np.ascontiguousarray(array, kind).tobytes()).decode()


def spread(count, most):
    """Indices of at most so many of them, first and last among them."""
    return sorted({round(i) for i in np.linspace(0, count - 1, min(count, most))})
