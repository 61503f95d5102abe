"""Several threads may ask at once: each gets its own answer, and the interpreter lives."""

import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from typing import ClassVar

import numpy as np

from stonepass.materials.derivatives import energy_derivatives, hoop_energy_slope
from stonepass.materials.neo_hookean import NeoHookean
from stonepass.strain import INNER_WALL, CauchyGreen

# In a process of its own, because two threads in the engine at once end it with a segmentation fault.
SCRIPT = """
from concurrent.futures import ThreadPoolExecutor
import stonepass as sp

def pressure(question):
    xi, model = question
    tube = sp.Ureter(wall_ratio=1.5, material="latex")
    stone = sp.Stone(size_ratio=xi, friction=0.4)
    return sp.critical_pressure(stone, tube, model=model, numerics=sp.Numerics("fast")).pressure

smooth, direct = sp.SeatedBalance("frictionless"), sp.PushThrough()
questions = [(1.1, smooth), (1.2, smooth), (1.15, direct)]
with ThreadPoolExecutor(2) as pool:
    together = list(pool.map(pressure, questions))
assert None not in together
assert together == [pressure(each) for each in questions]
print("same")
"""


def test_two_threads_get_the_answers_of_one():
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT], capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stdout) == (0, "same\n"), done.stderr


class Watched(NeoHookean):
    """A law that notes how many threads are in it at once."""

    inside: ClassVar[list[int]] = []
    most: ClassVar[list[int]] = []

    def energy(self, C, place, xp):
        self.inside.append(1)
        self.most.append(len(self.inside))
        time.sleep(2e-3)
        self.inside.pop()
        return super().energy(C, place, xp)


def test_one_thread_differentiates_at_a_time():
    law, t = Watched(1e5), np.linspace(1.01, 1.4, 5)
    nothing = 0.0 * t
    C = CauchyGreen(1.0 / t**2, t**2, 1.0 + nothing, nothing, nothing, nothing)

    def differentiate(k):
        if k % 2:
            return hoop_energy_slope(law, t)
        return energy_derivatives(law, C, INNER_WALL)[1]

    with ThreadPoolExecutor(4) as pool:
        found = list(pool.map(differentiate, range(12)))
    assert len(law.most) >= 12
    assert max(law.most) == 1
    for each in found[2:]:
        assert np.array_equal(each, found[0]) or np.array_equal(each, found[1])
