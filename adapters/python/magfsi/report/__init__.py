# SPDX-License-Identifier: GPL-2.0-or-later
"""A run as one HTML page: robot, flow, curves, checks and where it comes from (docs/report.md)."""
