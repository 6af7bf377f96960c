"""Fig. 14.5: what the ends of records do to a spectrum."""

from dataclasses import replace

from validation.analysis.case import Case, Chapter
from validation.analysis.chart import Chart, Curve, Panel, by_model
from validation.analysis.claims import Claim
from validation.analysis.study import Study
from validation.cases.wheel import distance
from validation.cases.wheel.features import DENSITY, FOURTH, LEVEL, OMEGA, PEAK, QUANTITIES, TABLE
from validation.selection import model_needed
from validation.simulation.wheel_on_springs import WAVES_APART

LINEAR_OVER = f"{distance.LINEAR_OPEN}, over {distance.OPEN}"
BY_DISTANCE = Panel(OMEGA, DENSITY, log="xy", legend="lower left").of(
    Curve(distance.SPECTRA, "spectrum", by=(distance.DISTANCE,)),
    Curve(distance.SPECTRA, "break", "open marks", "_", by=(distance.DISTANCE,)),
)
BREAKS = Panel(distance.DURATION, distance.BREAK_AT, log="xy", legend="upper left").of(
    *by_model(
        distance.BREAK_AT,
        {"found": "bem", "by the jumps of the records": "crosses", "T^(1/(2H+1))": "exact"},
        bars=True,
    )
)
CAUSES = Panel(OMEGA, DENSITY, log="xy", decades=11.0, legend="lower left").of(
    *by_model(
        distance.CAUSE,
        {
            distance.STEADY: "thick",
            distance.OPEN: "mdr line",
            distance.PERIODIC: "other",
            distance.HANN: "exact",
            distance.LINEAR_OPEN: "guide",
        },
    )
)
HEIGHTS = Panel(distance.H_OVER_D, "mean of A in region 2 [dB over (m/s²)² s]", legend="lower right").of(
    Curve(distance.BY_HEIGHT, distance.OPEN, "mdr", distance.OPEN, bars=True),
    Curve(distance.BY_HEIGHT, distance.LINEAR_OPEN, "crosses", "linear, open: leakage", bars=True),
    Curve(distance.BY_HEIGHT, distance.STEADY, "bem, few cells", "springs, steady: nonlinearity", bars=True),
    *by_model(distance.BY_HEIGHT, {"h^2": "exact", "h^4": "guide"}),
)
AMPLITUDES = Panel(distance.RELEASE, distance.OVER_EIGEN, log="", legend="lower left").of(
    *by_model(distance.OVER_EIGEN, {"Hertz, quadrature": "exact", "springs": "mdr"}, bars=True)
)
STUDY = Study(
    title="Fig. 14.5: the break, the plateau and the ends of a record",
    method=(
        "Wheels of {c.scene.name}, {c.wheels} and fewer, over whole natural periods, from static equilibrium; and over "
        "{c.scene.length:.3g} m with every contact and track. "
        f"Open tracks: their end is {WAVES_APART} longest waves from their beginning. "
        "Periodic tracks: their end is their beginning, after a whole number of natural periods. "
        "Steady-state motion on a periodic track: shooting finds the approach and the velocity with which the motion "
        "repeats itself; it has no free vibration, and nothing leaks. The linear contact of fixed radius, (14.11), "
        "rolls on the same tracks as springs. Its waves end at q_min v₀ and q_max v₀, so its level in regions 2 and 4 "
        "is leakage alone; that of springs in the steady state is nonlinearity alone. Region 1 is measured from 0.5 to "
        "2 ω_eigen, region 2 from 2 ω_eigen to 0.8 q_min v₀, region 3 from 1.1 q_min v₀ over half a period of its "
        "oscillation, region 4 from 1.3 to 2.6 q_max v₀."
    ),
    series=distance.series,
    claims=(
        Claim(either=({"quantity": distance.BREAK_LAW}, {"model": LINEAR_OVER, "where": {"region": FOURTH}})).saying(
            "The break that moves with the distance is leakage (Fig. 14.5).", short="The break is that of leakage"
        ),
        Claim(quantity=LEVEL, model=LINEAR_OVER, differ=True).saying(
            "Regions 1, 2 and 4 arise from the non-linearity of the contact.",
            short="Regions 1, 2 and 4 of a linear contact and of springs",
        ),
        Claim(quantity=QUANTITIES[PEAK]).saying(
            "The frequency of the peak depends on the amplitude as on a Hertz contact."
        ),
    ),
    charts=(
        Chart("wheel_distance").of(
            "Fig. 14.5. (a) Spectra without window, dark to light from the shortest distance to the longest; open "
            "marks: the break. (b) The break against the duration with 95 % intervals; crosses: predicted by the jumps "
            "of the same records; line: T^(1/(2H+1)) through the middle.",
            BY_DISTANCE,
            BREAKS,
        ),
        Chart("wheel_distance-cause", claims=(1,), width=12.5).of(
            "(a) Wheels over {c.scene.length:.3g} m by contact and track. (b) Region 2 against the roughness, and h² "
            "and h⁴. (c) The peak against the amplitude of free vibration; line: quadrature, Hertz.",
            CAUSES,
            HEIGHTS,
            AMPLITUDES,
        ),
    ),
    printed=(distance.OF_REGION, distance.BY_HEIGHT, distance.BY_PHASE),
)
CASE = Case(
    name="wheel_distance",
    chapter=Chapter.WHEEL,
    place=2,
    answers="Fig. 14.5: the break that moves with the distance, its cause, and the share of leakage in the plateau",
    quick=distance.WheelDistance(scene=replace(distance.SHORT, springs=64), doublings=3, wheels=40, causes=10),
    full=distance.WheelDistance(
        scene=TABLE,
        doublings=6,
        wheels=300,
        fewest=40,
        causes=60,
        rough=20,
        heights=(0.125, 0.25, 0.5, 1.0, 2.0, 4.0),
        phases=(0.0, 0.25, 0.5),
        releases=(0.0, 0.1, 0.2, 0.4),
        released=5,
    ),
    run=distance.run,
    study=STUDY,
    needs=model_needed.wheel,
)
