# SPDX-License-Identifier: GPL-2.0-or-later
"""A run drawn by VTK, as a picture (`./magfsi render`) or a film (`./magfsi film`), from the numbers
that its page holds (magfsi.report)."""
