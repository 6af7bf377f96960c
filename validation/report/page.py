"""The page of a report: sections and pictures into the templates beside it."""

import math
import re
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from urllib.parse import quote

import jinja2
from markupsafe import Markup, escape

from validation.analysis.case import Chapter, Profile
from validation.analysis.evidence import ClaimStatus, JudgedClaim, Verdict, VerdictCell
from validation.report.answers.first_screen import answered_questions, map_of
from validation.report.chapter import ERRATA, chapter_of
from validation.report.section import Section, answer_of, total_of
from validation.report.sounds import sound_place
from validation.scenes.description import describe
from validation.scenes.dynamic_wheel import WheelScene

SAFE = " !$'()*+,-./;=?@[]_~{}<>|^`"
"""What an address in quotation marks may hold as it is."""
SYMBOL = {"agree": "✓", "differ": "≠", "undecided": "?"}
STATUS_SYMBOL = {"holds": "✓", "holds within limits": "(✓)", "contradicted": "✗", "open": "?"}
"""Each status also has a border of its own, so that it is known without colour."""
NO_STEADY_ANSWER = Markup('<span class="verdict undecided">? no steady answer</span>')


def format_value(value: float, tolerance: float) -> str:
    """A value with two digits more than its tolerance has, seven at the most."""
    digits = max(0, 2 - math.floor(math.log10(tolerance))) if tolerance > 0 else 6
    if digits > 9:
        return f"{value:.2g}"
    return f"{value:.{min(digits, 7)}f}"


def scene_summary(scene: WheelScene) -> dict[str, object]:
    """The first lines of a report on a scene of the user's own."""
    return {
        "name": scene.name,
        "no steady answer": scene.no_steady_answer(),
        "doubts": list(scene.diagnose()),
        "understood": dict(describe(scene)),
    }


def format_verdict(verdict: str, *, unsteady: bool = False) -> Markup:
    """A verdict with its symbol; a scene without a steady answer has none."""
    if unsteady:
        return NO_STEADY_ANSWER
    return Markup('<span class="verdict {0}">{1} {0}</span>').format(verdict, SYMBOL[verdict])


def format_status(status: ClaimStatus | None, *, unsteady: bool = False) -> Markup:
    """The status of a claim with its symbol and colour."""
    if unsteady:
        return NO_STEADY_ANSWER
    name = status or "no result"
    return Markup('<span class="verdict {}">{} {}</span>').format(
        name.replace(" ", "-"), STATUS_SYMBOL.get(name, "–"), name
    )


def format_counts(claim: JudgedClaim) -> str:
    """How many of the numbers that test a claim agree, differ, are undecided, without colour: that is the claim's."""
    counts = ((verdict, claim.count(verdict)) for verdict in Verdict)
    counted = ", ".join(f"{count} {verdict}" for verdict, count in counts if count)
    return counted + ("; the claim is that they differ" if claim.confirmed_by is Verdict.DIFFER else "")


def format_cell(cell: object, *, unsteady: bool = False) -> Markup:
    """A cell of a table, with its verdict where it has one."""
    if not isinstance(cell, VerdictCell):
        return escape(f"{cell:.4g}" if isinstance(cell, float) else str(cell))
    badge = format_verdict(cell.verdict, unsteady=unsteady)
    after = f"; {cell.after}" if cell.after else ""
    return Markup("{}<br>{}{}").format(cell.text, badge, after)


def first_sentence(text: str) -> str:
    """Up to the full stop that ends it."""
    return re.split(r"(?<=[.;]) (?=[A-Z(])", text, maxsplit=1)[0].rstrip(".;")


def _address(picture: bytes) -> str:
    """A picture as text of an attribute: a third shorter than in base64."""
    return quote(" ".join(picture.decode().replace('"', "'").split()), safe=SAFE)


def page(
    sections: Sequence[Section],
    profile: Profile,
    pictures: dict[str, bytes],
    about: dict[str, object],
    scene: WheelScene | None,
) -> bytes:
    """The whole page. pictures: SVG of each figure; about: the provenance; scene: of the user's own, or None."""
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(Path(__file__).parent / "templates"),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    unsteady = scene is not None and bool(scene.no_steady_answer())
    environment.filters |= {
        "format_value": format_value,
        "format_cell": partial(format_cell, unsteady=unsteady),
        "format_verdict": partial(format_verdict, unsteady=unsteady),
        "format_status": partial(format_status, unsteady=unsteady),
        "format_counts": format_counts,
        "answer_of": answer_of,
        "first_sentence": first_sentence,
        "sound_place": sound_place,
        "duration": lambda value: f"{value:.0f} s" if value >= 1 else f"{value:.1g} s",
        "small": lambda value: f"{value:.2g}",
    }
    text = environment.get_template("page.html").render(
        sections=sections,
        book=[] if scene else chapter_of(sections),
        errata=ERRATA,
        answers=[] if scene else answered_questions(sections),
        map=map_of(sections),
        total="" if unsteady else total_of(sections),
        chapters=[(c, [s for s in sections if s.entry.chapter == c]) for c in Chapter],
        profile=profile,
        pictures={name: _address(picture) for name, picture in pictures.items()},
        about=about,
        zip=zip,
        scene=scene_summary(scene) if scene else None,
        unsteady=unsteady,
    )
    return (text + "\n").encode()
