"""The figures of `compare` as charts: spectra with their error, a row a model, sweeps, and error over seconds."""

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial

import numpy as np
from matplotlib.axes import Axes

from validation.advice.compare import Comparison, OneOrSeveral, comparisons_of
from validation.advice.exported import csv_table
from validation.advice.table import by_quantity, counted_bands, reference_of, shown_models, speed_and_accuracy
from validation.analysis.chart import Chart, Curve, Panel
from validation.analysis.evidence import Table, table_of
from validation.analysis.series import ENDS
from validation.report.drawing import DrawnPanel, drawn_on, picture_of
from validation.report.style import FORMATS, in_two_lines, legend_name

MOST = 5
"""Curves in one panel: of more, none is told from the others."""
NAME = 48
"""Characters of a line of a name."""
ALONE = 3.6
"""Height of a panel of a sweep by itself [inch]."""
WAVELENGTH, FREQUENCY, SECONDS = "wavelength [mm]", "frequency [Hz]", "time of the solves [s]"
"""Names of axes."""


def to_figure(comparison: OneOrSeveral, *, form: str = "svg") -> bytes:
    """Picture of a comparison: the models that were solved, the selected one with its error.

    Of spectra at most five: the selected model, the reference, springs of MDR, and what is nearest to the selected.

    Parameters
    ----------
    comparison : Comparison or list of Comparison
        What `compare` returns; of a list a panel a quantity, of a sweep or with the selected model of each scene.
    form : str, optional
        "svg", "png" or "pdf".

    Returns
    -------
    bytes
        The file that ``mdr-validation compare --figure FILE`` writes.

    Raises
    ------
    ValueError
        For another form.

    Examples
    --------
    >>> picture = validation.to_figure(validation.compare(validation.load_scene("sphere")), form="png")
    >>> picture[1:4]
    b'PNG'
    """
    if form not in FORMATS:
        raise ValueError(f"form must be one of {', '.join(FORMATS)}, got {form!r}")
    comparisons = comparisons_of(comparison)
    title, drawn = panels_of(comparisons)
    return _picture(title, drawn, form, partial(names_of_users, comparisons))


def plot(comparison: Comparison, ax: Axes | None = None) -> Axes:
    """The first panel of `to_figure` on axes of a user, or on those of a new figure."""
    (panel, table), *_ = _panels_of_quantity([comparison])
    names = [str(name) for name in table.columns.get("model", ())]
    title = f"{comparison.scene.name}: {comparison.quantity}"
    return drawn_on(ax, replace(panel, title=title), table, names_of_users([comparison], names))


def panels_of(comparisons: Sequence[Comparison]) -> tuple[str, list[DrawnPanel]]:
    """The title of a figure, and its panels with their tables: those of each quantity in turn."""
    drawn = [panel for group in by_quantity(comparisons).values() for panel in _panels_of_quantity(group)]
    scenes = {comparison.swept.scene if comparison.swept else comparison.scene.name for comparison in comparisons}
    quantities = ", ".join(by_quantity(comparisons))
    title = f"{scenes.pop()}: {quantities}" if len(scenes) == 1 else quantities
    count = max(len(_names_of_curves(group)) for group in by_quantity(comparisons).values())
    return f"{title}; {MOST} curves of {count}, all are in the CSV" if count > MOST else title, drawn


def _picture(title: str, drawn: Sequence[DrawnPanel], form: str, users: Callable[[list[str]], Iterable[str]]) -> bytes:
    """A picture of panels. users: which of the names in it are not the package's own."""
    alone = ALONE * (len(drawn) == 1 and not drawn[0][0].facet)
    panels = tuple(replace(panel, height=panel.height or alone) for panel, _ in drawn)
    columns = 1 if all(panel.height for panel in panels) else 0
    tables = [table for _, table in drawn]
    names = [str(name) for table in tables for name in table.columns.get("model", ())]
    chart = Chart("compare", panels=panels, title=in_two_lines(title), columns=columns)
    return picture_of(chart, tables, form, users=set(users(names)))


def names_of_users(comparisons: Sequence[Comparison], shown: Sequence[str]) -> set[str]:
    """Of the names that a figure shows those that are not the package's own: of scenes, and of models of a user's."""
    candidates = [candidate for comparison in comparisons for candidate in comparison.selection.candidates]
    own = {
        str(candidate.name)
        for candidate in candidates
        if not getattr(getattr(candidate.model, "model", candidate), "setting", "").startswith("@")
    }
    return set(shown) - own


def _panels_of_quantity(comparisons: Sequence[Comparison]) -> list[DrawnPanel]:
    """Panels of one quantity: of a sweep, of a spectrum, or of a number by each model."""
    if len(comparisons) > 1 and comparisons[0].swept is not None:
        return list(_panels_of_sweep(comparisons))
    table = csv_table(comparisons)
    if len(comparisons) > 1:
        selected = table.where(selected=True)
        table = Table(table.name, {**selected.columns, "model": selected.columns["scene"]})
    if not table["model"].size or not any(comparison.selection.solved for comparison in comparisons):
        return [_empty_panel(table.name, "no model has a result with a known error")]
    is_spectrum = comparisons[0].is_level and np.isfinite(table["wavelength_mm"]).all()
    return [(_spectrum if is_spectrum else _numbers)(comparisons, table)]


def _empty_panel(quantity: str, reason: str) -> DrawnPanel:
    """A panel of a quantity that has no number."""
    return Panel(quantity, "", title=reason, log="", height=1.4), Table(quantity, {"model": []})


def _names_of_curves(comparisons: Sequence[Comparison]) -> list[str]:
    """Of spectra and sweeps: models in the order of `shown_models`, or scenes; none of a number by each model."""
    if len(comparisons) > 1 and comparisons[0].swept is not None:
        return list(_lines_of_sweep(comparisons))
    solved = [comparison for comparison in comparisons if comparison.selection.solved and comparison.is_level]
    if len(comparisons) == 1:
        return shown_models(solved[0]) if solved else []
    return list(dict.fromkeys(comparison.scene.name for comparison in solved))


def _spectrum(comparisons: Sequence[Comparison], table: Table) -> DrawnPanel:
    """The selected model with the band of its error and the others, or the selected model of each scene."""
    selected = comparisons[0].model if len(comparisons) == 1 else ""
    x = table["wavelength_mm"]
    speeds = x * table["frequency_hz"]
    # one axis of frequencies is that of all curves, or of none
    above = (FREQUENCY, float(speeds[0])) if np.ptp(speeds) <= 1e-9 * speeds[0] else None
    is_nominal = all(wave == float(f"{wave:.3g}") for wave in x.tolist())
    panel = Panel(WAVELENGTH, _label(comparisons[0]), downward=True, ticked=is_nominal, above=above, height=4.0)
    curves = _curves(table.name, _names_of_curves(comparisons)[:MOST], selected)
    return panel.of(*curves), _with_column(table, WAVELENGTH, x.tolist())


def _numbers(comparisons: Sequence[Comparison], table: Table) -> DrawnPanel:
    """A row a model, or the selected model of each scene."""
    selected = comparisons[0].model if len(comparisons) == 1 else ""
    # of two scenes of one name, each has its row
    names = [in_two_lines(str(name), NAME) + ",\nselected" * (name == selected) for name in table.columns["model"]]
    names = [name + "\N{ZERO WIDTH SPACE}" * names[:i].count(name) for i, name in enumerate(names)]
    panel = Panel(_label(comparisons[0]), "", rows="row", log="", height=0.7 + 0.36 * len(names))
    shaded = [Curve(table.name, selected, "interval")] * bool(selected)
    return panel.of(Curve(table.name, by=("model",)), *shaded), _with_column(table, "row", names)


def _label(comparison: Comparison) -> str:
    """The quantity with its unit."""
    return f"{comparison.quantity} [{comparison.unit}]"


def _with_column(table: Table, name: str, cells: Sequence[object]) -> Table:
    return Table(table.name, {**table.columns, name: cells})


def _curves(table: str, models: Iterable[str], selected: str = "", *, bands: bool = False) -> Iterator[Curve]:
    """A curve of each model, that of the selected one with the band of its error. bands: whether all have one."""
    for model in models:
        label = legend_name(in_two_lines(f"{model}, selected" if model == selected else model, NAME))
        yield Curve(table, model, label=label, band=bands or model == selected)


Interval = tuple[float, float, float]
"""Value, low and high; NaN where a model was not solved, or its error is unknown."""

PANELS = 4
"""Of a spectrum: the sound power where there is one, and the bands that change most among those that count."""
DECADE = 10.0
"""Ratio of swept values from which on their axis is logarithmic."""
SAME = 10**0.05
"""Ratio of wavelengths within one band, at the most."""
Points = list[tuple[Comparison, str]]
"""Of a line: comparisons of a sweep, each with the name of its model."""


def _panels_of_sweep(comparisons: Sequence[Comparison]) -> Iterator[DrawnPanel]:
    """One panel of a single number, else one of the sound power and of `PANELS` bands; a line a model, or a scene."""
    first = comparisons[0]
    lines = dict(list(_lines_of_sweep(comparisons).items())[:MOST])
    if first.swept is None or not lines:
        yield _empty_panel(first.quantity, "no model has a result")
        return
    values = [comparison.swept.value for comparison in comparisons if comparison.swept]
    numbers = [value for value in values if isinstance(value, float)]
    is_log = len(numbers) == len(values) and min(numbers) > 0 and max(numbers) >= DECADE * min(numbers)
    panel = Panel(first.swept.label, _label(first), log="x" if is_log else "", ticked=is_log, own_y=True)
    power = first.is_level and all(comparison.power for comparison in comparisons)
    if power:
        table = _table_of_sweep(f"sound power of {first.quantity}", lines, {math.nan: _interval_of_power})
        title = "sound power"
        yield (
            replace(panel, title=title, y="A-weighted [dB re 1 pW]").of(*_curves(table.name, lines, bands=True)),
            table,
        )
    waves = _most_changing_waves(comparisons, PANELS - power) if first.is_level else [math.nan]
    if not waves:
        yield _empty_panel(first.quantity, "no band has a level that counts")
        return
    table = _table_of_sweep(first.quantity, lines, {wave: partial(_interval_of_model, wave=wave) for wave in waves})
    facet = WAVELENGTH if first.is_level else ""
    yield replace(panel, facet=facet).of(*_curves(table.name, lines, bands=True)), table


def _table_of_sweep(
    name: str, lines: Mapping[str, Points], intervals: Mapping[float, Callable[[Comparison, str], Interval]]
) -> Table:
    """A row a wavelength, line and swept value, in the order of the values. intervals: by wavelength [mm]."""
    rows = [
        {
            "model": line,
            WAVELENGTH: float(f"{wave:.4g}"),
            swept.label: swept.value,
            **dict(zip(ENDS, interval(*point), strict=True)),
        }
        for wave, interval in intervals.items()
        for line, points in lines.items()
        for point in _in_order(points)
        if (swept := point[0].swept)
    ]
    return table_of(name, rows)


def _in_order(points: Points) -> Points:
    """Points by the swept value where all are numbers; texts as they are."""
    values = [comparison.swept.value for comparison, _ in points if comparison.swept]
    numbers = [value for value in values if isinstance(value, float)]
    return [points[i] for i in np.argsort(numbers, kind="stable")] if len(numbers) == len(points) else points


def _lines_of_sweep(comparisons: Sequence[Comparison]) -> dict[str, Points]:
    """Models of one scene, those first that are shown of its first value; of several scenes their selected models."""
    scenes = list(dict.fromkeys(comparison.swept.scene for comparison in comparisons if comparison.swept))
    if len(scenes) > 1:
        return {
            s: [
                (comparison, comparison.model)
                for comparison in comparisons
                if comparison.swept and comparison.swept.scene == s
            ]
            for s in scenes
        }
    return {
        name: [(comparison, name) for comparison in comparisons]
        for each in comparisons
        if each.selection.solved
        for name in shown_models(each)
    }


def _interval_of_model(comparison: Comparison, name: str, wave: float) -> Interval:
    """Value and error of a model in the band at a wavelength [mm]; wave: NaN of one number."""
    for candidate in comparison.selection.solved:
        at = 0 if math.isnan(wave) else _index_of_band(comparison, wave)
        if candidate.name == name and at is not None:
            value, half_width = map(np.atleast_1d, (comparison.value_of(candidate), comparison.errors_of(candidate)))
            return _interval(value[at], half_width[at])
    return math.nan, math.nan, math.nan


def _interval_of_power(comparison: Comparison, name: str) -> Interval:
    """The sum over all bands; the error of the selected model alone is known."""
    power = comparison.power
    if power is None or name not in power.levels:
        return math.nan, math.nan, math.nan
    return _interval(power.total(name), power.error if name == power.chosen else math.inf)


def _interval(value: float, half: float) -> Interval:
    """Value with the ends value - half and value + half, NaN where the half-width is not finite."""
    half_width = half if math.isfinite(half) else math.nan
    return float(value), float(value - half_width), float(value + half_width)


def _index_of_band(comparison: Comparison, wave: float) -> int | None:
    """Index of the band at a wavelength [mm], within the ratio `SAME`; None where the comparison has no such band."""
    off = np.abs(np.log(comparison.wavelength_mm / wave))
    return int(np.argmin(off)) if off.size and off.min() < np.log(SAME) else None


def _most_changing_waves(comparisons: Sequence[Comparison], most: int) -> list[float]:
    """Wavelengths of the bands that change most [mm], from long to short."""
    solved = [comparison for comparison in comparisons if comparison.selection.solved]
    points = [(comparison, (comparison.selection.best or reference_of(comparison)).name) for comparison in solved]
    waves = solved[0].wavelength_mm[counted_bands(solved[0], reference_of(solved[0]))].tolist() if solved else []
    levels = {
        wave: np.array([_interval_of_model(comparison, name, wave)[0] for comparison, name in points]) for wave in waves
    }
    finite = {wave: level[np.isfinite(level)] for wave, level in levels.items()}
    spread = {wave: float(np.ptp(level)) for wave, level in finite.items() if level.size}
    return sorted(sorted(spread, key=spread.__getitem__)[-most:], reverse=True)


ROOM = 1.6
"""Factor by which the axis of errors goes on below the smallest."""


def figure_over_seconds(comparison: Comparison, form: str) -> bytes:
    """Error over seconds, both logarithmic, a point a model. Raises ValueError where no model was timed."""
    if not any(np.isfinite(comparison.seconds_of(candidate)) for candidate in comparison.selection.solved):
        raise ValueError("--over seconds needs models that were solved, got none")
    title = f"{comparison.scene.name}: {comparison.quantity}"
    return _picture(title, [errors_over_seconds(comparison)], form, partial(names_of_users, [comparison]))


def errors_over_seconds(comparison: Comparison) -> DrawnPanel:
    """Points of `speed_and_accuracy`; where an error is not positive, the upper end of its interval."""
    table = speed_and_accuracy(comparison)
    shown = np.where(table["is_reference"] | ~(table["error"] > 0), table["high"], table["error"])
    positive = np.concatenate([shown, table["low"]])
    least = float(np.min(positive[positive > 0], initial=np.inf)) / ROOM
    ends = zip(ENDS, (shown, np.maximum(table["low"], least), table["high"]), strict=True)
    columns = {"model": table.columns["model"], SECONDS: table.columns["seconds"]}
    drawn = Table("error over seconds", columns | {name: column.tolist() for name, column in ends})
    tolerance = comparison.tolerance.relative
    limit = 20 * np.log10(1 + tolerance) if table["unit"][0] == "dB" else 100 * tolerance
    (reference,) = table.where(is_reference=True)["model"]
    notes = {reference: ", its own error"} | {comparison.model: ", selected"}
    curves = [
        Curve(drawn.name, str(name), "marks", f"{name}{notes.get(name, '')}", bars=True, named=True)
        for name in table["model"]
    ]
    panel = Panel(
        SECONDS,
        f"difference from {reference} [{table['unit'][0]}]",
        log="xy",
        ylim=(least, None) if np.isfinite(least) else None,
        limits={f"tolerance, {comparison.tolerance}": float(limit)},
        height=4.4,
    )
    return panel.of(*curves), drawn
