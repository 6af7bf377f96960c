"""How values, verdicts and the status of claims are written on the page: the filters of its templates."""

import re

from markupsafe import Markup, escape

from validation.analysis.evidence import ClaimStatus, JudgedClaim, Verdict, VerdictCell

SYMBOL = {"agree": "✓", "differ": "≠", "undecided": "?"}
STATUS_SYMBOL = {"holds": "✓", "holds within limits": "(✓)", "contradicted": "✗", "open": "?"}
"""Each status also has a border of its own, so that it is known without colour."""
NO_STEADY_ANSWER = Markup('<span class="verdict undecided">? no steady answer</span>')
PANEL = re.compile(r"^\([a-z]\)(, \([a-z]\))* ")
SENTENCE_END = re.compile(r"(?<=[.;]) (?=[A-Z(])")


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
    """Without the letter of a panel before it, and the full stop that ends it."""
    return capitalized(SENTENCE_END.split(PANEL.sub("", text), maxsplit=1)[0].rstrip(".;"))


def capitalized(text: str) -> str:
    """With a capital first, the rest as it was."""
    return text[:1].upper() + text[1:]
