"""Options of this house in commands of others."""

from validation.advice.export import Export
from validation.railway.scenes.rail import CONTACT_FILTER

CNOSSOS = Export(
    option="--cnossos",
    quantity=str(CONTACT_FILTER),
    of="a rail",
    help="write a contact filter in the columns of the table of CNOSSOS-EU, as CSV",
    place="validation.railway.rail_columns:filter_table",
)
"""Of `compare`."""
