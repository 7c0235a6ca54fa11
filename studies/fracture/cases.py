"""The decks of the study by the name of their case: those that run, and those that are only checked."""
from __future__ import annotations

from studies.common.decks import Deck
from studies.fracture.experiments import CHECKED, EXPERIMENTS

PROFILES = ("full", "quick")


def decks(profile: str) -> dict[str, Deck]:
    return _all(EXPERIMENTS, profile)


def checked_decks(profile: str) -> dict[str, Deck]:
    return _all(CHECKED, profile)


def _all(experiments: dict, profile: str) -> dict[str, Deck]:
    found: dict[str, Deck] = {}
    for module in experiments.values():
        for name, deck in module.cases(profile).items():
            if name in found:
                raise ValueError(f"two cases are called {name}")
            found[name] = deck
    return found


def sweeps(profile: str, experiment: str | None = None) -> dict[str, tuple[Deck, list[Deck]]]:
    """Of one experiment or of all: a deck and the changes of each of its variants, by the name of the sweep."""
    modules = EXPERIMENTS.values() if experiment is None else [EXPERIMENTS[experiment]]
    return {name: what for module in modules if hasattr(module, "sweeps") for name, what in module.sweeps(profile).items()}
