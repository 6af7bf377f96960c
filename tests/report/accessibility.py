"""Whether the links of pages lead anywhere and their tags are closed; axe-core has the rest."""

import re
from collections.abc import Mapping
from html.parser import HTMLParser

VOID = {"area", "br", "col", "hr", "img", "input", "link", "meta", "source", "wbr"}


class Tags(HTMLParser):
    """Names and attributes of all elements of a page."""

    def __init__(self, page: str):
        super().__init__()
        self.found: list[tuple[str, dict[str, str]]] = []
        self._open: list[str] = []
        self.feed(page)

    def handle_starttag(self, tag, attrs):
        self.found.append((tag, {name: value or "" for name, value in attrs}))
        if tag not in VOID:
            self._open.append(tag)

    def handle_endtag(self, tag):
        assert self._open.pop() == tag, f"</{tag}> closes another"


def faults(pages: Mapping[str, str]) -> list[str]:
    """One line each; none for pages, by their names, whose elements have names of their own and lead to each other."""
    tags = {name: Tags(page).found for name, page in pages.items()}
    ids = {name: [of["id"] for _, of in some if "id" in of] for name, some in tags.items()}
    places = {*pages, *(f"{name}#{place}" for name, some in ids.items() for place in some)}
    found = [f"id {i} twice" for some in ids.values() for i in sorted({i for i in some if some.count(i) > 1})]
    for name, some in tags.items():
        kinds = [tag for tag, _ in some]
        found += [f"not one {tag}" for tag in ("main", "nav", "h1") if kinds.count(tag) != 1]
        for tag, of in some:
            target = of.get("href", "")
            if re.search(r"^#|\.html", target) and (name * target.startswith("#") + target) not in places:
                found.append(f"link to {target}, which is nowhere")
            found += [
                f"labelled by {i}, which is nowhere"
                for i in of.get("aria-labelledby", "").split()
                if i not in ids[name]
            ]
            if tag == "th" and not of.get("scope"):
                found.append("header without a scope")
    return found
