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
