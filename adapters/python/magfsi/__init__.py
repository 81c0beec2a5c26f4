"""What Python does in magfsi: studies, calibration, figures, and the runs of tests.

    ./magfsi python tutorials/swimmer/plot.py runs/swimmer     a script that imports this package
    ./magfsi python                                            a prompt where `import magfsi` works

The launcher and CTest put the package on PYTHONPATH. Modules that tests need take the standard
library only."""
