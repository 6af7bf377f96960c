"""Arrays that do not fit into the memory of this machine raise MemoryError before any work."""

import numpy as np


def fits(name: str, value: object, needed: int) -> None:
    """MemoryError naming the argument that asks for so many bytes, where the machine does not give them."""
    try:
        # asked for and not touched, which takes no time
        np.empty(needed, dtype=np.uint8)
    except (MemoryError, ValueError):
        raise MemoryError(
            f"{name} must be smaller: {value} needs about {needed / 1e9:.3g} GB of memory, more than there is"
        ) from None
