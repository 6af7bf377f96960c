"""Fig. 14.5: what the ends of records do to a spectrum."""

from dataclasses import replace

from validation.analysis.case import Case, Chapter
from validation.analysis.chart import Chart, Curve, Panel
from validation.analysis.claims import Claim
from validation.analysis.study import Study
from validation.cases.wheel.distance import (
    BREAK_AT,
    BREAK_LAW,
    BY_HEIGHT,
    BY_PHASE,
    CAUSE,
    DISTANCE,
    DURATION,
    H_OVER_D,
    HANN,
    LEVEL,
    LINEAR_OPEN,
    OF_REGION,
    OMEGA,
    OPEN,
    OVER_EIGEN,
    PEAK_AT,
    PERIODIC,
    RELEASE,
    SHORT,
    STEADY,
    TABLE,
    A,
    WheelDistance,
    run,
    series,
)
from validation.cases.wheel.features import FOURTH
from validation.selection import model_needed
from validation.simulation.wheel_on_springs import WAVES_APART

LINEAR_OVER, DENSITY, MODEL = f"{LINEAR_OPEN}, over {OPEN}", "A [(m/s²)² s]", ("model",)
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
    series=series,
    claims=(
        Claim(
            says="The break that moves with the distance is leakage (Fig. 14.5).",
            short="The break is that of leakage",
            either=({"quantity": BREAK_LAW}, {"model": LINEAR_OVER, "where": {"region": FOURTH}}),
        ),
        Claim(
            says="Regions 1, 2 and 4 arise from the non-linearity of the contact.",
            short="A linear contact has other regions 1, 2 and 4",
            quantity=LEVEL,
            model=LINEAR_OVER,
            differ=True,
        ),
        Claim(says="The frequency of the peak depends on the amplitude as on a Hertz contact.", quantity=PEAK_AT),
    ),
    charts=(
        Chart(
            "wheel_distance",
            "Fig. 14.5. (a) Spectra without window, dark to light from the shortest distance to the longest; open "
            "marks: the break. (b) The break against the duration with 95 % intervals; crosses: predicted by the jumps "
            "of the same records; line: T^(1/(2H+1)) through the middle.",
            (
                Panel(
                    OMEGA,
                    DENSITY,
                    (
                        Curve(A, "spectrum", by=(DISTANCE,)),
                        Curve(A, "break", "open marks", "_", by=(DISTANCE,)),
                    ),
                    log="xy",
                    legend="lower left",
                ),
                Panel(
                    DURATION,
                    BREAK_AT,
                    (
                        Curve(BREAK_AT, "found", "bem", "found", bars=True),
                        Curve(BREAK_AT, "by the jumps of the records", "crosses", by=MODEL),
                        Curve(BREAK_AT, "T^(1/(2H+1))", "exact", by=MODEL),
                    ),
                    log="xy",
                    legend="upper left",
                ),
            ),
        ),
        Chart(
            "wheel_distance-cause",
            "(a) Wheels over {c.scene.length:.3g} m by contact and track. (b) Region 2 against the roughness, and h² "
            "and h⁴. (c) The peak against the amplitude of free vibration; line: quadrature, Hertz.",
            (
                Panel(
                    OMEGA,
                    DENSITY,
                    (
                        Curve(CAUSE, STEADY, "thick", by=MODEL),
                        Curve(CAUSE, OPEN, "mdr line", by=MODEL),
                        Curve(CAUSE, PERIODIC, "other", by=MODEL),
                        Curve(CAUSE, HANN, "exact", by=MODEL),
                        Curve(CAUSE, LINEAR_OPEN, "guide", by=MODEL),
                    ),
                    log="xy",
                    decades=11.0,
                    legend="lower left",
                ),
                Panel(
                    H_OVER_D,
                    "mean of A in region 2 [dB over (m/s²)² s]",
                    (
                        Curve(BY_HEIGHT, OPEN, "mdr", OPEN, bars=True),
                        Curve(BY_HEIGHT, LINEAR_OPEN, "crosses", f"{LINEAR_OPEN}: leakage", bars=True),
                        Curve(BY_HEIGHT, STEADY, "bem, few cells", f"{STEADY}: nonlinearity", bars=True),
                        Curve(BY_HEIGHT, "h^2", "exact", by=MODEL),
                        Curve(BY_HEIGHT, "h^4", "guide", by=MODEL),
                    ),
                    legend="lower right",
                ),
                Panel(
                    RELEASE,
                    OVER_EIGEN,
                    (
                        Curve(OVER_EIGEN, "Hertz, quadrature", "exact", by=MODEL),
                        Curve(OVER_EIGEN, "springs", "mdr", "springs", bars=True),
                    ),
                    log="",
                    legend="lower left",
                ),
            ),
            claims=(1,),
            width=12.5,
        ),
    ),
    printed=(OF_REGION, BY_HEIGHT, BY_PHASE),
)
CASE = Case(
    name="wheel_distance",
    chapter=Chapter.WHEEL,
    place=2,
    answers="Fig. 14.5: the break that moves with the distance, its cause, and the share of leakage in the plateau",
    quick=WheelDistance(scene=replace(SHORT, springs=64), doublings=3, wheels=40, causes=10),
    full=WheelDistance(
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
    run=run,
    study=STUDY,
    needs=model_needed.wheel,
)
