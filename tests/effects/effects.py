"""The effects, and how each is taken out of a program and of a scene."""

from dataclasses import dataclass
from pathlib import Path

import magfsi_runs as magfsi
from variant import Removal

HERE = Path(__file__).resolve().parent


@dataclass(frozen=True)
class Case:
    """program: whose instructions are counted; absent: settings that take the effect out of
    the scene, with those that the scene has in common."""

    program: str
    scene: Path
    removal: Removal
    absent: dict
    coupled: bool = False


STRUCTURE_LIST = "structure/lammps/effects.inc"
FLUID_LIST = "fluid_lbm/effects.inc"
# Of outputs, by the program that writes them.
OUTPUTS = {"magfsi-structure": "adapters/lammps/effects",
           "magfsi-fluid-lbm": "adapters/fluids/effects"}
# Every effect that a solid can have but the one that is looked at.
SOLID = HERE.parent / "scenes/every_structure_effect.yaml"
FLUID = HERE / "still_fluid.yaml"
SHORT = {"time.end": "50 us"}
FEW_STEPS = {"time.end": "20 ms", "fluid.boundaries": "{x_min: periodic, x_max: periodic}"}
COUPLED = {"time.end": "0.2 ms"}
ON_GROUND = {"platform.point": "[0 mm, 0 mm, 0.11 mm]"}
SUMS = {"probes": "{every: 5 ms, fluid: [kinetic_energy, enstrophy]}",
        "output.fluid": "{every: 10 ms, fields: [velocity, vorticity]}"}

ONE_SUM = {"probes": "{every: 5 ms, fluid: [kinetic_energy]}"}


def solid(name, absent, *files, registry=None):
    return Case("magfsi-structure", SOLID, Removal(name, files, registry), {**SHORT, **absent})


def fluid(name, absent, *files, registry=None):
    return Case("magfsi-fluid-lbm", FLUID, Removal(name, files, registry),
                {**FEW_STEPS, **absent})


def both(name, absent, *files):
    """Each side of a coupled run."""
    return [Case(program, magfsi.SMALL, Removal(name, files), {**COUPLED, **absent}, True)
            for program in ("magfsi-structure", "magfsi-fluid-lbm")]


def output(name, absent, *more, alone=(), coupled=()):
    """Of the programs that write it, in a scene of their own and in a coupled one."""
    scenes = {"magfsi-structure": (SOLID, SHORT), "magfsi-fluid-lbm": (FLUID, FEW_STEPS)}
    cases = []
    for program in (*alone, *coupled):
        folder = OUTPUTS[program]
        removal = Removal(name, (f"{folder}/{name}/*", *more), f"{folder}.inc")
        beside = len(cases) >= len(alone)
        scene, settings = (magfsi.SMALL, COUPLED) if beside else scenes[program]
        cases.append(Case(program, scene, removal, {**settings, **absent}, beside))
    return cases


def listed(name, absent, *more):
    """more: files beside the folder that only the effect uses."""
    return [solid(name, absent, f"structure/lammps/effects/{name}/*", *more,
                  registry=STRUCTURE_LIST)]


def side(name):
    return [fluid(name, {}, f"fluid_lbm/effects/{name}/*", registry=FLUID_LIST)]


SCHEMES = "coupler/scheme/"
CHECKPOINTS = ("coupler/checkpoint/checkpoints.*", "coupler/checkpoint/stop_agreement.*")
STRUCTURE, THE_FLUID = ("magfsi-structure",), ("magfsi-fluid-lbm",)
BOTH = STRUCTURE + THE_FLUID
EFFECTS = {
    "viscosity": listed("viscosity", {"bodies.strip.material.viscosity": "null"},
                        "structure/lattice/viscosity.*"),
    "magnetic_field": listed("magnetic_field", {"magnetic_field": "null"}),
    "field_gradient": listed("field_gradient", {"magnetic_field.gradient": "null"},
                             "structure/magnetics/field_gradient.*"),
    "gravity": listed("gravity", {"gravity": "null"}),
    "drag": listed("drag", {"damping": "null"}),
    "platform": listed("platform", {"platform": "null"}),
    "friction": [solid("friction", {**ON_GROUND, "platform.friction": "null"})],
    "contact": listed("contact", {"contact": "null"}),
    "clamps": listed("clamps", {}),
    "rollers": listed("rollers", {}),
    "prescribed_motion": listed("prescribed_motion", {}),
    "immersed_boundary": [
        solid("immersed_boundary", {}, "adapters/lammps/body_*", SCHEMES + "fluid_*",
              "coupler/exchange/structure_exchange.*", "adapters/lammps/effects/record/*"),
        fluid("immersed_boundary", {}, SCHEMES + "*", "coupler/exchange/fluid_*",
              "coupler/immersed_boundary/fluid_side.*")],
    "buoyancy": both("buoyancy", {"gravity": "null"})[:1],
    "iterated_forcing": both("iterated_forcing", {},
                             "coupler/immersed_boundary/iterated_forcing.*"),
    "linear_velocity": both("linear_velocity", {})[:1],
    "parallel_scheme": both("parallel_scheme", {}),
    "implicit_scheme": both("implicit_scheme", {}, "adapters/lammps/body_iterations.*",
                            SCHEMES + "fixed_point.*", SCHEMES + "iqn_ils.*",
                            "fluid_lbm/streaming/kept_state.*"),
    "record": output("record", {}, "coupler/exchange/exchange_record.*",
                     coupled=STRUCTURE),
    "body_force": [fluid("body_force", {})],
    "eddy_viscosity": [fluid("eddy_viscosity", {}, "fluid_lbm/collision/smagorinsky.h")],
    "moving_wall": side("moving_wall"),
    "free_slip": side("free_slip"),
    "velocity_inlet": side("velocity_inlet"),
    "pressure_outlet": side("pressure_outlet"),
    "obstacles": [fluid("obstacles", SUMS, "fluid_lbm/obstacle/obstacles.*",
                        "fluid_lbm/obstacle/cut_links.*")],
    "probes": [*output("probes", {}, alone=THE_FLUID),
               *output("probes", {"probes": "null"}, alone=STRUCTURE, coupled=BOTH)],
    # Of probes beside others.
    "enstrophy": [fluid("enstrophy", ONE_SUM)],
    "plane_flow": [fluid("plane_flow", ONE_SUM, "fluid_lbm/sampling/plane_flow.*")],
    "body_forces": both("body_forces", {"probes.bodies": "[com]"})[:1],
    "interface_balance": both("interface_balance", {"probes.interface_balance": "null"}),
    "energy_audit": [solid("energy_audit", {}, "adapters/lammps/audit/*"),
                     *both("energy_audit", {}, "adapters/lammps/audit/*")],
    "structure_fields": output("structure_fields", {}, "adapters/bodies/structure_files.*",
                               alone=STRUCTURE, coupled=STRUCTURE),
    "fluid_fields": output("fluid_fields", {}, alone=THE_FLUID, coupled=THE_FLUID),
    "checkpoint": output("checkpoint", {}, *CHECKPOINTS, alone=BOTH, coupled=BOTH),
}

# Names that `explain` gives otherwise, and what no scene can be without.
CALLED = {"damping": ("drag",), "moving walls": ("moving_wall",),
          "inlets and outlets": ("velocity_inlet", "pressure_outlet")}
ALWAYS_THERE = ("elasticity", "fluid")


def of_explained(name):
    """The effects above that a name in the lists of `explain` stands for."""
    return CALLED.get(name, (name.replace(" ", "_"),))
