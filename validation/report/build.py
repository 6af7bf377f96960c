"""Run cases and write a report folder."""

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Future
from dataclasses import asdict, replace
from functools import partial
from pathlib import Path
from typing import Any

import scipy.stats  # noqa: F401  # with most of scipy, before threads import its parts at once

from validation.analysis.case import Profile
from validation.analysis.contents import as_csv, as_json, csv_name
from validation.analysis.evidence import Evidence
from validation.engine.engine import LOCAL, Engine
from validation.engine.former_names import with_former_keys
from validation.engine.progress import Part, Progress
from validation.engine.realisations import NotConvergedError, as_not_converged
from validation.engine.workers import Workers
from validation.report.answers.first_screen import answered_questions, plain
from validation.report.chapter import chapter_results
from validation.report.columns import COLUMNS, columns_file
from validation.report.contents import CASES, TIMED, expected_seconds
from validation.report.earlier_report import DATA, PROVENANCE, kept_provenance, kept_sections
from validation.report.figures import drawing
from validation.report.folder import REALISATIONS, RESULTS, Folder
from validation.report.page import FIGURES, begin_to_draw, pages, scene_summary
from validation.report.provenance import machine, provenance, require_todays_code, versions_of, with_kept
from validation.report.section import Section, numbers_table, results_of, written_tables
from validation.report.sounds import sound_files
from validation.scenes.rolling import RollingScene

FORMER_KEYS = {"chapter_14": "chapter 14", "when_mdr_is_accurate_enough": "when MDR is enough"}
"""Of results.json of schema 1, which schema 2 has beside today's for one release."""


def build(
    names: Sequence[str],
    *,
    profile: Profile,
    out: Path,
    workers: int,
    seed: int | None,
    scene: RollingScene | None = None,
    executor: str = LOCAL,
    progress: bool = True,
    keep: bool = False,
    own: str = "",
    callback: Callable[[Section], None] = lambda section: None,
) -> list[Section]:
    """Run the cases, write the report folder, return what it holds.

    names: of cases in `CASES` or `TIMED`; profile: "quick" or "full"; out: a new folder or an earlier report;
    workers: processes; seed: for every case that draws, None for the seed of each case; scene: for every case of a
    dynamic wheel, None for its own; executor: see `Engine`; progress: a line on a terminal, lines in a log; keep: the
    other cases of the report in `out`, as they are; own: a file with solvers for the race; callback: called with each
    case as it is finished. Finished solves are kept in the folder, for a later run with the same problem and code.
    Raises ValueError for a folder that holds something else or that another run is at, an executor that is none, a
    case without its figure file, and cases that cannot be kept, as those of other code; see `Engine` for what is raised
    where a run cannot be finished.
    """
    for name in names:
        drawing(name)  # a case without its figure file ends the run before the first solve
    kept = kept_sections(out, profile, names) if keep else []
    before = kept_provenance(out) if keep else {}
    require_todays_code(before, versions_of([section.name for section in kept], profile))
    begun, engine = machine(), Engine(workers=workers, store=out / REALISATIONS, executor=executor)
    with (
        Folder(out) as folder,
        Progress(expected_seconds([*names, FIGURES], profile), workers=workers, shown=progress) as shown,
        # those of a scheduler solve one case after the other
        Workers(workers if executor == LOCAL else 1) as processes,
    ):
        draw = partial(begin_to_draw, workers=processes, progress=shown.parts[FIGURES], profile=profile)
        pictures = {name: picture for section in kept for name, picture in draw(section.evidence).items()}
        cases = CASES | TIMED
        settings = {name: cases[name].settings(profile, seed, scene, own) for name in names}
        unsteady = scene.no_steady_answer() if scene else ""

        def run(name: str) -> Any:
            return cases[name].run(settings[name], replace(engine, shared=processes, progress=shown.parts[name]))

        sections = []
        for name, result in _results(names, run, processes, pictures):
            section = _section(name, settings[name], result, shown.parts[name])
            sections.append(section.not_steady(unsteady) if unsteady else section)
            pictures |= draw(sections[-1].evidence)
            with shown.aside():
                callback(sections[-1])
        about = _about(sections, profile, engine, {name: shown.parts[name].worked for name in names}, begun)
        if kept:
            about = with_kept(about, before, kept)
            sections = sorted([*sections, *kept], key=lambda section: list(cases).index(section.name))
        drawn = {name: picture.result() for name, picture in pictures.items()}
        folder.replace(_files(sections, drawn, profile, about, scene))
    return sections


def _results(
    names: Sequence[str], run: Callable[[str], Any], workers: Workers, pictures: Mapping[str, Future[bytes]]
) -> Iterator[tuple[str, Future[Any]]]:
    """Of each case in their order, while the next are at work; what is timed is run last, when nothing else is."""
    lasting = [name for name in names if name not in TIMED]
    timed = [name for name in names if name in TIMED]
    yield from zip(lasting, workers.ahead([partial(run, name) for name in lasting]), strict=True)
    for picture in pictures.values():
        picture.result()
    yield from zip(timed, Workers(1).ahead([partial(run, name) for name in timed]), strict=True)


def _section(name: str, settings: Any, result: Future[Any], progress: Part) -> Section:
    case, began = (CASES | TIMED)[name], time.perf_counter()
    of = partial(Section, name, case, case.model_needed(settings), asdict(settings))
    try:
        with as_not_converged():
            evidence = case.evidence(result.result())
        # whatever a case makes of it: a solve that did not converge is told
        evidence = replace(evidence, unconverged=evidence.unconverged or _lost(progress))
        return of(evidence, files=_data_files(name, evidence) | sound_files(name, evidence))
    except NotConvergedError as error:
        return of(None, (str(error), *error.unconverged))
    except (ValueError, ArithmeticError, LookupError) as error:
        if not _lost(progress):
            raise
        return of(None, (*_lost(progress), f"no evidence without them: {error}"))
    finally:
        progress.worked += time.perf_counter() - began
        progress.over = True


def _about(
    sections: Sequence[Section], profile: Profile, engine: Engine, seconds: dict[str, float], begun: dict[str, object]
) -> dict[str, object]:
    """The provenance of a run, with the code behind each case, and what times are measured on."""
    seeds = {section.name: section.settings["seed"] for section in sections if "seed" in section.settings}
    machines = {name: begun for name in seconds if name in TIMED}
    of_cases = {"code": versions_of(seconds, profile), "machines": machines}
    return provenance(profile, seeds, engine, seconds, begun) | of_cases


def _lost(progress: Part) -> tuple[str, ...]:
    """A line for each kind of solve of a case that did not converge."""
    return tuple(f"{doing}: {count} did not converge" for doing, count in progress.lost.items())


def _files(
    sections: Sequence[Section],
    pictures: Mapping[str, bytes],
    profile: Profile,
    about: dict[str, object],
    scene: RollingScene | None,
) -> dict[str, bytes]:
    """All that a report is, the page last.

    pictures: SVG of each figure; about: its provenance.
    """
    files = {f"{FIGURES}/{name}.svg": picture for name, picture in pictures.items()}
    for section in sections:
        files |= section.files
    files[f"{DATA}/{COLUMNS}"] = columns_file(sections)
    files[PROVENANCE] = as_json(about)
    # times differ from run to run: the results are to be the same to the byte without them
    lasting = [section for section in sections if section.name not in TIMED]
    timed = [section for section in sections if section.name in TIMED]
    # the statements of the book are about its own scene
    answers = {
        "chapter_14": chapter_results(lasting),
        "when_mdr_is_accurate_enough": plain(answered_questions(lasting)),
    }
    more: dict[str, object] = (
        with_former_keys(answers, FORMER_KEYS) if scene is None else {"scene": scene_summary(scene)}
    )
    files[RESULTS] = as_json(results_of(lasting, profile) | more)
    files |= {f"{section.name}.json": as_json(results_of([section], profile)) for section in timed}
    about = {**about, "timed": [section.name for section in timed]}
    return files | pages(sections, profile, about, scene)


def _data_files(name: str, evidence: Evidence) -> dict[str, bytes]:
    tables = [*written_tables(evidence), numbers_table(evidence.numbers)]
    return {f"{DATA}/{csv_name(name, table.name)}": as_csv(table, drawn=True) for table in tables}
