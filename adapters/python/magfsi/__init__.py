# SPDX-License-Identifier: GPL-2.0-or-later
"""magfsi from Python: scenes, runs and their results; studies, calibration, figures.

    ./magfsi python                                            a prompt where `import magfsi` works
    ./magfsi python tutorials/swimmer/plot.py runs/swimmer     a script that imports this package

    import magfsi
    run = magfsi.run("tutorials/strip")
    print(run.columns["strip.com_z[m]"][-1])

`help(magfsi.api)` has the rest. The launcher and CTest put the package on PYTHONPATH. Modules that
tests need take the standard library only."""
from magfsi import design
from magfsi.api import (Diverged, Error, Fields, Job, PartnerLost, Run, Scene, SceneError, load, run,
                        start)

__all__ = ["Diverged", "Error", "Fields", "Job", "PartnerLost", "Run", "Scene", "SceneError",
           "design", "load", "run", "start"]
