"""Random numbers of one realisation, by its address."""

import numpy as np


def random_generator(seed: int, *key: int) -> np.random.Generator:
    """The random numbers of one realisation, independent of all others and of the process that draws them.

    seed: of the whole run, zero or positive; key: address of the realisation, whole numbers.
    """
    return np.random.Generator(np.random.PCG64(np.random.SeedSequence(seed, spawn_key=key)))
