"""Small rough punches, apart from the tests: workers import these for their toys, and need not import cases."""

from validation.cases.punch import fractal_punch
from validation.simulation.rough_punch import press_surface

__all__ = ["SMALL", "SURFACES", "fractal_punch", "press_surface"]

SMALL = fractal_punch.FractalPunch(
    hursts=(0.7,),
    cells=16,
    surfaces=((0, 4, 4, 4, 0),),
    profiles=6,
    fine_profiles=3,
    points=64,
    decades=(-1, 0),
    per_decade=1,
)
SURFACES = [SMALL.surface(0.7, i, 32) for i in range(4)] + [SMALL.surface(0.7, i, 16) for i in range(4)]
