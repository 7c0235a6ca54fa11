"""VERIFICATION 11 to 13: a block that slides to rest, a block on an incline, two discs that collide, and how the energy error
of contact without losses falls with the step."""
from __future__ import annotations

from pathlib import Path

import numpy as np

from studies.common import style
from studies.common.decks import Deck, overlaid, read_deck
from studies.common.fields import frame_path, read_frame
from studies.common.matrices import read_system
from studies.common.results import observed_order, read_summary, read_table

DECKS = Path(__file__).parent.parent / "decks"
GRAVITY = 9.81
BLOCK = (0.05, 0.05)              # m, on top of the block
SPEEDS = [0.5, 1.0, 2.0]          # m/s
# m/s; where the corner starts, m: over the middle of a sub-edge, and so that it lands right of the node between two of them and
# slides over it
WEDGES = {"stays": ((0.2, -0.5), 7.5e-3), "crosses": ((-0.7, -0.5), 17.0e-3)}
STEP = 2e-5                       # s, the longest of the halvings
WEDGE_END = 4e-3                  # s
GAPS = {"full": 40, "quick": 32}
HALVINGS = {"full": 4, "quick": 3}


def name_of(speed: float) -> str:
    return f"contact-sliding-{speed:g}"


def from_file(name: str, changes: Deck) -> Deck:
    """A deck of studies/fracture/decks, its mesh found from everywhere."""
    deck = read_deck(DECKS / name)
    deck["mesh"]["file"] = str(DECKS / deck["mesh"]["file"])
    deck["title"] = f"fracture: {deck['title']}"
    return overlaid(deck, changes)


def friction_of(deck: Deck) -> float:
    return deck["contact"]["friction"]


def cases(profile: str) -> dict[str, Deck]:
    found = {}
    for speed in SPEEDS:
        deck = from_file("sliding_block.toml", {"initial": {"velocity": [speed, 0.0]}})
        # some time at rest, so that it is seen to stay
        t_end = speed / (friction_of(deck) * GRAVITY) + 0.05
        found[name_of(speed)] = overlaid(deck, {"run": {"t_end": t_end}})
    found["contact-incline"] = from_file("incline.toml", {})
    found["contact-discs"] = from_file("disc_pair.toml", {})
    return found


MATRICES = ["contact-sliding-1", "contact-incline", "contact-discs"]  # cases whose masses are needed


def wedge_deck() -> Deck:
    """Two composites, the corner of one comes down on a side of the other."""
    return {
        "title": "fracture: a corner on a side, energy error against step",
        "mesh": {"file": str(DECKS / "wedge_on_triangle.geo"), "parameters": {"gap": 1e-3, "x": 7.5e-3}},
        "solid": {"element": "compt", "plane": "strain"},
        "material": [{"density": 1000.0, "constants": {"E": 1e7, "nu": 0.25}}],
        "contact": {"method": "potential", "friction": 0.0},
        "initial": [{"on": "upper", "velocity": [0.0, 0.0]}],
        "integrator": {"type": "central_difference", "dt": STEP},
        "run": {"t_end": WEDGE_END},
        "output": {"history": STEP, "rows": "steps"},
    }


def sweeps(profile: str) -> dict[str, tuple[Deck, list[Deck]]]:
    """By name of the run: deck, and the changes of each of its variants, of which only history.csv is kept."""
    found = {}
    for way, (velocity, x) in WEDGES.items():
        for halving in range(HALVINGS[profile] + 1):
            step = STEP / 2**halving
            # gaps over a range of many steps' way, by the golden section: at all fractions of every step's way
            gaps = 1e-3 + 3e-4 * np.mod((5**0.5 - 1) / 2 * np.arange(GAPS[profile]), 1)
            found[f"contact-order-{way}-{halving}"] = (wedge_deck(), [{
                "mesh": {"parameters": {"gap": float(gap), "x": x}}, "initial": {"velocity": list(velocity)},
                "integrator": {"dt": step}, "output": {"history": step}} for gap in gaps])
    return found


def parts(n_nodes: int, elements: np.ndarray) -> np.ndarray:
    """Of every node the least number among the nodes that elements join it to."""
    number = np.arange(n_nodes)
    while True:
        least = number.copy()
        np.minimum.at(least, elements.ravel(), np.repeat(number[elements].min(axis=1), elements.shape[1]))
        least = least[least]
        if np.array_equal(least, number):
            return number
        number = least


class Body:
    """Nodes of the body that has the node at a place (the nearest one), and their masses, kg."""

    def __init__(self, matrices: Path, place: tuple[float, float]) -> None:
        system = read_system(matrices)
        number = parts(len(system.nodes), system.elements)
        at = np.argmin(np.linalg.norm(system.nodes - place, axis=1))
        self.nodes = np.nonzero(number == number[at])[0]
        self.mass = system.mass[::2][self.nodes]
        self.points = system.nodes[self.nodes]

    def mean(self, folder: Path, quantity: str, t: float, tolerance: float) -> np.ndarray:
        """Over the mass, of a field of a frame."""
        frame = read_frame(frame_path(folder, t, tolerance))
        if not np.array_equal(frame.points[self.nodes], self.points):
            raise ValueError(f"{folder}: the frame has other nodes than the masses")
        return self.mass @ frame.point_data[quantity][self.nodes, :2] / self.mass.sum()


def measure_sliding(runs: Path, decks: dict[str, Deck]) -> dict:
    found = {}
    block = Body(runs / "contact-sliding-1" / "matrices", BLOCK)
    for speed in SPEEDS:
        name = name_of(speed)
        t_end = decks[name]["run"]["t_end"]
        way = float(block.mean(runs / name, "displacement", t_end, 1e-6)[0])
        left = float(block.mean(runs / name, "velocity", t_end, 1e-6)[0])
        exact = speed**2 / (2 * friction_of(decks[name]) * GRAVITY)
        probes = read_table(runs / name / "probes.csv")
        found[str(speed)] = {"way": way, "exact": exact, "error": abs(way / exact - 1), "speed_left": abs(left) / speed,
                             "t": probes.t[::2].tolist(), "x": probes["block.u_x"][::2].tolist()}
    return found


def measure_incline(runs: Path, deck: Deck) -> dict:
    t = deck["run"]["t_end"]
    block = Body(runs / "contact-incline" / "matrices", BLOCK)
    a = float(block.mean(runs / "contact-incline", "velocity", t, 1e-6)[0]) / t
    angle = np.radians(35.0)  # in the deck's body force
    exact = GRAVITY * (np.sin(angle) - friction_of(deck) * np.cos(angle))
    return {"acceleration": a, "exact": exact, "error": abs(a / exact - 1)}


def measure_discs(runs: Path, deck: Deck) -> dict:
    folder = runs / "contact-discs"
    t_end = deck["run"]["t_end"]
    bodies = [Body(folder / "matrices", (x, 0.0)) for x in (-0.02, 0.02)]
    masses = np.array([body.mass.sum() for body in bodies])
    history = read_table(folder / "history.csv")

    def velocities(t: float) -> np.ndarray:
        return np.array([body.mean(folder, "velocity", t, 1e-9) for body in bodies])

    closing = np.array([initial["velocity"] for initial in deck["initial"]])  # left, right
    after = velocities(t_end)
    scale = masses[0] * abs(closing[0, 0])
    # over all frames, some of them in the middle of the impact
    step = deck["output"]["fields"]
    errors = [float(np.abs(masses @ (velocities(t) - closing)).max() / scale) for t in step * np.arange(1, round(t_end / step) + 1)]
    return {"restitution": float((after[1, 0] - after[0, 0]) / (closing[0, 0] - closing[1, 0])),
            "momentum_error": max(errors), "energy_error": read_summary(folder)["balance_error"],
            "t": history.t.tolist(), "kinetic": history["kinetic"].tolist(), "contact": history["stored_contact"].tolist(),
            "material": history["stored_material"].tolist()}


def measure_order(runs: Path, profile: str) -> dict:
    found: dict = {}
    for way in WEDGES:
        rms, met = [], []
        for halving in range(HALVINGS[profile] + 1):
            errors = []
            for i in range(GAPS[profile]):
                history = read_table(runs / f"contact-order-{way}-{halving}" / f"{i}.csv")
                scale = history["kinetic"][0]
                met.append(float(np.max(history["stored_contact"]) / scale))
                if met[-1] < 0.01:
                    raise ValueError(f"contact-order-{way}-{halving}, gap {i}: they do not meet")
                errors.append(np.max(np.abs(history["left_over"])) / scale)
            rms.append(float(np.sqrt(np.mean(np.square(errors)))))
        steps = [STEP / 2**halving for halving in range(HALVINGS[profile] + 1)]
        found[way] = {"steps": steps, "rms": rms, "order": observed_order(steps, rms), "stored": [min(met), max(met)]}
    return found


def measure(runs: Path, profile: str) -> dict:
    decks = cases(profile)
    sliding, incline = measure_sliding(runs, decks), measure_incline(runs, decks["contact-incline"])
    discs, order = measure_discs(runs, decks["contact-discs"]), measure_order(runs, profile)
    return {"sliding": sliding, "incline": incline, "discs": discs, "order": order, "metrics": {
        "sliding_distance_error_max": max(s["error"] for s in sliding.values()),
        "sliding_speed_left_max": max(s["speed_left"] for s in sliding.values()),
        "incline_acceleration_error": incline["error"],
        "disc_energy_error": discs["energy_error"], "disc_restitution": discs["restitution"],
        "contact_momentum_error": discs["momentum_error"],
        "contact_energy_order": order["stays"]["order"], "contact_energy_order_crossing": order["crosses"]["order"]}}


FIGURES = ["contact.png"]


def draw(measured: dict, figures: Path) -> None:
    figure, panels = style.plt.subplots(1, 3, figsize=(style.FULL_WIDTH, 2.5))
    for (speed, found), colour in zip(measured["sliding"].items(), style.CYCLE):
        panels[0].plot(found["t"], found["x"], color=colour, label=f"{float(speed):g} m/s")
        panels[0].axhline(found["exact"], color=colour, lw=0.6, ls="--")
    panels[0].set(xlabel="time [s]", ylabel="way of the block's top [m]")
    panels[0].legend()
    style.panel_label(panels[0], "a) sliding to rest")
    discs = measured["discs"]
    t = np.array(discs["t"]) * 1e6
    for key, label, colour in zip(("kinetic", "material", "contact"), ("kinetic", "discs", "contact"), style.CYCLE):
        panels[1].plot(t, np.array(discs[key]) / discs["kinetic"][0], color=colour, label=label)
    panels[1].set(xlabel="time [µs]", ylabel="energy over that at the start", ylim=(0, 1.05))
    panels[1].legend(loc=(0.6, 0.4))
    style.panel_label(panels[1], "b) two discs")
    for (way, found), colour, marker in zip(measured["order"].items(), style.CYCLE, "os"):
        panels[2].loglog(np.array(found["steps"]) * 1e6, found["rms"], marker + "-", color=colour, ms=3,
                         label=f"{way}: {found['order']:.2f}")
    panels[2].set(xlabel="step [µs]", ylabel="energy error, RMS over gaps")
    panels[2].set_xticks([2, 5, 10, 20], ["2", "5", "10", "20"])
    panels[2].minorticks_off()
    panels[2].legend(loc="center left", bbox_to_anchor=(0.02, 0.55))
    style.panel_label(panels[2], "c) order")
    style.save(figure, figures / "contact.png")
