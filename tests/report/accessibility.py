"""What keeps a page from being read: by a screen reader, by keyboard, without colour, on paper."""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from html.parser import HTMLParser

VOID = {"area", "br", "col", "hr", "img", "input", "link", "meta", "source", "wbr"}
UNREAD = {"style", "title", "desc"}
CONTRAST = 4.5
"""The least ratio for text of normal size, WCAG 2.1, 1.4.3."""


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

    def within(self, *tags: str) -> bool:
        return self.parent is not None and (self.parent.tag in tags or self.parent.within(*tags))

    @property
    def text(self) -> str:
        """In pieces as they stand, with the texts of pictures."""
        own = [*self.words, self.attributes.get("alt", "")]
        return " ".join(own + [child.text for child in self.children]).strip()

    @property
    def name(self) -> str:
        return self.attributes.get("aria-label", "") or self.text


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


def words_seen(element: Element) -> int:
    """Before anything is unfolded."""
    children = element.children
    if element.tag == "details" and "open" not in element.attributes:
        children = [child for child in children if child.tag == "summary"]
    seen = 0 if element.tag in ("style", "svg") else sum(len(words.split()) for words in element.words)
    return seen + sum(words_seen(child) for child in children)


def faults(pages: Mapping[str, str]) -> list[str]:
    """One line each; none for pages, by their names, that can be read and lead to places of each other."""
    trees = {name: list(Tree(page).root.walk()) for name, page in pages.items()}
    places = {f"{name}#{e.attributes['id']}" for name, tree in trees.items() for e in tree if "id" in e.attributes}
    return [fault for name, page in pages.items() for fault in _of_page(name, page, trees[name], places | set(trees))]


def _of_page(name: str, page: str, elements: list[Element], places: set[str]) -> list[str]:
    return [
        *_of_document(elements),
        *_of_links(name, elements, places),
        *_of_headings(elements),
        *_of_names(elements),
        *_of_tables(elements),
        *_of_contrast(page[page.index("<style>") : page.index("</style>")]),
    ]


def _of_document(elements: list[Element]) -> Iterator[str]:
    html = next(e for e in elements if e.tag == "html")
    if not html.attributes.get("lang"):
        yield "html has no lang"
    for tag in ("title", "main", "nav", "h1"):
        if sum(e.tag == tag and not e.within("svg") for e in elements) != 1:
            yield f"not one {tag}"
    names = [e.attributes["id"] for e in elements if "id" in e.attributes]
    yield from (f"id {name} twice" for name in {n for n in names if names.count(n) > 1})
    for element in elements:
        for name in element.attributes.get("aria-labelledby", "").split():
            if name not in names:
                yield f"labelled by {name}, which is nowhere"


def _of_links(page: str, elements: list[Element], places: set[str]) -> Iterator[str]:
    for element in elements:
        target = element.attributes.get("href", "")
        if (target.startswith("#") or ".html" in target) and (
            target if target[0] != "#" else page + target
        ) not in places:
            yield f"link to {target}, which is nowhere"


def _of_headings(elements: list[Element]) -> Iterator[str]:
    levels = [int(e.tag[1]) for e in elements if re.fullmatch("h[1-6]", e.tag)]
    for before, after in zip([0, *levels], levels, strict=False):
        if after > before + 1:
            yield f"h{after} follows h{before}"


def _of_names(elements: list[Element]) -> Iterator[str]:
    for element in elements:
        if element.tag in ("a", "summary", "h1", "h2", "h3", "img", "button") and not element.name.strip():
            yield f"{element.tag} says nothing: {element.attributes}"
        if element.tag == "a" and element.name.strip().lower() in ("here", "link", "more", "click here"):
            yield f"link says only {element.name}"
        if element.tag == "details" and (not element.children or element.children[0].tag != "summary"):
            yield "details does not begin with its summary"
        if "tabindex" in element.attributes and not (element.attributes.get("role") and element.name):
            yield "what the keyboard reaches has no role or name"
        if element.tag in ("audio", "video") and not element.attributes.get("aria-label"):
            yield f"{element.tag} has no name"
        if element.tag == "svg" and not element.attributes.get("aria-labelledby"):
            yield "svg has no title"


def _of_tables(elements: list[Element]) -> Iterator[str]:
    for element in elements:
        if element.tag == "th" and element.attributes.get("scope") not in ("row", "col", "rowgroup", "colgroup"):
            yield f"header {element.text!r} has no scope"
        if element.tag == "table" and not any(e.tag == "th" for e in element.walk()):
            yield f"table without headers: {element.text[:40]!r}"


def _of_contrast(style: str) -> Iterator[str]:
    """Text of a rule on the ground of the same rule; where it has only one of both, on each of the others'."""
    tokens = dict(re.findall(r"--(\w+): (#[0-9a-f]{6});", style))
    resolved = re.sub(r"var\(--(\w+)\)", lambda found: tokens.get(found[1], found[0]), style)
    resolved = resolved.replace(": white", ": #ffffff")
    inks, grounds = {tokens["ink"]}, {tokens["paper"]}
    for body in re.findall(r"\{([^{}]*)\}", resolved):
        ink = re.findall(r"(?<![-\w])color: (#[0-9a-f]{6})", body)
        ground = re.findall(r"background: (#[0-9a-f]{6})", body)
        if ink and ground:
            yield from _too_weak(set(ink), set(ground))
        else:
            inks, grounds = inks | set(ink), grounds | set(ground)
    yield from _too_weak(inks, grounds)


def _too_weak(inks: set[str], grounds: set[str]) -> Iterator[str]:
    for ink in sorted(inks):
        for ground in sorted(grounds):
            if contrast(ink, ground) < CONTRAST:
                yield f"{ink} on {ground} has a contrast of {contrast(ink, ground):.1f}"


def contrast(one: str, other: str) -> float:
    """(L1 + 0.05) / (L2 + 0.05) of the relative luminances, the lighter first."""
    lighter, darker = sorted((_luminance(one), _luminance(other)), reverse=True)
    return (lighter + 0.05) / (darker + 0.05)


def _luminance(colour: str) -> float:
    parts = [int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5)]
    red, green, blue = (p / 12.92 if p <= 0.04045 else ((p + 0.055) / 1.055) ** 2.4 for p in parts)
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue
