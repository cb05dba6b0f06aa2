"""The choices of question 3: the same six beliefs in an order of its own for each variant."""

import re

from autograder.problems.conclusion import CHOICES, RIGHT, choice_of, choices
from autograder.render.solution import REMARKS


def test_every_variant_has_all_choices():
    """Letters A to F, each choice once."""
    for variant in ("worked-example", "a", "b"):
        listed = choices(variant)
        assert "".join(choice.letter for choice in listed) == "ABCDEF"
        assert {choice.identifier for choice in listed} == set(CHOICES)


def test_the_order_differs_between_variants():
    """Over many variants the right choice stands at every letter, about equally often."""
    letters = [next(c.letter for c in choices(f"s{k}") if c.identifier == RIGHT) for k in range(600)]
    assert all(70 < letters.count(letter) < 130 for letter in "ABCDEF")


def test_a_letter_is_read_generously():
    """Spaces, brackets and small letters name a choice; anything else names none."""
    first = choices("worked-example")[0]
    assert all(choice_of("worked-example", text) == first for text in ("A", "a", " (a) ", "A."))
    assert [choice_of("worked-example", text) for text in ("", "G", "AB", "1")] == [None] * 4


def test_no_choice_stands_out_by_its_length():
    """The right choice is not the longest by far: all texts have similar lengths."""
    lengths = [len(text) for text in CHOICES.values()]
    assert max(lengths) < 1.5 * min(lengths)


def test_the_right_choice_does_not_stand_out():
    """It is neither the longest nor the shortest, and uses no word of the trade that only it has."""
    lengths = sorted(len(text) for text in CHOICES.values())
    assert lengths[0] < len(CHOICES[RIGHT]) < lengths[-1]
    assert not re.search(r"(?i)affine|linear|quadratic|constant|deriv|jacobian|single", CHOICES[RIGHT])


def test_no_choice_tells_what_the_second_step_is():
    """The choices stand in the handout beside question 2, so they explain what was seen and do not say it."""
    told = r"(?i)vanish|second|more steps|(?:they|steps?) (?:is|are|be|becomes?) (?:not )?(?:exactly )?(?:zero|0|too)"
    assert [text for text in CHOICES.values() if re.search(told, text)] == []


def test_every_wrong_choice_has_a_remark_for_staff():
    """The marking guide says what each wrong belief tells."""
    assert set(REMARKS) == set(CHOICES) - {RIGHT}
