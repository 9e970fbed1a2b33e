"""What holds for every maker's words."""

import pytest

from app.calibration.modes import modes
from app.calibration.vocabularies import vocabularies, vocabulary
from app.calibration.vocabularies._vocabulary import LANGUAGES
from app.errors import UnknownNameError
from app.geometry import CONVENTIONS


def test_the_makers_and_the_paper_are_there():
    assert set(vocabularies()) >= {"abb", "kuka", "fanuc", "ur", "paper"}
    with pytest.raises(UnknownNameError, match="kuka"):
        vocabulary("kuko")


@pytest.mark.parametrize("key", vocabularies())
def test_a_vocabulary_names_existing_modes_in_both_languages_and_an_existing_convention(key):
    words = vocabulary(key)
    assert words.convention in CONVENTIONS
    assert len(words.angle_names) == len(CONVENTIONS[words.convention].columns)
    for language in LANGUAGES:
        spoken = words.words[language]
        assert set(spoken.modes) == set(words.modes) <= set(modes())
        assert set(spoken.steps) == set(words.words["en"].steps)
        assert spoken.mean and spoken.max


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("key", vocabularies())
def test_every_step_of_a_makers_modes_is_restated_and_keeps_what_it_is(key, language):
    words = vocabulary(key)
    for name in words.modes:
        mode = modes()[name]
        assert words.mode_title(name, mode.title, language)
        steps = mode.steps(mode.default_touches)
        told = [words.step(step, language) for step in steps]
        assert [(s.key, s.role, s.picture) for s in told] == [(s.key, s.role, s.picture) for s in steps]
        assert len({s.title for s in told}) == len(told)
        for step in told:
            assert "{" not in step.title and step.instruction
            if language == "zh":
                assert not step.instruction.isascii()


def test_a_mode_that_a_maker_does_not_have_keeps_its_own_title():
    assert vocabulary("ur").mode_title("plane", "Touches of a flat plate") == "Touches of a flat plate"
