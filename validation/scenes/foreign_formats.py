"""Files of other programs, which nothing here reads: what they are, and how their numbers get out of them."""

from pathlib import Path

SHEET = 'a spreadsheet: save its sheet as "CSV UTF-8", with the numbers alone below one line of names'
BY_PYTHON = 'a file of {kind}: numpy.savetxt("heights.txt", {loaded}) writes its array as a text'
HDF5 = BY_PYTHON.format(kind="HDF5", loaded='h5py.File("{name}")["heights"][:]')
MATLAB = "a file of MATLAB: writematrix(heights, 'heights.csv') writes its array as a text there"
TABLES = "a table of Apache {kind}: pandas.{read}(...).to_csv(...) writes it as a text"
INSTRUMENT = "a file of an instrument: its software exports heights as a text, as XYZ or CSV"
ENDINGS = {
    ".xlsx": SHEET,
    ".xlsm": SHEET,
    ".xlsb": SHEET,
    ".xls": SHEET,
    ".ods": SHEET,
    ".numbers": SHEET,
    ".h5": HDF5,
    ".hdf5": HDF5,
    ".hdf": HDF5,
    ".mat": MATLAB,
    ".parquet": TABLES.format(kind="Parquet", read="read_parquet"),
    ".feather": TABLES.format(kind="Arrow", read="read_feather"),
    ".tdms": BY_PYTHON.format(kind="LabVIEW", loaded='nptdms.TdmsFile("{name}")'),
    ".mf4": BY_PYTHON.format(kind="ASAM MDF", loaded='asammdf.MDF("{name}")'),
    ".pkl": BY_PYTHON.format(kind="pickle, which can run any program and is not opened,", loaded="of your own program"),
    ".al3d": INSTRUMENT,
    ".sur": INSTRUMENT,
    ".pro": INSTRUMENT,
    ".spm": INSTRUMENT,
    ".pdf": "a document, in which numbers are pictures: the file that it was made from has them",
    ".zip": "an archive: unpack it, and name the file in it",
    ".gz": "an archive: unpack it, and name the file in it",
}
"""What a file is, by how its name ends, and how it is exported."""
BEGINNINGS = (
    (b"PK\x03\x04", "a spreadsheet or another archive: a sheet is saved as CSV, other archives are unpacked"),
    (b"\x89HDF\r\n\x1a\n", HDF5),
    (b"\xd0\xcf\x11\xe0", SHEET),
    (b"MATLAB 5.0 MAT-file", MATLAB),
    (b"PAR1", TABLES.format(kind="Parquet", read="read_parquet")),
    (b"%PDF", ENDINGS[".pdf"]),
    (b"\x1f\x8b", ENDINGS[".gz"]),
)
"""The same by its first bytes."""
LONGEST_MARK = max(len(mark) for mark, _ in BEGINNINGS)


def how_to_export(path: Path, beginning: bytes) -> str:
    """What a file is and how it is exported, in words; empty of a format that is not among these."""
    words = next((words for mark, words in BEGINNINGS if beginning.startswith(mark)), "")
    return ENDINGS.get(path.suffix.lower(), words).replace("{name}", "FILE" + path.suffix.lower())
