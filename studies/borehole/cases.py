"""The cases of the study: which runs there are, and the deck of each."""
from __future__ import annotations

from dataclasses import dataclass, replace
from math import cos, pi, radians, sin
from pathlib import Path

from studies.common.christoffel import Stiffness
from studies.common.decks import Deck, overlaid, read_deck

DENSITY = 1000.0        # kg/m3
CAVITY_RADIUS = 1.0     # m
PROBE_RADIUS = 5.0      # m, section 5.1 of the paper
SNAPSHOT_TIME = 5e-3    # s
WINDOW_END = 8e-3       # s; the histories are compared from 0 to here, 1 ms before the runs end: more than 4 sigma
FILTER_FACTOR = 0.04    # sigma of the Gaussian filter = FILTER_FACTOR * (5 m)/c_P along alpha
DIRECTIONS = [7.5 * i for i in range(13)]      # degrees from the axis alpha, one quadrant
FRONT_RADII = [3.0, 4.0, 5.0, 6.0, 7.0, 8.0]   # m

# (19) to (23) of the paper, Pa.
CONSTANTS = {
    ("isotropic", 0.0): {"M_v": 0.0, "M_alpha": 1.0e9, "M_beta": 1.0e9, "M_psi": 1.0e9},
    ("anisotropic", 0.0): {"M_v": 0.0, "M_alpha": 1.0e9, "M_beta": 2.0e9, "M_psi": 1.0e9},
    ("isotropic", 0.25): {"M_v": 0.267e9, "M_alpha": 0.8e9, "M_beta": 0.8e9, "M_psi": 0.8e9},
    ("anisotropic", 0.25): {"M_v": 0.267e9, "M_alpha": 0.8e9, "M_beta": 1.6e9, "M_psi": 0.8e9},
}
MATERIALS = ["isotropic", "anisotropic"]
POISSON_RATIOS = [0.0, 0.25]

# Angle from x to alpha, rad. The paper shows its general field as a picture only: here folded bedding, whose direction
# swings over a few cavity radii. The turned field is the field itself turned by 45 degrees about the borehole,
# positions and directions: angle'(x') = angle(R^-1 x') + pi/4, with R^-1 x' = ((x + y), (y - x))/sqrt(2).
AXES = {
    "horizontal": 0.0,
    "turned": pi / 4,
    "general": "0.6*sin(0.5*x) + 0.4*cos(0.4*y)",
    "general_turned": "0.6*sin(0.5*(x + y)/sqrt(2)) + 0.4*cos(0.4*(y - x)/sqrt(2)) + pi/4",
}
TURN = {"horizontal": 0.0, "turned": pi / 4, "general": 0.0, "general_turned": pi / 4}  # rad
ROTATION_PAIRS = [("horizontal", "turned"), ("general", "general_turned")]


@dataclass(frozen=True)
class Case:
    """One run. `variant` changes something else than material, axes and mesh, see VARIANTS."""

    material: str
    nu: float
    axes: str
    sub_edge_mm: int
    variant: str = ""

    @property
    def name(self) -> str:
        parts = [self.material, f"nu{round(100 * self.nu):02d}", self.axes, f"{self.sub_edge_mm}mm"]
        return "-".join(parts + ([self.variant] if self.variant else []))

    @property
    def constants(self) -> dict[str, float]:
        return CONSTANTS[self.material, self.nu]

    @property
    def stiffness(self) -> Stiffness:
        return Stiffness.from_munjiza(**self.constants, density=DENSITY)

    @property
    def filter_sigma(self) -> float:
        """Standard deviation of the filter in time, s."""
        return FILTER_FACTOR * PROBE_RADIUS / float(self.stiffness.phase_speed(0.0))

    def of(self, **changes) -> "Case":
        return replace(self, **changes)


# What a variant lays over the deck. The fixed steps make runs comparable to round-off whose bounds on the step may
# differ in the last digit or, for CST, more; they are well below the stable step.
VARIANTS = {
    "": {},
    "1kPa": {"load": {"value": 1e3}},
    "direct": {"material": {"stress_map": "direct"}},
    "fixed_step": {},
    "hypo": {"material": {"form": "hypo"}},
    "cst": {"solid": {"element": "cst"}},
    "two_threads": {},
}
FIXED_STEP_VARIANTS = ["fixed_step", "hypo", "cst"]
FIXED_STEP_PER_SUB_EDGE = 0.3  # times sub-edge/c_P; about half of the stable step of a free mesh
THREADS = {"two_threads": 2}  # of the others: 1


def probe_name(radius: float, degrees: float) -> str:
    """Probe at `radius` (m) in a direction measured from the axis alpha of the unturned field."""
    return f"r{radius:g}_d{round(10 * degrees):03d}"


def probe_radii(case: Case) -> list[float]:
    """Radii with probes, m: all of FRONT_RADII where the front's speed is measured, else that of the histories."""
    return FRONT_RADII if case.axes == "horizontal" and not case.variant else [PROBE_RADIUS]


def probes(case: Case) -> list[dict]:
    """Probes over a quadrant that begins at alpha; they are turned together with the axes."""
    result = []
    for degrees in DIRECTIONS:
        angle = radians(degrees) + TURN[case.axes]
        for radius in probe_radii(case):
            result.append({"name": probe_name(radius, degrees), "at": [radius * cos(angle), radius * sin(angle)],
                           "about": [0.0, 0.0]})
    return result


def deck(case: Case, with_fields: bool = False) -> Deck:
    """The deck of a case. Its fields are written at SNAPSHOT_TIME if asked for: on fine meshes that takes a while."""
    edge = 2e-3 * case.sub_edge_mm
    changes = {
        "title": f"pressure step in a borehole: {case.name}",
        "mesh": {"radius": CAVITY_RADIUS, "size": [edge, edge]},
        "material": {"density": DENSITY, "constants": case.constants, "axes": {"angle": AXES[case.axes]}},
        "output": {"field_times": [SNAPSHOT_TIME] if with_fields else [], "probes": probes(case)},
    }
    if case.variant in FIXED_STEP_VARIANTS:
        changes["integrator"] = {"dt": FIXED_STEP_PER_SUB_EDGE * 0.5 * edge / fastest_speed(case)}
    base = read_deck(Path(__file__).with_name("borehole.toml"))
    return overlaid(overlaid(base, changes), VARIANTS[case.variant])


def fastest_speed(case: Case) -> float:
    """Largest phase speed over all directions, m/s: here along beta."""
    return float(max(case.stiffness.phase_speed(0.0), case.stiffness.phase_speed(pi / 2)))


@dataclass(frozen=True)
class Plan:
    """The runs of one extent of the study, by what they are for. A run may serve several purposes."""

    levels: tuple[int, ...]     # sub-edges of the refinement, mm, coarse to fine
    main: int                   # sub-edges of the 16 runs and of those at 1 kPa
    comparison: int             # sub-edges of the comparisons of formulations and threads
    small_load_cases: tuple[tuple[str, float], ...]  # materials that are run at 1 kPa

    def main_cases(self) -> list[Case]:
        return [Case(m, nu, axes, self.main) for m in MATERIALS for nu in POISSON_RATIOS for axes in AXES]

    def small_load_runs(self) -> list[Case]:
        return [Case(m, nu, axes, self.main, "1kPa") for m, nu in self.small_load_cases for axes in AXES]

    def refinement_cases(self) -> list[Case]:
        return [Case(m, nu, "horizontal", level) for level in self.levels for m in MATERIALS for nu in POISSON_RATIOS]

    def comparisons(self) -> dict[str, tuple[Case, Case]]:
        """Pairs of runs that differ in one thing; the second is the reference."""
        bent = Case("anisotropic", 0.25, "general", self.comparison)
        without_volume = Case("anisotropic", 0.0, "turned", self.comparison)
        return {
            "hypo_hyper": (bent.of(variant="hypo"), bent.of(variant="fixed_step")),
            "compt_cst": (without_volume.of(variant="cst"), without_volume.of(variant="fixed_step")),
            "direct_conjugate": (bent.of(variant="direct"), bent),
            "threads": (bent.of(variant="two_threads"), bent),
        }

    def cases_with_fields(self) -> set[Case]:
        """The runs that write their fields at SNAPSHOT_TIME."""
        return {*self.main_cases(), *self.comparisons()["threads"]}

    def all_cases(self) -> list[Case]:
        pairs = [case for pair in self.comparisons().values() for case in pair]
        listed = self.main_cases() + self.small_load_runs() + self.refinement_cases() + pairs
        return sorted(set(listed), key=lambda case: (case.sub_edge_mm, case.name))  # the long ones first


EVERY_MATERIAL = tuple((m, nu) for m in MATERIALS for nu in POISSON_RATIOS)
PLANS = {
    "full": Plan(levels=(100, 50, 25), main=35, comparison=50, small_load_cases=EVERY_MATERIAL),
    "quick": Plan(levels=(200, 140, 100), main=100, comparison=200, small_load_cases=(("anisotropic", 0.25),)),
}
