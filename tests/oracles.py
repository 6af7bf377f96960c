"""Slow, dense, independent answers. Nothing here shares code with what it checks."""

import functools
import math
from fractions import Fraction

import numpy as np
from scipy import integrate, linalg, optimize, signal


def love_by_logarithms(x, y, dx, dy):
    """int dA / r over cells by the four logarithms of the textbook."""
    total = 0.0
    for this, that, half_this, half_that in ((x, y, dx / 2, dy / 2), (y, x, dy / 2, dx / 2)):
        for sign in (1, -1):
            arm, above, below = this + sign * half_this, that + half_that, that - half_that
            total += sign * arm * np.log((above + np.hypot(above, arm)) / (below + np.hypot(below, arm)))
    return total


def dense_operator(half_space):
    """K as a matrix over all cells."""
    (nx, ny), (dx, dy) = half_space.shape, half_space.steps
    i, j = (np.subtract.outer(index, index) for index in np.indices((nx, ny)).reshape(2, -1))
    if half_space.periodic:
        return _periodic_green(i, j, (nx, ny), (dx, dy)) / half_space.modulus
    return love_by_logarithms(i * dx, j * dy, dx, dy) / (math.pi * half_space.modulus)


def displacement(half_space, pressure):
    """K p on grids too large for a matrix: a direct sum of textbook kernels, or of the waves of the whole spectrum."""
    (nx, ny), (dx, dy) = half_space.shape, half_space.steps
    if half_space.periodic:
        wave_x, wave_y = np.meshgrid(np.fft.fftfreq(nx, dx), np.fft.fftfreq(ny, dy), indexing="ij")
        q = 2 * np.pi * np.sqrt(wave_x**2 + wave_y**2)
        green = np.divide(2 / half_space.modulus, q, out=np.zeros(q.shape), where=q > 0)
        return np.fft.ifft2(green * np.fft.fft2(pressure)).real
    i, j = np.meshgrid(np.arange(1 - nx, nx), np.arange(1 - ny, ny), indexing="ij")
    kernel = love_by_logarithms(i * dx, j * dy, dx, dy) / (math.pi * half_space.modulus)
    return signal.oaconvolve(kernel, pressure, mode="valid")


def residual(half_space, gap, pressure, approach):
    """The mean gap under pressure or the deepest overlap, whichever is larger, over the overlap without pressure."""
    w = gap + displacement(half_space, pressure) - approach
    return max((pressure * np.abs(w)).sum() / pressure.sum(), -w.min()) / (approach - gap.min())


def _periodic_green(i, j, shape, spacing):
    """sum over the waves of the grid of 2 cos(q.x) / (|q| number of cells), zero mode left out; E* = 1."""
    nx, ny = shape
    total = np.zeros(i.shape)
    for k in range(nx):
        for m in range(ny):
            wave_x = (k if 2 * k <= nx else k - nx) / (nx * spacing[0])
            wave_y = (m if 2 * m <= ny else m - ny) / (ny * spacing[1])
            q = 2 * math.pi * math.hypot(wave_x, wave_y)
            if q > 0:
                total += 2 / q * np.cos(2 * math.pi * (k * i / nx + m * j / ny))
    return total / (nx * ny)


def contact_by_least_squares(half_space, gap, approach):
    """Pressure of min 1/2 p K p - (approach - gap) p over p >= 0, as a non-negative least-squares problem."""
    root = linalg.cholesky(dense_operator(half_space))
    target = linalg.solve_triangular(root, (approach - gap).ravel(), trans="T")
    pressure, _ = optimize.nnls(root, target, maxiter=100 * target.size)
    return pressure.reshape(half_space.shape)


def approach_by_least_squares(half_space, gap, force):
    """The approach at which the dense solution carries a force."""

    def excess(approach):
        if approach <= low:
            return -force
        return contact_by_least_squares(half_space, gap, approach).sum() * half_space.cell_area - force

    low = float(gap.min())
    high = low + 1.0
    while excess(high) < 0:
        high = low + 2 * (high - low)
    return optimize.brentq(excess, low, high, xtol=1e-13, rtol=1e-13)


def spring_sum(height, length, modulus, approach):
    """Force and stiffness of the foundation, spring by spring."""
    spring = modulus * length / len(height)
    compressions = [approach + h for h in height]
    force = math.fsum(spring * c for c in compressions if c > 0)
    return force, spring * sum(c > 0 for c in compressions)


def moment_1d(c1d, n, low, high, *, nodes=400):
    """int |q|^n C_1D dq over both signs, Gauss-Legendre in ln q."""
    return _log_quadrature(lambda q: 2 * q**n * c1d(q), low, high, nodes)


def moment_2d(c2d, n, low, high, *, nodes=400):
    """int |q|^n C_2D d^2q, Gauss-Legendre in ln q."""
    return _log_quadrature(lambda q: 2 * math.pi * q ** (n + 1) * c2d(q), low, high, nodes)


@functools.cache
def gauss_legendre(nodes):
    """Nodes and weights on [-1, 1]."""
    return np.polynomial.legendre.leggauss(nodes)


def _log_quadrature(f, low, high, nodes):
    node, weight = gauss_legendre(nodes)
    half = math.log(high / low) / 2
    q = low * np.exp(half * (node + 1))
    return float(np.sum(weight * f(q) * q) * half)


def flat_square_by_graded_cells(cells):
    """k / (E* L) of a flat square punch on dense rectangles that grow finer towards the edges."""
    edges = 0.5 - 0.5 * np.cos(np.linspace(0, math.pi, cells + 1))
    middle, width = (edges[1:] + edges[:-1]) / 2, np.diff(edges)
    x, y = (g.ravel() for g in np.meshgrid(middle, middle, indexing="ij"))
    dx, dy = (g.ravel() for g in np.meshgrid(width, width, indexing="ij"))
    matrix = love_by_logarithms(np.subtract.outer(x, x), np.subtract.outer(y, y), dx, dy) / math.pi
    return float(np.sum(linalg.solve(matrix, np.ones(x.size)) * dx * dy))


def rms_scatter_of_gaussian_draws(hurst, *, last, dimensions):
    """Relative standard deviation of the mean square of a Gaussian draw with waves 1 to last on a side.

    The mean square is a sum of v_q |z_q|^2 over all waves of both signs, z_-q the conjugate of z_q, |z_q|^2
    exponential with mean one: its variance is sum_q 2 v_q^2 over all of them.
    """
    modes = range(-last, last + 1)
    if dimensions == 1:
        power = [abs(i) ** (-2 * hurst - 1) for i in modes if i]
    else:
        lengths = [math.hypot(i, j) for i in modes for j in modes if 0 < math.hypot(i, j) <= last]
        power = [q ** (-2 * hurst - 2) for q in lengths]
    return math.sqrt(2 * sum(v**2 for v in power)) / sum(power)


def wheel_on_springs(height, *, spacing, radius, approach, places=None, rounding=1e-13):
    """Compressions summed over springs under a wheel at places of a periodic track; at all points if none are given.

    Returns sum_j max(d - x_j^2 / R + h_j, 0), and the least and the most that may be in contact, since rounding decides
    of springs that just touch.
    """
    places = np.arange(len(height)) if places is None else np.asarray(places)
    approach = np.broadcast_to(approach, places.size)
    reach = math.sqrt(radius * max(approach.max() + height.max(), 0.0)) / spacing
    j = np.arange(-math.ceil(reach) - 1, math.ceil(reach) + 2)
    near = height[(places[:, np.newaxis] + j) % len(height)]
    compression = approach[:, np.newaxis] - (j * spacing) ** 2 / radius + near
    rounding = rounding * (np.abs(approach).max() + np.abs(height).max())
    total = np.array([math.fsum(row[row > 0]) for row in compression])
    return total, (compression > rounding).sum(axis=1), (compression > -rounding).sum(axis=1)


def approach_by_fractions(height, place, *, spacing, radius, wanted):
    """Approach d of sum_j max(d - x_j^2 / R + h_j, 0) = wanted at a place of a periodic track, without rounding.

    Springs are walked outwards until none that follows may touch. Also returns how many touch, and the largest of
    height, profile and compression that are in the sum.
    """
    heights, spacing, radius, wanted = [Fraction(float(h)) for h in height], *map(Fraction, (spacing, radius, wanted))
    highest, springs, j = max(heights), [], 0
    while not springs or wanted - max(springs)[0] + highest > (j * spacing) ** 2 / radius:
        profile = (j * spacing) ** 2 / radius
        springs += [(heights[(place + side) % len(heights)] - profile, profile) for side in {-j, j}]
        j += 1
    total, largest = Fraction(0), Fraction(0)
    for n, (level, profile) in enumerate(sorted(springs, reverse=True)):
        if n and n * -level >= wanted - total:
            break
        total += level
        largest = max(largest, abs(level), profile)
        approach, pressed = (wanted - total) / (n + 1), n + 1
    return float(approach), pressed, float(max(largest, approach + max(springs)[0]))


def free_vibration_by_small_steps(highest, *, turns=None):
    """u'' = (2/3) (1 - max(u, 0)^(3/2)) released at `highest`, by an adaptive method of eighth order.

    Returns its period over 2 pi; or, with `turns`, u and u' after so many times 2 pi.
    """

    def motion(_, state):
        return [state[1], 2 / 3 * (1 - max(state[0], 0.0) ** 1.5)]

    def at_the_top(_, state):
        return state[1]

    at_the_top.direction = -1
    settings = {"method": "DOP853", "rtol": 1e-13, "atol": 1e-13}
    if turns is not None:
        return integrate.solve_ivp(motion, (0, 2 * math.pi * turns), [highest, 0.0], **settings).y[:, -1]
    # begun on the way down, so that the event is not met at once
    begun = integrate.solve_ivp(motion, (0, 0.1), [highest, 0.0], **settings).y[:, -1]
    long = 20 * math.sqrt(highest) + 20 * highest
    back = integrate.solve_ivp(motion, (0, long), begun, events=[at_the_top], **settings)
    return (0.1 + float(back.t_events[0][0])) / (2 * math.pi)
