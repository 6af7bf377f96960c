"""What Hypothesis draws: spectra, profiles, half-spaces and contact problems of all sizes and shapes."""

import math
from dataclasses import dataclass

import numpy as np
from hypothesis import assume
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

import bem3d
import mdr

hursts = st.floats(0.01, 1.2)
scales = st.floats(-9, 9).map(lambda exponent: 10.0**exponent)


@st.composite
def self_affine(draw):
    """Any H in (0, 1.2], cut-offs from almost equal to six decades apart, any rms."""
    q_min = draw(scales)
    return mdr.SelfAffine(
        hurst=draw(hursts), q_min=q_min, q_max=q_min * 10 ** draw(st.floats(0.01, 6)), rms=draw(scales)
    )


@dataclass(frozen=True)
class Bumps:
    """An arbitrary positive spectrum: a sum of log-normal bumps, smooth, all of it between q_low and q_high."""

    level: tuple[float, ...]
    centre: tuple[float, ...]
    width: tuple[float, ...]

    def c2d(self, q):
        bumps = zip(self.level, self.centre, self.width, strict=True)
        return sum(a * np.exp(-(((np.log(q) - c) / w) ** 2)) for a, c, w in bumps)

    @property
    def q_low(self):
        return math.exp(min(self.centre) - 12 * max(self.width))

    @property
    def q_high(self):
        return math.exp(max(self.centre) + 12 * max(self.width))


@st.composite
def bumps(draw):
    count = draw(st.integers(1, 4))
    several = [st.lists(st.floats(low, high), min_size=count, max_size=count) for low, high in ((1e-3, 1e3), (-7, 7))]
    widths = draw(st.lists(st.floats(0.2, 0.6), min_size=count, max_size=count))
    return Bumps(tuple(draw(several[0])), tuple(draw(several[1])), tuple(widths))


profiles = arrays(np.float64, st.integers(1, 60), elements=st.floats(-1, 1, width=32))


@dataclass(frozen=True)
class Pressed:
    """A half-space, a gap and what is prescribed."""

    half_space: bem3d.HalfSpace
    gap: np.ndarray
    prescribed: dict[str, float]

    def solve(self, **settings):
        """The contact."""
        return bem3d.solve(self.half_space, self.gap, **self.prescribed, **settings)


@st.composite
def half_spaces(draw, *, most=9, periodic=None):
    """Odd, even and non-square grids, cells up to ten times as long as wide."""
    return bem3d.HalfSpace(
        shape=(draw(st.integers(1, most)), draw(st.integers(1, most))),
        spacing=(draw(st.floats(0.3, 3)), draw(st.floats(0.3, 3))),
        modulus=1.0,
        periodic=draw(st.booleans()) if periodic is None else periodic,
    )


@st.composite
def pressed(draw, *, most=9, periodic=None, by=("approach", "force")):
    """Contact problems: random gaps, gaps with plateaus of equal height, spikes; light to full contact."""
    half_space = draw(half_spaces(most=most, periodic=periodic))
    # heights on a ladder: differences that are mere rounding beside the load have no residual to reach
    rough = arrays(np.float64, half_space.shape, elements=st.integers(0, 64).map(lambda i: i / 64))
    steps = arrays(np.float64, half_space.shape, elements=st.sampled_from([0.0, 0.5, 1.0]))
    gap = draw(rough | steps)
    if draw(st.sampled_from(by)) == "force":
        return Pressed(half_space, gap, {"force": 10 ** draw(st.floats(-4, 3))})
    deepest = gap.min() + draw(st.floats(1e-3, 3))
    if half_space.periodic:
        assume(np.ptp(gap) > 0)
        deepest = gap.min() + draw(st.floats(0.01, 0.99)) * (gap.mean() - gap.min())
    return Pressed(half_space, gap, {"approach": float(deepest)})


@dataclass(frozen=True)
class OnSprings:
    """A wheel over a rough track of springs."""

    height: np.ndarray
    spacing: float
    radius: float
    modulus: float
    approach: float

    @property
    def wheel(self):
        """All but the height and the load."""
        return {"spacing": self.spacing, "radius": self.radius, "modulus": self.modulus}

    @property
    def rounding(self):
        """Of a force: a part in 1e12 of what all springs in reach would bear under the deepest compression of all."""
        deepest = self.approach + np.abs(self.height).max()
        springs = 2 * math.sqrt(self.radius * deepest) / self.spacing + 1
        return 1e-12 * self.modulus * self.spacing * springs * deepest

    def roll(self, **settings):
        """The wheel along the track, at its approach where nothing else is prescribed."""
        if "force" not in settings:
            settings.setdefault("approach", self.approach)
        return mdr.roll(self.height, **self.wheel, **settings)


@st.composite
def on_springs(draw, *, longest=200):
    """From less than a spring to a contact radius to twenty; tracks barely longer than the contact; smooth to wild."""
    springs = draw(st.floats(0.3, 20))
    points = math.floor(2 * springs) + 1 + draw(st.integers(0, 3) | st.integers(0, longest))
    spacing, radius = 10 ** draw(st.floats(-6, 3)), 10 ** draw(st.floats(-3, 3))
    d = (springs * spacing) ** 2 / radius
    assume(points * spacing > 2 * math.sqrt(radius * d))
    rms, offset = draw(st.sampled_from([0.0, 1e-6, 0.01, 0.3, 1.0, 3.0, 10.0])), draw(st.sampled_from([0.0, -0.5, 2.0]))
    noise = np.random.default_rng(draw(st.integers(0, 10**6))).normal(size=points)
    return OnSprings(d * (offset + rms * noise), spacing, radius, 10 ** draw(st.floats(-3, 12)), d)
