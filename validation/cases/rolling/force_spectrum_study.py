"""What rolling over isotropic roughness shows, declared: method, claims and figures."""

from functools import partial

from validation.analysis.case import Case, Chapter
from validation.analysis.chart import Chart, Curve, Map, Panel
from validation.analysis.claims import Claim, Matrix
from validation.analysis.study import Study
from validation.cases.rolling import force_spectrum as shown
from validation.cases.rolling.settings import HEIGHT, SLOPE, SLOPE_COUNTS, Q
from validation.selection import model_needed

LEVELS, CHANGES = (shown.LEVEL, "rms of " + shown.LEVEL), (shown.NONLINEAR, "rms of " + shown.NONLINEAR)
BY_HEIGHT = partial(Curve, by=(HEIGHT,))
up_to = partial(Claim, along=HEIGHT)
has_levels = partial(up_to, quantity=LEVELS)
STUDY = Study(
    title="Rolling over isotropic roughness: levels of 1D models against boundary elements",
    method=(
        "A wheel rolls at a fixed approach d over self-affine roughness, H = {c.hurst:g}, q a = {c.first:g} to "
        "{c.last:g}, h_rms / d = {c.heights:g}. Boundary elements: {c.strips} surfaces {c.length:g} a long "
        "({c.rough_strips} from h/d = 0.3 on), {c.cells} cells to a contact radius; {c.refined} of them again with "
        "twice as many. Levels are extrapolated to first order; ± grid is half of the extrapolation, plus its sampling "
        "interval. Springs: {c.tracks} tracks as long, with Geike's spectrum, and with the rolling-equivalent "
        "spectrum, which has the level of linear theory in 3D along the track (case rolling_input). Linear theory: "
        "(14.12) in 1D, and the same filter on the surface in 3D, both by quadrature. Levels of the force in one-third "
        "octaves of q a are powers, in dB. Boundary elements are taken over linear theory on the same surfaces, which "
        "removes most of the scatter. A range of bands is judged by its worst one-third octave, within 3 dB, and by "
        "the root mean square over its bands, within 1 dB. Errors of both signs do not cancel in either. "
        + SLOPE_COUNTS
        + "; √2 times that is the rms gradient g of the surface, and the rms slope of Geike's profile."
    ),
    series=shown.series,
    claims=(
        has_levels(model=(shown.LINEAR_1D + shown.OVER, shown.SPRINGS + shown.OVER)).saying(
            "Springs with Geike's spectrum have the force spectrum of a wheel that rolls over isotropic roughness "
            "(Fig. 14.3).",
            short="Springs with Geike's spectrum, level over boundary elements",
        ),
        has_levels(model=shown.ROLLING_SPRINGS + shown.OVER).saying(
            "With the rolling-equivalent spectrum, springs have the level of boundary elements in each one-third "
            "octave."
        ),
        has_levels(model=shown.LINEAR_3D + shown.OVER).saying(
            "Linear theory in 3D has the level of boundary elements in each one-third octave.",
            short="Linear theory in 3D, level over boundary elements",
        ),
        up_to(quantity=CHANGES).saying(
            "Nonlinearity changes the level of springs as it changes that of boundary elements.",
            short="Nonlinearity, springs beside boundary elements",
        ),
        up_to(quantity=shown.VARIANCE).saying(
            "The force at one position has the variance of linear theory, which Geike's rule keeps."
        ),
        up_to(says="Springs have the mean force of boundary elements.", quantity=shown.MEAN),
    ),
    charts=(
        Chart("rolling-line", claims=(), width=6.4).of(
            "Fig. 14.3, H = {c.hurst:g}: spectrum of the normal force over wavenumber. Line: (14.12); dashed: its mean "
            "(14.14); dots: one-sided springs at h/d = {c.heights[0]:g}; thick grey: linear theory in 3D.",
            Panel(Q, "C_F / (F_Hertz² a (h/d)²)", log="xy", decades=7.8, legend="lower left").of(
                Curve(shown.SPECTRUM, shown.LINEAR_3D, "thick", "linear theory, 3D"),
                Curve(shown.SPECTRUM, shown.SPRINGS, "dots", "springs"),
                Curve(shown.SPECTRUM, "(14.12)", "exact", "(14.12)"),
                Curve(shown.SPECTRUM, "(14.14)", "other", "(14.14)"),
            ),
        ),
        Chart("rolling", columns=3, sharey=True, width=9.0, height=5.8).of(
            "Level of the force in one-third octaves, over (h/d)² and the square of Hertz's force. Circles: boundary "
            "elements, 95 % of sample and grid; squares: one-sided springs, Geike's spectrum; solid: linear theory in "
            "3D; dashed: (14.12), which is zero below the band, left of the vertical line.",
            Panel(Q, "one-third octave level [dB]", facet=HEIGHT, ylim=(-66.0, -2.0), at=(1.0,)).of(
                Curve(shown.SHOWN, shown.LINEAR_3D, "exact", "linear theory, 3D"),
                Curve(shown.SHOWN, shown.LINEAR_1D, "other", "linear theory, 1D (14.12)"),
                Curve(shown.SHOWN, shown.SPRINGS, "mdr", "springs"),
                Curve(shown.SHOWN, "bem3d", "bem", "boundary elements", bars=True),
            ),
        ),
        Chart("rolling-coherence", claims=(3,)).of(
            "(a) Coherence with linear theory: filled, boundary elements; open, springs. (b) Nonlinear over linear "
            "level. Dark to light: h/d. (c) Force along the track at three h/d, about its mean: line, boundary "
            "elements; dotted, linear theory.",
            Panel(Q, "coherence", title="with linear theory", ylim=(-0.03, 1.05)).of(
                BY_HEIGHT(shown.COHERENCE, "bem3d"), BY_HEIGHT(shown.COHERENCE, shown.SPRINGS, "open", "_")
            ),
            Panel(Q, "nonlinear over linear [dB]", title="level").of(
                BY_HEIGHT(shown.NONLINEAR, "bem3d", label="_"), BY_HEIGHT(shown.NONLINEAR, shown.BOTH, "open", "_")
            ),
            Panel("x / a", "(F - mean) / (F_Hertz h/d), shifted", title="force along the track", log="").of(
                BY_HEIGHT(shown.FORCE, "bem3d", "lines", "_", down=3.2),
                BY_HEIGHT(shown.FORCE, shown.LINEAR_3D, "dotted", "_", down=3.2),
            ),
        ),
        Chart(
            "rolling-map",
            "Level of each model over that of boundary elements, over q a and h/d. Solid lines: ± 1 dB; dashed: ± 3 "
            "dB; hatched: more than 3 dB too low. Left of the vertical line: below the band.",
            Map(shown.LEVEL, Q, HEIGHT, "model", "level over boundary elements [dB]", at=(1.0,)),
            claims=(2,),
        ),
    ),
    matrices=tuple(
        Matrix(name=name, quantity=quantity, rows=(HEIGHT, Q), columns="model")
        for name, quantity in zip(
            ("worst one-third octave over boundary elements", "root mean square over the bands"), LEVELS, strict=True
        )
    ),
    printed=(SLOPE, shown.CORRELATION, shown.VARIANCE, shown.MEAN, shown.APPLICATIONS),
)
CASE = Case(
    name="rolling",
    chapter=Chapter.ROLLING,
    place=2,
    answers="Fig. 14.3: rolling force over isotropic roughness, where each model holds",
    quick=shown.ForceSpectrum(
        heights=(0.01, 0.3, 1.0),
        last=5.7,
        lowest=0.55,
        length=48.0,
        cells=6,
        strips=8,
        rough_strips=3,
        refined=8,
        tracks=40,
    ),
    full=shown.ForceSpectrum(
        heights=(0.003, 0.01, 0.03, 0.1, 0.3, 1.0),
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
    run=shown.run,
    study=STUDY,
    needs=model_needed.rolling,
)
