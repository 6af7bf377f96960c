"""Faults planted in what `tests/engine` looks at: where, what is wrong there, and the test that must catch it."""

from functools import partial

from tests.engine import test_engine as test_ensemble
from tests.engine import test_files
from tests.judging import test_hostile, test_refusals
from tests.planted_faults.wrong import Fault
from validation.engine import files, sources
from validation.judging import replies
from validation.judging import replies as lent
from validation.judging import replies as refusals

RMS = "object.__setattr__(roughness, 'rms', 3.0)"
DEEP = "roughness.parts[1]['a'][0] = 1.0"
CHANGED = test_hostile.test_an_argument_that_is_changed_is_seen_and_the_next_call_has_a_fresh_one

FAULTS = [
    partial(CHANGED, RMS),
    Fault("a changed argument that is never named").at(replies, "changed", lambda arguments, lent: ""),
    Fault("an argument itself lent, so that the next call has what this one left").at(replies, "copy_of", lambda v: v),
    partial(CHANGED, DEEP),
    Fault("arguments compared by their attributes, and not by what these hold").at(
        replies, "changed", lambda a, b: next((n for n in a if getattr(a[n], "rms", 0) != getattr(b[n], "rms", 0)), "")
    ),
    test_hostile.test_arrays_cannot_be_written_and_are_compared_to_the_byte,
    Fault("arrays that can be written").at(lent, "as_argument", lambda value: value.copy()),
    test_refusals.test_in_this_process_a_function_of_a_console_refuses_too,
    Fault("a refusal of whatever a line of the file comes to").at(refusals, "_is_thrown_into", lambda *_: True),
    Fault("no refusal by a function without a file").at(refusals, "homes_of", lambda function, file=None: ()),
    partial(test_files.test_a_file_that_is_there_keeps_its_mode_and_is_replaced, 0o600),
    Fault("a mode of our own for the file that is there").at(files.stat, "S_IMODE", lambda mode: 0o644),
    test_files.test_a_link_is_followed,
    Fault("a link replaced by a file").at(files.os.path, "realpath", str),
    partial(test_ensemble.test_another_version_of_a_library_is_another_version_of_the_numerics, "scipy"),
    Fault("results of other libraries").at(sources, "LIBRARIES", ("numpy",)),
]
