"""Digits of a table of many points, which is drawn and read, and not computed with."""

from validation.analysis.evidence import Table


def in_four_digits(table: Table) -> Table:
    """The table with each number that is no whole one in four digits."""
    columns = {name: table[name].tolist() for name in table.columns}
    return Table(
        table.name,
        {n: [float(f"{x:.4g}") if isinstance(x, float) else x for x in mine] for n, mine in columns.items()},
    )
