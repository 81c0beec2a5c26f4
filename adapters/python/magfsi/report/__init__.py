"""A run as one HTML page: robot, flow, curves, checks and where it comes from (docs/report.md)."""
