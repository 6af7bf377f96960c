"""Fig. 14.5 and the steady state: what is claimed of regions 1, 2 and 4."""

from collections.abc import Sequence
from dataclasses import replace

from validation.analysis.chart import by_model
from validation.analysis.evidence import Whose
from validation.analysis.number_text import share
from validation.case import Case, Chapter, Chart, Claim, Curve, Outcomes, Panel, Study
from validation.cases.wheel import distance, ensembles
from validation.cases.wheel.distance import BOOK, CUT, HANN, LINEAR, PERIODIC, SECOND_ORDER, SPRINGS
from validation.cases.wheel.ensembles import DENSITY, FIRST, FOURTH, OMEGA, PLATEAU, TABLE, regions_of
from validation.simulation import model_needed
from validation.simulation.wheel_on_springs import WAVES_APART

BY_DISTANCE = Panel(OMEGA, DENSITY, log="xy").of(
    Curve(distance.SPECTRA, "spectrum", by=(distance.DISTANCE,)),
    Curve(distance.SPECTRA, "break", "open marks", "_", by=(distance.DISTANCE,)),
)
BREAKS = Panel(distance.DURATION, distance.BREAK_AT, log="xy").of(
    *by_model(
        distance.BREAK_AT,
        {"found": "marks", "by the jumps of the records": "crosses", "T^(1/(2H+1))": "black"},
        bars=True,
    )
)
RECORDS = Panel(OMEGA, DENSITY, log="xy", decades=11.0).of(
    *by_model(
        distance.BY_KIND,
        {
            f"{SPRINGS}, {BOOK}": "lines",
            f"{LINEAR}, {BOOK}": "lines",
            f"{SPRINGS}, {CUT}": "lines",
            f"{SPRINGS}, {HANN}": "lines",
            f"{SPRINGS}, {PERIODIC}": "thick",
        },
    )
)


LOW = Panel(OMEGA, DENSITY, log="xy").of(
    Curve(distance.UP_TO_JUMP, SPRINGS, by=(distance.H_OVER_D,), of={distance.DAMPING: "first"}),
    Curve(distance.UP_TO_JUMP, SECOND_ORDER, "dashed", "_", by=(distance.H_OVER_D,), of={distance.DAMPING: "first"}),
)
SHORT = Panel(OMEGA, DENSITY, log="y").of(*by_model(distance.SHORT_WAVES, {SECOND_ORDER: "", SPRINGS: "marks"}))


def notes(result: Outcomes) -> Sequence[str]:
    """What region 1 is, and what the record of the book adds to regions 1 and 2."""
    case, bands, book = result.case, regions_of(result.case.scene), distance.RECORDS[BOOK]
    scene = case.ensemble(distance.STEADY).scene
    integral = distance.theory_of(scene).over_resonance(
        ensembles.roughness(scene), q_max=scene.cutoff / scene.rolling_speed
    )
    (first, plateau), linear = (
        [book.of(result, bands[region], model).mean() for region in (FIRST, PLATEAU)] for model in (SPRINGS, LINEAR)
    )
    steady = distance.RECORDS[PERIODIC].of(result, bands[PLATEAU], SPRINGS).mean()
    return (
        "Region 1 of a steady state is an integral over the resonance, of the second order: ∫ A df = A_F₂(ω_eigen) "
        f"ω_eigen / (8 ζ M²) = {integral:.3g} (m/s²)² at ζ = {100 * case.damping:g} %. It goes as 1/ζ, and without "
        "damping it has no value.",
        "From rest, undamped and without a window, as in the book, the linear contact has "
        f"{100 * linear[0] / first:.3g} % of the power of region 1: free vibration since the start, which nothing "
        "damps.",
        f"Region 2 has {plateau / steady:.3g} times the power of the steady state, and the linear contact has "
        f"{100 * linear[1] / plateau:.3g} % of that: it leaks from region 3 through the ends of a record of "
        f"{case.scene.length:.3g} m.",
    )


STUDY = Study(
    title="Fig. 14.5 and the steady state: regions 1, 2 and 4",
    method=(
        "Fig. 14.5: {c.wheels} and fewer wheels of {c.scene.name} over whole natural periods, from static equilibrium; "
        f"open tracks, whose end is {WAVES_APART} longest waves from their beginning. Steady states: {{c.steady}} "
        "wheels on periodic tracks of {c.scene.length:.3g} m twice; shooting finds the approach and the velocity with "
        "which the motion repeats itself, with a dashpot of {c.damping:.0%} of critical damping and without one. "
        "Recorded are the whole round, in which nothing leaks, or half of it, with Hann's window or none. The linear "
        "contact of fixed radius, (14.11), rolls on the same tracks: its waves end at q_min v₀ and q_max v₀, so that "
        "all it has elsewhere leaks through the ends of the record. The second order in closed form: at the ends of "
        "the contact the heights over the wheel in its linear motion, u and v, lengthen the contact, F₂ = E* R / (4a) "
        "(u² + v²); for Gaussian heights its spectrum is a convolution of the band with itself, and the damped wheel "
        "is its resonator. It has no free parameter. Region 1 of the second order is the integral over the resonance, "
        "A_F₂(ω_eigen) ω_eigen / (8 ζ M²); of springs, the lines about ω_eigen over their gain are the force that "
        "excites it. Shares of region 1 are from 0.5 to 2 ω_eigen, region 2 is measured from there "
        "to 0.8 q_min v₀, region 4 from 1.3 to 2.6 q_max v₀, where its floor stands alone. Short waves: {c.short:g} m "
        "and less, h₀ = {c.rms:g} m."
    ),
    series=distance.series,
    claims=(
        Claim(whose=Whose.BOOK, quantity=distance.SHARE, model=LINEAR, printed=share).saying(
            "Regions 1 and 2 arise from the non-linearity of the contact: in a steady state a linear contact has "
            "neither.",
            short="A linear contact in a steady state has none of the power of springs in regions 1 and 2",
            key="regions-1-and-2",
        ),
        Claim(
            whose=Whose.BOOK,
            either=({"quantity": distance.BREAK_LAW}, {"quantity": distance.SHARE, "where": {"region": FOURTH}}),
        ).saying(
            "Region 4 is an artefact: leakage through the ends of the finite record.",
            short="Region 4 agrees with leakage of the finite record",
            key="region-4",
        ),
        Claim(quantity=(distance.CONTRAST, distance.OVER), along=distance.H_OVER_D).saying(
            "A closed theory of second order in the roughness, without a free parameter, gives regions 1 and 2 of "
            "springs.",
            short="Regions 1 and 2 of springs agree with a closed theory of second order",
            key="second-order",
        ),
    ),
    charts=(
        Chart("wheel_distance", claims=(1,)).of(
            "Fig. 14.5. (a) Spectra without window, dark to light from the shortest distance to the longest; open "
            "marks: the break. (b) The break against the duration with 95 % intervals; crosses: predicted by the jumps "
            "of the same records; line: T^(1/(2H+1)) through the middle.",
            BY_DISTANCE,
            BREAKS,
        ),
        Chart("wheel_distance-steady", claims=(0, 2)).of(
            "(a) From rest as in the book, and in a steady state damped by {c.damping:.0%}, with and without a window. "
            "(b) Regions 1 and 2 of the periodic motion, line by line, dark to light with the height; black: second "
            "order in closed form. (c) The same of region 2 over short waves, and the zeros of cos²(q a).",
            RECORDS,
            LOW,
            SHORT,
        ),
    ),
    printed=(distance.OF_REGION, distance.OF_RESONANCE),
    notes=notes,
)
CASE = Case(
    name="wheel_distance",
    chapter=Chapter.WHEEL,
    place=2,
    answers="Fig. 14.5 and the steady state: where regions 1 and 2 come from, and that region 4 is leakage",
    quick=distance.WheelDistance(scene=replace(distance.SHORT, springs=64), doublings=3, wheels=40),
    full=distance.WheelDistance(
        scene=TABLE,
        doublings=6,
        wheels=300,
        fewest=40,
        steady=120,
        heights=(0.5, 1.0, 2.0, 4.0),
        rms=0.15e-6,
    ),
    run=distance.run,
    study=STUDY,
    needs=model_needed.wheel,
)
