"""What the rolling force over isotropic roughness shows: claims, charts and sizes."""

from functools import partial

from validation.analysis.claim_text import THREE_D_DIFFER
from validation.analysis.claims import Matrix
from validation.analysis.evidence import Whose
from validation.analysis.number_text import decibels, decibels_rms, per_cent
from validation.analysis.quantity import MEAN_FORCE, RMS_FORCE
from validation.case import Case, Chapter, Chart, Claim, Curve, Panel, Study
from validation.cases.rolling.force_spectrum import (
    BEM,
    CURVE,
    FOUND,
    HEIGHT,
    INPUT,
    INPUT_LEVEL,
    LINEAR_1D,
    LINEAR_3D,
    LOW,
    MEAN_1D,
    MEAN_LEVEL,
    OVER,
    RMS_LEVEL,
    SHOWN,
    SLOPE,
    SLOPE_COUNTS,
    SPECTRUM,
    SPRINGS,
    SURFACE,
    ForceSpectrum,
    Q,
    run,
    series,
)
from validation.simulation import model_needed
from validation.simulation.model_names import SPRINGS_ROLLING
from validation.simulation.rolling_strip import ASSUMED
from validation.simulation.track_spectrum import INPUT_NAMES

RMS = "rms of "
of_book = partial(Claim, whose=Whose.BOOK, where={HEIGHT: lambda height: height <= LOW})
of_input = partial(Claim, quantity=RMS + INPUT, printed=decibels_rms)
IN_BANDS = partial(Panel, Q, shade=(-1.0, 1.0), lines=(0.0,))
STUDY = Study(
    title="The force along a track over isotropic roughness",
    method=(
        "A wheel rolls at a fixed approach d over self-affine roughness, H = {c.hurst:g}, q a = {c.first:g} to "
        "{c.last:g}, h_rms / d = {c.heights:g}. Boundary elements: {c.strips} surfaces {c.length:g} a long "
        "({c.rough_strips} from h/d = 0.3 on), {c.cells} cells to a contact radius; {c.refined} of them again with "
        "twice as many. Values are extrapolated to first order; the grid leaves half of the extrapolation and its "
        "interval. Springs: {c.tracks} tracks as long, with Geike's spectrum, and as many with the rolling-equivalent "
        "spectrum. Linear theory: (14.12) in 1D, and the same filter on the surface in 3D, both by quadrature. "
        "Boundary elements are taken over linear theory on the same surfaces, which removes most of the scatter. "
        "Levels in octaves, from the longest wave on, are judged by their root mean square. Input spectra of springs "
        "for one surface are Geike's; the line trace, which a measured line has; and the rolling-equivalent spectrum "
        "C_1D(q) = ∫ (1 + q²a²) / (1 + s²a²) C_2D(s) dk, s² = q² + k². They are judged in linear theory on six "
        "spectra. From the levels of the force of boundary elements in one-third octaves, (14.14) and the filter in 3D "
        "are read backwards, the latter by the heights of all bands together that have these levels, with C_2D falling "
        f"as q^-{ASSUMED:g} within a band. "
        + SLOPE_COUNTS
        + "; √2 times that is the rms gradient g of the surface, and the rms slope of Geike's profile."
    ),
    series=series,
    claims=(
        of_book(
            printed=decibels,
            either=(
                {"quantity": CURVE, "model": SPRINGS},
                {"quantity": MEAN_LEVEL, "model": f"{SPRINGS} over {MEAN_1D}"},
            ),
        ).saying(
            "Where h is much smaller than d, the force of springs has the spectrum (14.12), (14.13), and in the mean "
            "(14.14).",
            short="Springs agree with (14.12) and (14.14)",
            key="springs",
        ),
        of_book(
            no=THREE_D_DIFFER,
            printed=lambda number: (decibels_rms if number.quantity == RMS_LEVEL else decibels)(number),
            either=(
                {"quantity": MEAN_LEVEL, "model": MEAN_1D + OVER},
                {"quantity": RMS_LEVEL, "model": LINEAR_1D + OVER},
            ),
        ).saying(
            "Where h is much smaller than d, a wheel on isotropic roughness has the spectrum (14.12) and its mean "
            "(14.14) in three dimensions (Fig. 14.3).",
            short="(14.12) and (14.14) agree with boundary elements",
            key="half-space",
        ),
        of_input(model=INPUT_NAMES["rolling"]).saying(
            "On the rolling-equivalent spectrum (14.12) has the octave levels of linear theory in three dimensions.",
            short="On the rolling-equivalent spectrum (14.12) agrees with linear theory in 3D",
            key="rolling-spectrum",
        ),
        Claim(quantity=RMS_LEVEL, model=SPRINGS_ROLLING + OVER, along=SLOPE, printed=decibels_rms).saying(
            "Springs on the rolling-equivalent spectrum have the octave levels of boundary elements.",
            short="Springs on the rolling-equivalent spectrum agree with boundary elements",
            key="rolling-equivalent-springs",
        ),
        Claim(quantity=(RMS_FORCE, MEAN_FORCE), model=SPRINGS + OVER, along=SLOPE, printed=per_cent).saying(
            "At a given approach springs have the mean and the rms force of boundary elements.",
            short="The mean and the rms force of springs agree with those of boundary elements",
            key="mean-and-rms",
        ),
        Claim(quantity=RMS + FOUND, model=LINEAR_3D, along=SLOPE, printed=decibels_rms).saying(
            "Linear theory in three dimensions, read backwards, gives the roughness from the force between the zeros "
            "of sin(q a).",
            short="Roughness found from the force by linear theory in 3D agrees with the true one",
            key="inverse",
        ),
    ),
    charts=(
        Chart("rolling-line", claims=(0,)).of(
            "Fig. 14.3, H = {c.hurst:g}: spectrum of the normal force. Dashed: (14.12); dotted: its mean "
            "(14.14); dots: one-sided springs at h/d = {c.heights[0]:g}; thick: linear theory in 3D.",
            Panel(Q, "C_F / (F_Hertz² a (h/d)²)", log="xy", decades=7.8).of(
                Curve(SPECTRUM, LINEAR_3D, "thick"),
                Curve(SPECTRUM, SPRINGS, "dots"),
                Curve(SPECTRUM, LINEAR_1D, "lines"),
                Curve(SPECTRUM, MEAN_1D, "lines"),
            ),
        ),
        Chart("rolling", claims=(1,)).of(
            "Level of the force in one-third octaves, over (h/d)² and the square of Hertz's force. Circles: boundary "
            "elements, 95 % of sample and grid; squares: one-sided springs, Geike's spectrum; solid: linear theory in "
            "3D; dashed: (14.12), which is zero below the band, left of the vertical line.",
            Panel(Q, "one-third octave level [dB]", facet=HEIGHT, ylim=(-66.0, -2.0), at=(1.0,)).of(
                Curve(SHOWN, LINEAR_3D, "lines"),
                Curve(SHOWN, LINEAR_1D, "lines"),
                Curve(SHOWN, SPRINGS, "marks"),
                Curve(SHOWN, BEM, "marks", bars=True),
            ),
        ),
        Chart("rolling-input", claims=(2,)).of(
            "Level of (14.12) with each input spectrum over that of linear theory in 3D, in one-third octaves; shaded: "
            "within 1 dB.",
            IN_BANDS("(14.12) over linear theory in 3D [dB]", facet=SURFACE, ylim=(-11.0, 11.0)).of(
                Curve(INPUT_LEVEL, by=("model",))
            ),
        ),
        Chart("rolling-backwards", claims=(5,)).of(
            "Mean square height of the waves in one-third octaves without a zero of sin(q a), found from the force of "
            "boundary elements over the true one, by filter; 95 % of sample and grid. Shaded: within 1 dB.",
            IN_BANDS("roughness found over true [dB]", facet=HEIGHT, ylim=(-14.0, 8.0)).of(
                Curve(FOUND, by=("model",), bars=True)
            ),
        ),
    ),
    matrices=(
        Matrix(
            name="rms over octaves, over boundary elements", quantity=RMS_LEVEL, rows=(HEIGHT, SLOPE), columns="model"
        ),
        Matrix(
            name="rms over octaves, (14.12) over linear theory in 3D",
            quantity=RMS + INPUT,
            rows=(SURFACE,),
            columns="model",
        ),
        Matrix(
            name="springs over boundary elements",
            quantity=(RMS_FORCE, MEAN_FORCE),
            model=SPRINGS + OVER,
            rows=(HEIGHT, SLOPE),
            columns="quantity",
            printed=per_cent,
        ),
        Matrix(
            name="rms of roughness found between zeros", quantity=RMS + FOUND, rows=(HEIGHT, SLOPE), columns="model"
        ),
    ),
)
CASE = Case(
    name="rolling",
    chapter=Chapter.ROLLING,
    place=2,
    answers="Fig. 14.3: the rolling force over isotropic roughness, in one dimension and in three",
    quick=ForceSpectrum(
        heights=(0.01, 0.3, 1.0),
        last=9.0,
        lowest=0.55,
        length=48.0,
        cells=6,
        strips=8,
        rough_strips=3,
        refined=8,
        tracks=40,
    ),
    full=ForceSpectrum(
        heights=(0.01, 0.03, 0.1, 0.3, 1.0),
        last=20.0,
        lowest=0.22,
        length=256.0,
        width=32.0,
        cells=16,
        strips=6,
        rough_strips=8,
        refined=4,
        tracks=400,
    ),
    run=run,
    study=STUDY,
    needs=model_needed.rolling,
)
