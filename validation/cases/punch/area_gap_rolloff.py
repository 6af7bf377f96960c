"""What MDR does not model: contact area, mean gap, and punches whose longest wave is a part of the side."""

from dataclasses import dataclass

from validation.cases.punch.ensembles import PunchEnsembles, press
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.simulation.rough_punch import PunchRoughness


@dataclass(frozen=True, kw_only=True)
class MdrLimits(PunchEnsembles):
    """The punches of Fig. 14.1 and others whose spectrum is zero below a roll-off.

    hurst; roll_offs: q_r L / 2 pi, waves of the longest on a side, 1 first; refined: surfaces pressed again on twice as
    many cells a side.
    """

    hurst: float = 0.7
    roll_offs: tuple[int, ...] = (1, 8)
    surfaces: int = 12
    refined: int = 8
    seed: int = 142

    def roughness(self, roll_off: int) -> PunchRoughness:
        """No wave longer than L / roll_off."""
        return self.band(self.hurst, first=roll_off)


@dataclass(frozen=True)
class MdrLimitsResult:
    """Outcomes by roll-off: rows of their arrays are realisations, columns are forces; refined: on finer cells."""

    case: MdrLimits
    bem: dict[int, Outcome]
    refined: dict[int, Outcome]
    mdr: dict[int, Outcome]
    unconverged: tuple[str, ...]


def run(case: MdrLimits, engine: Engine = SERIAL) -> MdrLimitsResult:
    """Press surfaces and profiles of every roll-off with equal forces."""
    surfaces = {
        (roll_off, cells): [case.surface_of(case.roughness(roll_off), i, cells, case.forces) for i in range(count)]
        for roll_off in case.roll_offs
        for cells, count in ((case.cells, case.surfaces), (2 * case.cells, case.refined))
    }
    profiles = {roll_off: case.profiles_of(case.roughness(roll_off), case.points) for roll_off in case.roll_offs}
    bem, mdr, unconverged = press(engine, surfaces, profiles)
    coarse, fine = ({r: bem[r, cells] for r in case.roll_offs} for cells in (case.cells, 2 * case.cells))
    return MdrLimitsResult(case, coarse, fine, mdr, unconverged)
