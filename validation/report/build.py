"""Run cases and write a report folder."""

import time
from collections.abc import Callable, Sequence
from dataclasses import asdict
from pathlib import Path

from validation.analysis.case import Profile
from validation.analysis.contents import as_csv, as_json
from validation.engine.convergence import NotConvergedError, as_not_converged
from validation.engine.engine import LOCAL, Engine
from validation.report.chapter import chapter_results
from validation.report.contents import CASES, TIMED
from validation.report.documentation import documentation_beside
from validation.report.figures import drawing
from validation.report.folder import REALISATIONS, RESULTS, Folder
from validation.report.page import page, scene_summary
from validation.report.provenance import provenance
from validation.report.section import Section, results_of
from validation.report.sounds import sound_files
from validation.report.style import drawn, pdf, svg
from validation.scenes.dynamic_wheel import WheelScene


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
    callback: Callable[[Section], None] = lambda section: None,
) -> list[Section]:
    """Run the cases, write the report folder, return what it holds.

    names: of cases in `CASES` or `TIMED`; profile: "quick" or "full"; out: a new folder or an earlier report;
    workers: processes; seed: for every case that draws, None for the seed of each case; scene: for every case of a
    dynamic wheel, None for its own; executor: see `Engine`;
    progress: a bar on a terminal, lines in a log; callback: called with each case as it is finished.
    Results of finished solves are kept in the folder and used again by a later run with the same problem and code.
    Raises ValueError for a folder that holds something else or that another run is at, an executor that is none, or a
    case without its figure file; see `Engine` for what is raised where a run cannot be finished.
    """
    for name in names:
        drawing(name)  # a case without its figure file ends the run before the first solve
    engine = Engine(workers=workers, store=out / REALISATIONS, progress=progress, executor=executor)
    with Folder(out) as folder:
        sections, seconds = [], {}
        for name in names:
            start = time.perf_counter()
            sections.append(_section(name, profile, seed, scene, engine))
            seconds[name] = time.perf_counter() - start
            callback(sections[-1])
        seeds = {section.name: section.settings["seed"] for section in sections if "seed" in section.settings}
        about = provenance(profile, seeds, engine, seconds)
        folder.replace(_files(sections, profile, about, scene, documentation_beside(out)))
    return sections


def _files(
    sections: Sequence[Section],
    profile: Profile,
    about: dict[str, object],
    scene: WheelScene | None,
    documentation: str,
) -> dict[str, bytes]:
    """All that a report is, the page last. about: its provenance; documentation: its address, or empty."""
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
        files |= sound_files(section.name, section.evidence)
    files["provenance.json"] = as_json(about)
    # times differ from run to run: the results are to be the same to the byte without them
    lasting = [section for section in sections if section.name not in TIMED]
    # the statements of the book are about its own scene
    more = {"chapter 14": chapter_results(lasting)} if scene is None else {"scene": scene_summary(scene)}
    files[RESULTS] = as_json(results_of(lasting, profile) | more)
    timed = [section for section in sections if section.name in TIMED]
    for section in timed:
        files[f"{section.name}.json"] = as_json(results_of([section], profile))
    about = {**about, "timed": [section.name for section in timed], "documentation": documentation}
    files["index.html"] = page(sections, profile, pictures, about, scene)
    return files


def _section(name: str, profile: Profile, seed: int | None, scene: WheelScene | None, engine: Engine) -> Section:
    case = TIMED[name] if name in TIMED else CASES[name]
    settings = case.settings(profile, seed, scene)
    try:
        with as_not_converged():
            evidence = case.evidence(case.run(settings, engine))
    except NotConvergedError as error:
        return Section(
            name, case, case.model_needed(settings), asdict(settings), None, (str(error), *error.unconverged)
        )
    return Section(name, case, case.model_needed(settings), asdict(settings), evidence)
