# SPDX-License-Identifier: GPL-2.0-or-later
"""An OpenFOAM case around a strip that moves as recorded: a mesh of blocks that lies on the strip's
surface and deforms with it (dynamicMotionSolverFvMesh), the displacement of that surface at each time
step, and what stock pimpleFoam 1912 solves. Nothing of magfsi is in it."""
import math
import shutil
from pathlib import Path

import numpy as np

# Growth of the cells away from the strip, and along it from its edges: 1 + 0.72 / n and 1 + 0.6 / n with
# n cells in the thickness, so that meshes are finer copies of one another. These and the steps are those
# of a case that was run by hand (heaving plate: n = 6 and 9 differ by 1 % in the work).
GROWTH_AWAY, GROWTH_ALONG = 0.72, 0.6
STEPS_A_PERIOD = 800 / 6  # times n
CELLS_A_STEP = 0.2  # that the strip may move through the mesh's finest cells
SAMPLES = 600  # of the traction on the strip
SHAPING_STEPS = 60


def header(kind, name):
    return f"FoamFile {{ version 2.0; format ascii; class {kind}; object {name}; }}\n"


def expansion(length, first, count):
    """Last over first cell of `count` cells that grow by one factor and fill `length`."""
    low, high = 1.0, 2.0
    if first * count >= length:
        return 1.0
    for _ in range(200):
        ratio = 0.5 * (low + high)
        if ratio == 1.0 or first * (ratio**count - 1) / (ratio - 1) < length:
            low = ratio
        else:
            high = ratio
    return ratio**(count - 1)


def graded(length, first, growth):
    """(number of cells, last over first)."""
    count = max(2, round(math.log(1 + length * growth / first) / math.log(1 + growth)))
    return count, expansion(length, first, count)


class Rectangle:
    """The strip straight, with its sides along the axes: as the blocks are laid around it."""

    def __init__(self, recorded):
        from magfsi.witness.recorded import centre
        shape = recorded.at(0.0)
        corner = shape[recorded.corners]
        sides = np.linalg.norm(np.roll(corner, -1, axis=0) - corner, axis=1)
        self.length, self.thickness = sides[[0, 2]].mean(), sides[[1, 3]].mean()
        self.centre = centre(shape)
        along = 0.5 * (corner[1] + corner[2] - corner[0] - corner[3])
        angle = math.atan2(along[1], along[0])
        self.quarters = round(angle / (math.pi / 2))
        self.tilt = angle - self.quarters * math.pi / 2

    def turn(self, extra=0.0):
        angle = self.quarters * math.pi / 2 + extra
        return np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])

    def extent(self):
        lying = self.quarters % 2 == 0
        return np.array([self.length, self.thickness] if lying else [self.thickness, self.length])

    def shares(self, points):
        """Of points on the rectangle, as Recorded.share()."""
        x, y = ((points - self.centre) @ self.turn()).T  # by the transpose: turned back
        x, y = x / self.length + 0.5, y / self.thickness + 0.5
        side = np.argmin(np.abs([y, 1 - x, 1 - y, x]), axis=0)
        return side + np.clip(np.choose(side, [x, y, 1 - x, 1 - y]), 0, 1)


class Case:
    """folder: of the case; cells: in the thickness of the strip."""

    def __init__(self, folder, recorded, cells, end):
        self.folder, self.recorded, self.cells, self.end = Path(folder), recorded, cells, end
        self.box, self.rectangle = recorded.box, Rectangle(recorded)
        self.cell = self.rectangle.thickness / cells
        period = min(recorded.period() or end, end)
        fastest = np.linalg.norm(recorded.spline(recorded.time, 1), axis=2).max()
        step = min(period / (STEPS_A_PERIOD * cells), CELLS_A_STEP * self.cell / fastest)
        self.steps = math.ceil(end / step - 1e-6)
        self.step = end / self.steps
        self.every = max(1, self.steps // SAMPLES)
        self.count = 0  # of cells, once the blocks are laid

    def write(self, name, kind, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(header(kind, path.name) + text)

    def start(self):
        """All files but those of the motion."""
        shutil.rmtree(self.folder, ignore_errors=True)
        self._blocks()
        self._fields()
        self._constants()
        self._numerics()

    def _blocks(self):
        away, along = GROWTH_AWAY / self.cells, GROWTH_ALONG / self.cells
        lines, counts, gradings = [], [], []
        half = self.rectangle.extent() / 2
        for k in (0, 1):
            low, high = self.rectangle.centre[k] - half[k], self.rectangle.centre[k] + half[k]
            lines.append([0.0, low, high, self.box.size[k]])
            before, before_grade = graded(low, self.cell, away)
            after, after_grade = graded(self.box.size[k] - high, self.cell, away)
            if half[k] > self.rectangle.thickness:
                count, grade = graded(half[k], self.cell, along)
                middle, across = 2 * count, f"((0.5 0.5 {grade:.9g}) (0.5 0.5 {1 / grade:.9g}))"
            else:
                middle, across = self.cells, "1"
            counts.append([before, middle, after])
            gradings.append([f"{1 / before_grade:.9g}", across, f"{after_grade:.9g}"])
        self._block_mesh(lines, counts, gradings)
        self.count = sum(a * b for a in counts[0] for b in counts[1]) - counts[0][1] * counts[1][1]

    def _block_mesh(self, lines, counts, gradings):
        def vertex(i, j, k):
            return (k * 4 + j) * 4 + i
        vertices = "\n".join(f"({lines[0][i]:.12g} {lines[1][j]:.12g} {z:.12g})"
                             for z in (0.0, self.box.depth) for j in range(4) for i in range(4))
        names = [[f"{word}_{end}" for end in ("min", "max")] for word in self.box.words()]
        patches = {name: [] for pair in names for name in pair} | {"body": [], "planes": []}
        blocks = []
        for j in range(3):
            for i in range(3):
                if (i, j) == (1, 1):
                    continue
                corners = [vertex(a, b, k) for k in (0, 1)
                           for a, b in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))]
                blocks.append(f"hex ({' '.join(map(str, corners))}) ({counts[0][i]} {counts[1][j]} 1) "
                              f"simpleGrading ({gradings[0][i]} {gradings[1][j]} 1)")
                patches["planes"] += [corners[:4], corners[4:]]
                for ni, nj, face in ((i - 1, j, (0, 3, 7, 4)), (i + 1, j, (1, 2, 6, 5)),
                                     (i, j - 1, (0, 1, 5, 4)), (i, j + 1, (3, 2, 6, 7))):
                    face = [corners[c] for c in face]
                    if (ni, nj) == (1, 1):
                        patches["body"].append(face)
                    elif ni in (-1, 3):
                        patches[names[0][ni == 3]].append(face)
                    elif nj in (-1, 3):
                        patches[names[1][nj == 3]].append(face)
        self.sides = {names[k][e]: self.box.sides[k][e] for k in (0, 1) for e in (0, 1)}
        kinds = {name: "wall" if kind == "no_slip" else "symmetryPlane" for name, kind in self.sides.items()}
        kinds |= {"body": "wall", "planes": "empty"}

        def listed_faces(faces):
            return " ".join("(" + " ".join(map(str, face)) + ")" for face in faces)
        listed = "\n".join(f"    {name} {{ type {kinds[name]}; faces ({listed_faces(faces)}); }}"
                           for name, faces in patches.items())
        newline = "\n"
        self.write("system/blockMeshDict", "dictionary", f"scale 1;\nvertices\n(\n{vertices}\n);\nblocks\n(\n"
                   f"{newline.join(blocks)}\n);\nedges ();\nboundary\n(\n{listed}\n);\n")

    def _field(self, name, kind, dimensions, inside, wall, body):
        rows = [f"    {side} {{ {wall if what == 'no_slip' else 'type symmetryPlane;'} }}"
                for side, what in self.sides.items()]
        rows += [f"    body {{ {body} }}", "    planes { type empty; }"]
        text = "\n".join(rows)
        self.write(f"0/{name}", kind, f"dimensions {dimensions}; internalField uniform {inside};\n"
                   f"boundaryField\n{{\n{text}\n}}\n")

    def _fields(self):
        none = "(0 0 0)"
        self._field("pointDisplacement", "pointVectorField", "[0 1 0 0 0 0 0]", none,
                    f"type fixedValue; value uniform {none};",
                    f"type timeVaryingMappedFixedValue; mapMethod nearest; setAverage no; value uniform {none};")
        self._field("U", "volVectorField", "[0 1 -1 0 0 0 0]", none,
                    f"type fixedValue; value uniform {none};", f"type movingWallVelocity; value uniform {none};")
        self._field("p", "volScalarField", "[0 2 -2 0 0 0 0]", "0", *2 * ["type zeroGradient;"])

    def _constants(self):
        self.write("constant/transportProperties", "dictionary",
                   f"transportModel Newtonian; nu {self.box.viscosity:.12g};\n")
        self.write("constant/turbulenceProperties", "dictionary", "simulationType laminar;\n")
        # Cells near the strip move with it: the stiffness falls with the square of the distance.
        self.write("constant/dynamicMeshDict", "dictionary", """dynamicFvMesh dynamicMotionSolverFvMesh;
motionSolverLibs (fvMotionSolvers);
motionSolver displacementLaplacian;
displacementLaplacianCoeffs { diffusivity quadratic inverseDistance (body); }
""")

    def control(self, end, step, functions=False):
        """functions: forces in each step, traction on the strip at some."""
        every = self.every
        self.write("system/controlDict", "dictionary", f"""application pimpleFoam;
startFrom startTime; startTime 0; stopAt endTime; endTime {end:.12g};
deltaT {step:.15g}; adjustTimeStep no;
writeControl runTime; writeInterval {end:.12g}; writeFormat ascii; writePrecision 12; timePrecision 12;
runTimeModifiable no;
""" + (f"""functions
{{
    forces
    {{
        type forces; libs (forces); patches (body);
        rho rhoInf; rhoInf {self.box.density:.12g}; CofR (0 0 0);
        writeControl timeStep; writeInterval 1;
    }}
    shear
    {{
        type wallShearStress; libs (fieldFunctionObjects); patches (body);
        executeControl timeStep; executeInterval {every}; writeControl none;
    }}
    traction
    {{
        type surfaces; libs (sampling); interpolationScheme cell; surfaceFormat raw;
        fields (p wallShearStress);
        surfaces ( body {{ type patch; patches (body); interpolate no; triangulate no; }} );
        writeControl timeStep; writeInterval {every};
    }}
}}
""" if functions else ""))

    def _numerics(self):
        self.control(self.end, self.step)
        self.write("system/fvSchemes", "dictionary", """ddtSchemes { default backward; }
gradSchemes { default Gauss linear; }
divSchemes { default none; div(phi,U) Gauss linear; div((nuEff*dev2(T(grad(U))))) Gauss linear; }
laplacianSchemes { default Gauss linear corrected; }
interpolationSchemes { default linear; }
snGradSchemes { default corrected; }
fluxRequired { default no; p; pcorr; }
""")
        self.write("system/fvSolution", "dictionary", """solvers
{
    "(p|pcorr)" { solver GAMG; smoother GaussSeidel; tolerance 1e-8; relTol 0.001; }
    "(pFinal|pcorrFinal)" { solver GAMG; smoother GaussSeidel; tolerance 1e-9; relTol 0; }
    "U.*" { solver PBiCGStab; preconditioner DILU; tolerance 1e-10; relTol 0; }
    "cellDisplacement.*" { solver GAMG; smoother GaussSeidel; tolerance 1e-9; relTol 0; }
}
PIMPLE
{
    nOuterCorrectors 3; nCorrectors 2; nNonOrthogonalCorrectors 1;
    correctPhi yes; pRefCell 0; pRefValue 0;
}
""")

    def read_surface(self):
        """Once blockMesh has run: the points of the strip's faces, in the plane, and their shares."""
        from magfsi.witness import foam
        points, faces = foam.patch(self.folder, "body")
        self.numbers = np.unique(faces)
        self.on_strip = points[self.numbers]
        self.shares = self.rectangle.shares(self.on_strip[:, :2])
        # Edges of the strip's faces in the plane, by the number of the point in `on_strip`.
        at_bottom = points[:, 2] < 0.5 * self.box.depth
        place = {number: i for i, number in enumerate(self.numbers)}
        self.edges = np.array([[place[n] for n in face if at_bottom[n]] for face in faces])

    def surface(self, time, derivative=0):
        """Of the points on the strip (points, 2), as recorded."""
        return self.recorded.places(self.shares, self.recorded.at(time, derivative))

    def write_displacements(self, times, places):
        """places(time): of the points on the strip, which start at places(times[0])."""
        start = places(times[0])
        folder = self.folder / "constant/boundaryData/body"
        shutil.rmtree(folder, ignore_errors=True)
        # These tables have no header.
        folder.mkdir(parents=True)
        (folder / "points").write_text(_vectors(np.column_stack([start, self.on_strip[:, 2]])))
        for time in times:
            (folder / f"{time:.12g}").mkdir()
            moved = np.column_stack([places(time) - start, np.zeros(len(start))])
            (folder / f"{time:.12g}/pointDisplacement").write_text(_vectors(moved))

    def off_shape(self):
        """Largest distance of the straight strip from the shape at the start, in thicknesses."""
        return np.abs(self.surface(0.0) - self.on_strip[:, :2]).max() / self.rectangle.thickness

    def write_shaping(self):
        """From the straight strip to the shape of the start, in pseudo-time 0 to 1: it turns, bends."""
        r = self.rectangle
        straight = (self.on_strip[:, :2] - r.centre) @ r.turn()
        bent = (self.surface(0.0) - r.centre) @ r.turn(r.tilt)

        def places(s):
            return (straight + s * (bent - straight)) @ r.turn(s * r.tilt).T + r.centre
        self.write_displacements(np.linspace(0, 1, SHAPING_STEPS + 1), places)
        self.control(1.0, 1 / SHAPING_STEPS)

    def write_motion(self):
        self.write_displacements(self.step * np.arange(self.steps + 1), self.surface)


def _vectors(rows):
    lines = "\n".join(f"({a:.12g} {b:.12g} {c:.12g})" for a, b, c in rows)
    return f"{len(rows)}\n(\n{lines}\n)\n"
