"""As much of JSON Schema as the schema of `compare` uses; a keyword that is not known fails."""

TYPES = {"object": dict, "array": list, "string": str, "number": int | float, "boolean": bool, "null": type(None)}


def _is(value, kinds):
    kinds = [kinds] if isinstance(kinds, str) else kinds
    return any(isinstance(value, TYPES[kind]) and isinstance(value, bool) == (kind == "boolean") for kind in kinds)


def _number(holds):
    return lambda value, asked, _: not _is(value, "number") or holds(value, asked)


RULES = {
    "type": lambda value, asked, _: _is(value, asked),
    "enum": lambda value, asked, _: value in asked,
    "minimum": _number(lambda value, least: value >= least),
    "exclusiveMinimum": _number(lambda value, least: value > least),
    "maximum": _number(lambda value, most: value <= most),
    "minItems": lambda value, least, _: not isinstance(value, list) or len(value) >= least,
    "required": lambda value, names, _: not isinstance(value, dict) or set(names) <= set(value),
    "additionalProperties": lambda value, _, schema: (
        not isinstance(value, dict) or set(value) <= set(schema["properties"])
    ),
}
OTHERS = {"$ref", "oneOf", "items", "properties", "description", "title", "$schema", "$defs"}


def faults(value, schema, root, at="$"):
    """Places and keywords of what is wrong with a value."""
    assert set(schema) <= OTHERS | set(RULES)
    found = [
        f"{at}: {word}" for word, right in RULES.items() if word in schema and not right(value, schema[word], schema)
    ]
    if "oneOf" in schema and sum(not faults(value, one, root) for one in schema["oneOf"]) != 1:
        found.append(f"{at}: oneOf")
    for name, part, inner in _parts(value, schema, root):
        found += faults(part, inner, root, at + name)
    return found


def _parts(value, schema, root):
    if "$ref" in schema:
        yield "", value, root["$defs"][schema["$ref"].removeprefix("#/$defs/")]
    if isinstance(value, list) and "items" in schema:
        yield from ((f"[{i}]", one, schema["items"]) for i, one in enumerate(value))
    if isinstance(value, dict):
        known = schema.get("properties", {})
        yield from ((f".{name}", one, known[name]) for name, one in value.items() if name in known)
