"""JPlag and Dolos, where this machine has them, take what `likeness` writes and name the planted pairs."""
import pytest

from tests.marking.extras.likeness.other_programs import PROGRAMS, generated_zip

STUDENTS, PAIRS = 60, 5
WITHIN = {"JPLAG": PAIRS, "DOLOS": 2 * PAIRS}  # the places among which all planted pairs are


@pytest.mark.soak
@pytest.mark.parametrize("name", PROGRAMS)
def test_another_program_names_the_planted_pairs_among_the_first(tmp_path, name):
    where, find = PROGRAMS[name]
    if not where:
        pytest.skip(f"the environment variable {name} doesn't say where the program is")
    archive, planted = generated_zip(tmp_path, STUDENTS, PAIRS)
    found = find(archive, tmp_path, PAIRS + 10)
    assert planted <= {pair for pair, _ in found[: WITHIN[name]]}
    assert found[0][0] in planted
    assert not [pair for pair, _ in found if {"release", "the release"} & pair]
