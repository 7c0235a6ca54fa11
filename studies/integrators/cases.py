"""The decks of the study that `gneiss compare` takes, by the name of their case."""
from __future__ import annotations

from studies.common.decks import Deck
from studies.integrators import comparisons, through_events
from studies.integrators.problems import PROBLEMS


def decks(profile: str) -> dict[str, Deck]:
    found = {name: comparisons.deck(problem, profile) for name, problem in PROBLEMS.items()}
    found |= {name: through_events.deck(name, profile) for name in through_events.PROBLEMS}
    return found | {f"flutter-{volumetric}": comparisons.flutter_deck(volumetric, profile)
                    for volumetric in comparisons.VOLUMETRIC}
