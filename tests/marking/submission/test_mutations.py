import random

import pytest

from tests.marking.submission.mutations import VERDICTS, mutated, real, verdict

SEEDS = [*range(50), *(pytest.param(seed, marks=pytest.mark.soak) for seed in range(50, 200))]


@pytest.mark.parametrize("seed", SEEDS)
def test_whatever_happens_to_a_submission_it_is_rebuilt_or_refused_in_words(seed):
    release, honest = real(seed)
    assert verdict(release, mutated(honest, random.Random(seed))) in VERDICTS
