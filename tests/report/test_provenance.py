"""What a report says of how it was made: on which processor, without the name of a machine."""

import pytest

from validation.report import provenance

CPUINFO = "processor : 0\nmodel name\t: Made-up 9 @ 3 GHz\n\nprocessor : 1\nmodel name\t: Another\n"


@pytest.mark.parametrize(
    ("listed", "wanted"), [(CPUINFO, "Made-up 9 @ 3 GHz"), ("CPU part : 0xd0c\n", "arch"), (None, "arch")]
)
def test_the_processor_is_the_first_that_the_system_lists_or_its_architecture(listed, wanted, tmp_path, monkeypatch):
    if listed is not None:
        (tmp_path / "cpuinfo").write_text(listed)
    monkeypatch.setattr(provenance, "PROCESSORS", tmp_path / "cpuinfo")
    monkeypatch.setattr(provenance.platform, "processor", lambda: "")
    monkeypatch.setattr(provenance.platform, "machine", lambda: "arch")
    assert provenance.processor() == wanted
