"""What happens when an iteration does not reach its tolerance: an exception that keeps the evidence."""

from typing import Any


class ConvergenceError(RuntimeError):
    """A solve that did not reach its tolerance.

    history: the residual of each iteration; result: the last that was reached, a `Contact` or `FrozenContact` and no
    solution.
    """

    def __init__(self, message: str, history: tuple[float, ...], result: Any):
        super().__init__(message)
        self.history = history
        self.result = result

    def __reduce__(self) -> tuple[Any, ...]:
        return ConvergenceError, (str(self), self.history, self.result)
