"""What happens when an iteration does not reach its tolerance: an exception that keeps the evidence."""

from typing import Any


class ConvergenceError(RuntimeError):
    """A solve that did not reach its tolerance.

    Parameters
    ----------
    message : str
        Residual, iterations and load, in a sentence.
    history : tuple of float
        Residual of each iteration.
    result : Contact or FixedContactArea or WheelContact
        The last state that was reached. It is no solution.

    Examples
    --------
    >>> body = bem3d.HalfSpace(shape=(32, 32), spacing=1e-4, modulus=1e11, periodic=True)
    >>> gap = 1e-6 * np.random.default_rng(1).standard_normal((32, 32))
    >>> try:
    ...     bem3d.solve(body, gap, force=1.0, max_iterations=1)
    ... except bem3d.ConvergenceError as error:
    ...     print(error.result.status, len(error.history))
    iteration limit 2
    """

    def __init__(self, message: str, history: tuple[float, ...], result: Any):
        super().__init__(message)
        self.history = history
        self.result = result

    def __reduce__(self) -> tuple[Any, ...]:
        return ConvergenceError, (str(self), self.history, self.result)
