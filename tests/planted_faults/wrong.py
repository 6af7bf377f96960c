"""Faults that more than one room uses."""

import functools
import math
import types

import mdr
from validation.analysis import spectra


def with_math(**wrong):
    """math with some names changed."""
    return types.SimpleNamespace(**{**vars(math), **wrong})


def scaled(function, factor):
    """The same function with a factor on its result."""

    @functools.wraps(function)
    def wrong(*args, **kwargs):
        return factor * function(*args, **kwargs)

    return wrong


E_FOR_E_STAR = 1 - (1 / 3) ** 2


def one_sided_spectrum(found):
    return 2 * two_sided(found)


force_in_step = mdr.RollingEnsemble.force
two_sided = spectra.Waves.spectrum.fget
