"""Crack paths from segments that are made up."""
import unittest

import numpy as np

from studies.common.fields import Frame
from studies.fracture.paths import Network, Segments, angle_of, apart, connected, passing_times, speeds, start_time

SIZE = 1e-3
TIP, TOLERANCE = np.array([0.05, 0.0]), 1e-7


def chain(points, t_first, speed):
    """Edges of about SIZE along a polyline, failing one after the other."""
    points = np.asarray(points, dtype=float)
    ends, times, t = [], [], t_first
    for a, b in zip(points[:-1], points[1:]):
        n = max(1, round(float(np.linalg.norm(b - a)) / SIZE))
        for k in range(n):
            p, q = a + (b - a) * k / n, a + (b - a) * (k + 1) / n
            t += float(np.linalg.norm(q - p)) / speed
            ends.append([p, q])
            times.append(t)
    return np.array(ends), np.array(times)


def segments(*parts):
    ends, times = np.concatenate([p[0] for p in parts]), np.concatenate([p[1] for p in parts])
    return Segments(ends, np.zeros(len(times)), np.zeros(len(times)), times)


NOTCH = (np.array([[[0.0, 0.0], [0.05, 0.0]]]), np.array([0.0]))
SOUND = (np.array([[[0.06, 0.01], [0.061, 0.01]]]), np.array([np.inf]))


class TestRunningCrack(unittest.TestCase):
    def setUp(self):
        self.cracks = segments(NOTCH, SOUND, chain([(0.05, 0), (0.07, 0)], 10e-6, 1000.0))

    def test_Start_IsTheFirstFailureAfterTheNotch(self):
        self.assertAlmostEqual(start_time(self.cracks), 11e-6)

    def test_Tip_RunsAtItsSpeed(self):
        times, reach = Network(self.cracks, TIP, TOLERANCE).history()
        self.assertAlmostEqual(reach[0], 0.05)
        self.assertAlmostEqual(reach[-1], 0.07)
        at, speed = speeds(times[times > 0], reach[times > 0], 6e-6)
        self.assertAlmostEqual(float(speed.min()), 1000.0, delta=80)
        self.assertAlmostEqual(float(speed.max()), 1000.0, delta=80)
        self.assertGreater(at.min(), 0.05)
        self.assertLess(at.max(), 0.07)

    def test_WhatHangsTogetherInTheEnd_CountsAtItsOwnTime(self):
        # a bridge behind the tip fails late
        bridge, ahead = chain([(0.07, 0), (0.071, 0)], 60e-6, 1e9), chain([(0.071, 0), (0.075, 0)], 31e-6, 1000.0)
        times, reach = Network(segments(chain([(0.05, 0), (0.07, 0)], 10e-6, 1000.0), bridge, ahead, SOUND), TIP, TOLERANCE).history()
        self.assertAlmostEqual(float(reach[times < 36e-6].max()), 0.075)

    def test_WhatIsElsewhere_DoesNotCount(self):
        other = chain([(0.09, 0), (0.1, 0)], 5e-6, 1000.0)
        _, reach = Network(segments(chain([(0.05, 0), (0.07, 0)], 10e-6, 1000.0), other), TIP, TOLERANCE).history()
        self.assertAlmostEqual(float(reach.max()), 0.07)

    def test_OneCrack_DoesNotBranch(self):
        self.assertTrue(np.isnan(Network(self.cracks, TIP, TOLERANCE).fork(4e-3)[1]))

    def test_NothingFailed_IsNaN(self):
        nothing = segments(SOUND)
        self.assertTrue(np.isnan(start_time(nothing)))
        self.assertTrue(np.isnan(Network(nothing, TIP, TOLERANCE).fork(4e-3)[1]))
        self.assertTrue(np.isnan(angle_of(nothing, np.zeros(2), SIZE)))


class TestPassing(unittest.TestCase):
    def test_Times_AreInterpolatedBetweenFrames(self):
        a, b, c = ([[0.0, y], [1.0, y]] for y in (0.0, 1.0, 2.0))
        frames = [(0.0, np.zeros((0, 2, 2)), np.zeros(0)), (1.0, np.array([a]), np.array([0.2])),
                  (2.0, np.array([b, a, c]), np.array([0.8, 0.6, 0.1]))]
        b_time, a_time, c_time = passing_times(frames, 0.5)
        self.assertAlmostEqual(a_time, 1.75)
        self.assertAlmostEqual(b_time, 1.0 + 0.5 / 0.8)
        self.assertEqual(c_time, np.inf)


class TestBranches(unittest.TestCase):
    def test_Branching_IsAtTheForkWhenTheSecondArmLeaves(self):
        trunk = chain([(0.05, 0), (0.065, 0)], 10e-6, 1000.0)
        up = chain([(0.065, 0), (0.085, 0.01)], 25e-6, 1000.0)
        down = chain([(0.065, 0), (0.085, -0.01)], 27e-6, 1000.0)
        where, when = Network(segments(trunk, up, down), TIP, TOLERANCE).fork(4e-3)
        np.testing.assert_allclose(where, [0.065, 0], atol=1e-9)
        self.assertAlmostEqual(when, 27e-6 + float(np.hypot(0.02, 0.01)) / 22 / 1000.0)

    def test_ShortSideCrack_IsNoBranch(self):
        trunk = chain([(0.05, 0), (0.08, 0)], 10e-6, 1000.0)
        stub = chain([(0.06, 0), (0.062, 0.002)], 20e-6, 1000.0)
        self.assertTrue(np.isnan(Network(segments(trunk, stub), TIP, TOLERANCE).fork(4e-3)[1]))

    def test_CrackThatDoesNotHangTogether_IsNoBranch(self):
        trunk = chain([(0.05, 0), (0.08, 0)], 10e-6, 1000.0)
        other = chain([(0.06, 0.005), (0.08, 0.005)], 20e-6, 1000.0)
        self.assertTrue(np.isnan(Network(segments(trunk, other), TIP, TOLERANCE).fork(4e-3)[1]))


    def test_ArmBehindABridge_HangsByIt(self):
        trunk = chain([(0.05, 0), (0.08, 0)], 10e-6, 1000.0)
        arm = chain([(0.065, 0.0015), (0.075, 0.008)], 27e-6, 1000.0)
        self.assertTrue(np.isnan(Network(segments(trunk, arm), TIP, TOLERANCE, 1.4e-3).fork(4e-3)[1]))
        where, when = Network(segments(trunk, arm), TIP, TOLERANCE, 1.6e-3).fork(4e-3)
        np.testing.assert_allclose(where, [0.065, 0], atol=1e-9)
        self.assertAlmostEqual(when, 28e-6, delta=0.2e-6)


class TestAngle(unittest.TestCase):
    def test_Angle_IsThatOfTheCrackAtTheTip(self):
        tip = np.array([0.05, 0.025])
        way = np.array([np.cos(np.radians(68)), np.sin(np.radians(68))])
        crack = chain([tip, tip + 0.04 * way], 25e-6, 1000.0)
        elsewhere = chain([(0.1, 0.09), (0.09, 0.099)], 25e-6, 1000.0)
        self.assertAlmostEqual(angle_of(segments(NOTCH, crack, elsewhere), tip, 1e-5), 68, places=6)

    def test_Connected_CountsChains(self):
        ends = np.array([[[0, 0], [1, 0]], [[1, 0], [1, 1]], [[3, 3], [4, 4]]], dtype=float)
        numbers = connected(ends, 1e-6)
        self.assertEqual(numbers[0], numbers[1])
        self.assertNotEqual(numbers[0], numbers[2])


class TestApart(unittest.TestCase):
    """Two triangles along the x axis that do not share nodes: the upper one moves."""

    def jump(self, move, swapped=False):
        points = np.array([[0, 0], [1, 0], [0.5, -1], [0, 0], [1, 0], [0.5, 1]], dtype=float)
        triangles = np.array([[0, 2, 1], [3, 4, 5]])
        if swapped:
            triangles = triangles[::-1]
        u = np.zeros((6, 2))
        u[3:] = move
        return apart(Frame(points, triangles, {"displacement": u}))

    def test_OpeningAndSlip_AreThoseOfTheMotion(self):
        for swapped in (False, True):
            found = self.jump([0.2, 0.1], swapped)
            self.assertEqual(found.length.size, 1)
            self.assertAlmostEqual(float(found.opening[0]), 0.1)
            self.assertAlmostEqual(float(found.slip[0]), 0.2)

    def test_Closing_IsNegative(self):
        self.assertAlmostEqual(float(self.jump([0, -0.1]).opening[0]), -0.1)

    def test_SharedNodes_AreNotApart(self):
        points = np.array([[0, 0], [1, 0], [0.5, -1], [0.5, 1]], dtype=float)
        frame = Frame(points, np.array([[0, 2, 1], [0, 1, 3]]), {"displacement": np.zeros((4, 2))})
        self.assertEqual(apart(frame).length.size, 0)


if __name__ == "__main__":
    unittest.main()
