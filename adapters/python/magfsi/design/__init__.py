# SPDX-License-Identifier: GPL-2.0-or-later
"""Designs: the magnetisation that gives the shapes that are wanted. The module itself is a function.

    done = magfsi.design("letter.yaml", out="runs/letter", quantize=8)
    done.summary["poses"]["s"]["error"]       # mean distance, a share of the length
"""
import sys
import types


class _Design(types.ModuleType):
    def __call__(self, file, out=None, settings=None, *, quantize=None, overwrite=False, shown=False):
        """Searches the design of a file and writes the folder `out` (runs/design_NAME); goes on
        where an earlier call ended. settings: of the scene, {"path.to.key": text}. Returns its folder,
        its summary and both in words. Raises SceneError on bad input and Error where no design is
        found."""
        from pathlib import Path

        from magfsi.api import Error, SceneError
        from magfsi.design import work
        from magfsi.design.design_file import read_design
        from magfsi.study.marked import InputError

        try:
            wanted = read_design(file)
            wanted.sets |= settings or {}
            folder = Path(out) if out else Path("runs") / f"design_{wanted.name}"
            return work.design(wanted, folder, quantize, overwrite, shown)
        except InputError as error:
            raise SceneError(str(error)) from None
        except work.Lost as error:
            raise Error(str(error)) from None


sys.modules[__name__].__class__ = _Design
