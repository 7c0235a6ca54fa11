"""The experiments of the study. To add one: copy a module, add it to EXPERIMENTS; bounds go into check_metrics.py.

A module has
    cases(profile)           decks by the name of the case; profile "full" or "quick"
    measure(runs, profile)   a dictionary with "metrics" (numbers) and whatever its figures need, all of it JSON; runs is the
                             folder with a folder for each case
    FIGURES                  names of its figures, and
    draw(measured, figures)  which makes them from what was measured, into the folder `figures`
and may have
    sweeps(profile)          by name a deck and the changes of its variants, of which only history.csv is kept, as 0.csv, 1.csv, ...
    MATRICES                 cases of which `gneiss matrices` is asked, into the folder `matrices` of the case
CHECKED holds those whose decks are only checked (`gneiss check`) so far: `cases` is all that is asked of them.
"""
from __future__ import annotations

from types import ModuleType

from studies.fracture.experiments import bending, branching, brazilian, contact, dcb, joint, kalthoff, shear_box, speed

EXPERIMENTS: dict[str, ModuleType] = {"joint": joint, "shear_box": shear_box, "bending": bending,
                                      "dcb": dcb, "speed": speed, "brazilian": brazilian, "contact": contact,
                                      "branching": branching, "kalthoff": kalthoff}
CHECKED: dict[str, ModuleType] = {}
