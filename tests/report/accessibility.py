"""The elements of a page, and whether its links lead anywhere; axe-core has the rest."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from html.parser import HTMLParser

VOID = {"area", "br", "col", "hr", "img", "input", "link", "meta", "source", "wbr"}
UNREAD = {"style", "title", "desc"}


@dataclass
class Element:
    """Of a page, with what it holds."""

    tag: str
    attributes: dict[str, str]
    parent: "Element | None" = None
    children: list["Element"] = field(default_factory=list)
    words: list[str] = field(default_factory=list)

    def walk(self) -> Iterator["Element"]:
        yield self
        for child in self.children:
            yield from child.walk()

    @property
    def text(self) -> str:
        """In pieces as they stand, with the texts of pictures."""
        own = [*self.words, self.attributes.get("alt", "")]
        return " ".join(own + [child.text for child in self.children]).strip()


class Tree(HTMLParser):
    """The elements of a page."""

    def __init__(self, page: str):
        super().__init__()
        self.root = self._open = Element("", {})
        self.feed(page)

    def handle_starttag(self, tag, attrs):
        element = Element(tag, {name: value or "" for name, value in attrs}, self._open)
        self._open.children.append(element)
        if tag not in VOID:
            self._open = element

    def handle_endtag(self, tag):
        assert self._open.tag == tag, f"</{tag}> closes <{self._open.tag}>"
        self._open = self._open.parent

    def handle_data(self, data):
        if self._open.tag not in UNREAD:
            self._open.words.append(data)


def faults(pages: Mapping[str, str]) -> list[str]:
    """One line each; none for pages, by their names, whose elements have names of their own and lead to each other."""
    trees = {name: list(Tree(page).root.walk()) for name, page in pages.items()}
    ids = {name: [e.attributes["id"] for e in tree if "id" in e.attributes] for name, tree in trees.items()}
    places = {*pages, *(f"{name}#{place}" for name, found in ids.items() for place in found)}
    found = [f"id {i} twice" for some in ids.values() for i in sorted({i for i in some if some.count(i) > 1})]
    for name, tree in trees.items():
        found += [f"not one {tag}" for tag in ("main", "nav", "h1") if sum(e.tag == tag for e in tree) != 1]
        targets = [e.attributes.get("href", "") for e in tree]
        whole = {target: f"{name}{target}" if target.startswith("#") else target for target in targets}
        internal = [target for target in whole if target.startswith("#") or ".html" in target]
        found += [f"link to {target}, which is nowhere" for target in internal if whole[target] not in places]
        labels = [label for e in tree for label in e.attributes.get("aria-labelledby", "").split()]
        found += [f"labelled by {label}, which is nowhere" for label in labels if label not in ids[name]]
        found += [f"header {e.text!r} has no scope" for e in tree if e.tag == "th" and not e.attributes.get("scope")]
    return found
