"""Decks: every scheme of the program on every problem, steps that meet the samples, orders as documented."""
import re
import unittest
from pathlib import Path

from studies.integrators.cases import decks
from studies.integrators.comparisons import resolved_steps
from studies.integrators.problems import BAR_CELLS, BAR_LENGTH, PROBLEMS, bar_frequency
from studies.integrators.schemes import COMPOSITIONS, MULTIRATE, SCHEMES, TABLES, applicable, fixed

REFERENCE = (Path(__file__).parents[3] / "docs/deck.md").read_text()


class Schemes(unittest.TestCase):
    def test_TablesAndOrders_AreThoseOfTheProgram(self):
        listed = REFERENCE[REFERENCE.index("\n`table`:\n"):]
        listed = listed[:listed.index("\n\n`")]
        documented = {name: (kind, int(order)) for name, kind, order in    # but those that not every SUNDIALS has
                      re.findall(r'^- `"(\w+)"`: (explicit|implicit|additive), order (\d)(?!.*\(SUNDIALS)', listed, re.M)}
        self.assertEqual(documented, {name: (kind, order) for kind, tables in TABLES.items()
                                      for name, order in tables.items()})

    def test_MultirateTables_AreThoseOfTheProgram(self):
        listed = REFERENCE[REFERENCE.index("\n`slow_table`:\n"):]
        listed = listed[:listed.index("\n\n`")]
        self.assertEqual({name: int(order) for name, order in re.findall(r'^- `"(\w+)"`: order (\d)', listed, re.M)}, MULTIRATE)

    def test_Compositions_AreThoseOfTheProgram(self):
        listed = re.search(r"\| `composition` \| one of \| – \| ([^|]*)\|", REFERENCE)[1]
        listed = re.findall(r'"(\w+)"', listed)
        self.assertEqual(listed[:len(COMPOSITIONS)], list(COMPOSITIONS))    # those above order 4 are left out

    def test_EveryDeck_HasEveryScheme(self):
        for name, deck in decks("full").items():
            listed = {entry["name"] for entry in deck["compare"]["scheme"]}
            self.assertLessEqual({scheme.name for scheme in SCHEMES.values() if applicable(scheme, deck)}, listed, name)


class Steps(unittest.TestCase):
    def test_EqualSteps_MeetTheSamples_AndDiffer(self):
        for problem in PROBLEMS.values():
            for scheme in fixed():
                numbers = resolved_steps(problem, scheme)
                self.assertEqual(sorted(set(numbers)), list(numbers), (problem.name, scheme.name))


class Bar(unittest.TestCase):
    def test_HighestMode_IsThatOfTheChain(self):
        """2c/h at the edge of the zone; long waves at the speed of sound."""
        c, h = 1000.0, BAR_LENGTH / (2 * BAR_CELLS)
        self.assertAlmostEqual(bar_frequency(2 * BAR_CELLS), 2 * c / h, 6)
        self.assertAlmostEqual(bar_frequency(1) / (3.141592653589793 * c / BAR_LENGTH), 1, 2)


if __name__ == "__main__":
    unittest.main()
