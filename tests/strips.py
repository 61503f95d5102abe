"""The stress of a strip of a known law, for tests."""

import numpy as np

from stonepass.bench.test_data import Tension


def nominal_stress(law, stretch, axis):
    """Nominal stress in Pa at each stretch of a strip that was cut along one axis of the wall."""
    strip = Tension(stretch, np.ones(len(stretch)), (axis,) * len(stretch))
    return strip.predicted(law)
