"""From cases to a report folder."""

import math
import time
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from functools import partial
from pathlib import Path
from urllib.parse import quote

import jinja2
from markupsafe import Markup, escape

from validation.analysis.case import Case, Chapter, Profile
from validation.analysis.evidence import Evidence, Number, Role, Verdict, VerdictCell
from validation.engine.convergence import NotConvergedError, as_not_converged
from validation.engine.engine import LOCAL, Engine
from validation.report.contents import CASES, TIMED
from validation.report.figures import drawing
from validation.report.folder import REALISATIONS, RESULTS, Folder, as_csv, as_json
from validation.report.provenance import provenance
from validation.report.style import drawn, pdf, svg
from validation.scenes.description import describe
from validation.scenes.dynamic_wheel import WheelScene

SAFE = " !$'()*+,-./;=?@[]_~{}<>|^`"
"""What an address in quotation marks may hold as it is."""
SYMBOL = {"agree": "✓", "differ": "≠", "undecided": "?"}


@dataclass(frozen=True)
class Section:
    """One case in the report: which rung of the ladder it needs, its settings, its evidence or why there is none."""

    name: str
    entry: Case
    needed: str
    settings: dict[str, object]
    evidence: Evidence | None
    failure: tuple[str, ...] = ()

    @property
    def answers(self) -> str:
        """Which figure or claim it answers."""
        return self.entry.answers

    @property
    def numbers(self) -> tuple[Number, ...]:
        """All of them, none where the case failed."""
        return self.evidence.numbers if self.evidence else ()

    @property
    def unconverged(self) -> tuple[str, ...]:
        """Whatever did not converge in it."""
        return self.evidence.unconverged if self.evidence else self.failure

    @property
    def missed(self) -> tuple[Number, ...]:
        """Criteria that are not met."""
        return tuple(number for number in self.numbers if not number.met)

    @property
    def criteria(self) -> int:
        """How many there are."""
        return sum(number.role is Role.CRITERION for number in self.numbers)

    def findings(self, verdict: Verdict) -> int:
        """How many came out that way."""
        return sum(number.role is Role.FINDING and number.verdict is verdict for number in self.numbers)


def build(
    names: Sequence[str],
    *,
    profile: Profile,
    out: Path,
    workers: int,
    seed: int | None,
    scene: WheelScene | None = None,
    executor: str = LOCAL,
    progress: bool = True,
    tell: Callable[[Section], None] = lambda section: None,
) -> list[Section]:
    """Run the cases, write the report folder, return what it holds.

    names: of cases in `CASES` or `TIMED`; profile: "quick" or "full"; out: a new folder or an earlier report;
    workers: processes; seed: for every case that draws, None for the seed of each case; scene: for every case of a
    dynamic wheel, None for its own; executor: see `Engine`;
    progress: a bar on a terminal, lines in a log; tell: called with each case as it is finished.
    Results of finished solves are kept in the folder and used again by a later run with the same problem and code.
    Raises ValueError for a folder that holds something else or that another run is at, or an executor that is none;
    see `Engine` for what is raised where a run cannot be finished.
    """
    engine = Engine(workers=workers, store=out / REALISATIONS, progress=progress, executor=executor)
    with Folder(out) as folder:
        sections, seconds = [], {}
        for name in names:
            start = time.perf_counter()
            sections.append(_section(name, profile, seed, scene, engine))
            seconds[name] = time.perf_counter() - start
            tell(sections[-1])
        seeds = {section.name: section.settings["seed"] for section in sections if "seed" in section.settings}
        folder.replace(_files(sections, profile, provenance(profile, seeds, engine, seconds), scene))
    return sections


def _files(
    sections: Sequence[Section], profile: Profile, about: dict[str, object], scene: WheelScene | None
) -> dict[str, bytes]:
    """All that a report is, the page last. about: its provenance."""
    files, pictures = {}, {}
    for section in sections:
        if section.evidence is None:
            continue
        for name in section.evidence.captions:
            figure = drawn(drawing(name), section.evidence, profile)
            pictures[name] = files[f"figures/{name}.svg"] = svg(figure)
            files[f"figures/{name}.pdf"] = pdf(figure)
        for table in section.evidence.tables:
            files[f"data/{section.name}-{table.name}.csv"] = as_csv(table)
    files["provenance.json"] = as_json(about)
    # times differ from run to run: the results are to be the same to the byte without them
    results = _results([s for s in sections if s.name not in TIMED], profile)
    files[RESULTS] = as_json(results if scene is None else {**results, "scene": _said(scene)})
    timed = [section for section in sections if section.name in TIMED]
    for section in timed:
        files[f"{section.name}.json"] = as_json(_results([section], profile))
    about = {**about, "timed": [section.name for section in timed]}
    files["index.html"] = _page(sections, profile, pictures, about, scene)
    return files


def _section(name: str, profile: Profile, seed: int | None, scene: WheelScene | None, engine: Engine) -> Section:
    entry = TIMED[name] if name in TIMED else CASES[name]
    case = entry.settings(profile, seed, scene)
    try:
        with as_not_converged():
            evidence = entry.evidence(entry.run(case, engine))
    except NotConvergedError as error:
        return Section(name, entry, entry.model_needed(case), asdict(case), None, (str(error), *error.unconverged))
    return Section(name, entry, entry.model_needed(case), asdict(case), evidence)


def _results(sections: Sequence[Section], profile: Profile) -> dict[str, object]:
    return {"profile": profile, "cases": {section.name: _case_results(section) for section in sections}}


def _case_results(section: Section) -> dict[str, object]:
    return {
        "claim": section.entry.claim,
        "answers": section.answers,
        "rung needed": section.needed,
        "settings": section.settings,
        "numbers": [
            {
                "label": number.label,
                **asdict(number),
                "difference": number.difference,
                "verdict": number.verdict,
                "met": number.met if number.role is Role.CRITERION else None,
            }
            for number in section.numbers
        ],
        "conclusions": list(section.evidence.conclusions) if section.evidence else [],
        "unconverged": list(section.unconverged),
    }


def _resolved(value: float, tolerance: float) -> str:
    """A value with two digits more than its tolerance has, seven at the most."""
    digits = max(0, 2 - math.floor(math.log10(tolerance))) if tolerance > 0 else 6
    if digits > 9:
        return f"{value:.2g}"
    return f"{value:.{min(digits, 7)}f}"


def _said(scene: WheelScene) -> dict[str, object]:
    """What is said first of a scene of the user's own."""
    return {
        "name": scene.name,
        "no steady answer": scene.no_steady_answer(),
        "doubts": list(scene.diagnose()),
        "understood": dict(describe(scene)),
    }


def _badge(verdict: str, count: str = "", *, unsteady: bool = False) -> Markup:
    """A verdict as it looks on the page; of a scene without a steady answer there is none."""
    if unsteady:
        return Markup('<span class="verdict undecided">? no steady answer</span>')
    return Markup('<span class="verdict {0}">{1} {2}{0}</span>').format(verdict, SYMBOL[verdict], count)


def _badged(cell: object, *, unsteady: bool = False) -> Markup:
    """A cell of a table: a verdict looks as it does elsewhere on the page."""
    if not isinstance(cell, VerdictCell):
        return escape(f"{cell:.4g}" if isinstance(cell, float) else str(cell))
    badge = _badge(cell.verdict, unsteady=unsteady)
    after = f"; {cell.after}" if cell.after else ""
    return Markup("{}<br>{}{}").format(cell.text, badge, after)


def _address(picture: bytes) -> str:
    """A picture as text of an attribute: a third shorter than in base64."""
    return quote(" ".join(picture.decode().replace('"', "'").split()), safe=SAFE)


def _page(
    sections: Sequence[Section],
    profile: Profile,
    pictures: dict[str, bytes],
    about: dict[str, object],
    scene: WheelScene | None,
) -> bytes:
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(Path(__file__).parent),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters["resolved"] = _resolved
    unsteady = scene is not None and bool(scene.no_steady_answer())
    environment.filters["badged"] = partial(_badged, unsteady=unsteady)
    environment.filters["badge"] = partial(_badge, unsteady=unsteady)
    environment.filters["duration"] = lambda value: f"{value:.0f} s" if value >= 1 else f"{value:.1g} s"
    environment.filters["small"] = lambda value: f"{value:.2g}"
    page = environment.get_template("page.html").render(
        sections=sections,
        chapters=[(c, [s for s in sections if s.entry.chapter == c]) for c in Chapter],
        profile=profile,
        pictures={name: _address(picture) for name, picture in pictures.items()},
        about=about,
        verdicts=list(Verdict),
        zip=zip,
        said=_said(scene) if scene else None,
        unsteady=unsteady,
    )
    return (page + "\n").encode()
