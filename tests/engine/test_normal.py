"""A column, a row, a matrix or single precision is read once, and then everything sees the same arrays."""

import numpy as np
import pytest

from autograder.engine.normal import normalised
from autograder.sandbox.host import Outputs
from autograder.stages.catalogue import slips
from autograder.stages.slips.submission import submission_text
from tests.engine.conftest import REFERENCE

FORMS = {
    "column": "return value.reshape(-1, 1)",
    "row": "return value[None, :]",
    "matrix": "return np.matrix(value)",
    "list": "return value.tolist()",
    "single": "return value.astype(np.float32)",
}
STEP = "\n\n_slip = {name}\n\ndef {name}(x, graph):\n    value = np.asarray(_slip(x, graph))\n    {form}\n"
MISTAKES = {
    "residual": "residual_opposite_sign",
    "gauss_newton_step": "step_has_opposite_sign",
}


def outputs(*shapes):
    """Lay out ones in these shapes."""
    sizes = [int(np.prod(shape)) for shape in shapes]
    return Outputs(
        outcome=np.zeros(len(shapes), np.uint8),
        kinds=np.zeros(len(shapes), np.uint8),
        shapes=list(shapes),
        offsets=np.cumsum([0, *sizes]),
        data=np.ones(sum(sizes)),
        reasons={},
        mutated=-1,
    )


def test_what_can_stand_for_a_vector_becomes_one():
    """Columns and rows of the right length are vectors; everything else stays as it came."""
    found = normalised(outputs((3, 1), (1, 3), (3,), (), (4, 1), (3, 1)), [(3,)] * 5 + [(3, 1)])
    assert found.shapes == [(3,), (3,), (3,), (), (4, 1), (3, 1)]
    assert found.reshaped
    assert not normalised(outputs((3,), (2, 2)), [(3,), (3,)]).reshaped


@pytest.mark.parametrize("form", FORMS)
def test_every_form_of_the_right_vector_is_right(grade_source, form):
    """Columns, rows, matrices and lists pass; single precision is as wrong as its digits."""
    text = REFERENCE + STEP.format(name="residual", form=FORMS[form])
    verdict = grade_source(text)["residual"]
    assert (verdict.status == "passed") == (form != "single"), verdict
    assert len(verdict.remarks) == {"matrix": 2, "single": 0}.get(form, 1)  # of digits speaks the name of the mistake
    assert (verdict.slip == "residual_in_single_precision") == (form == "single")


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("name", MISTAKES)
def test_a_mistake_is_named_in_every_form(grade_source, name, form):
    """A known mistake has one name and one group, in whatever form it is returned."""
    slip = next(slip for slip in slips(name) if slip.identifier == MISTAKES[name])
    plain = submission_text(slip, name)
    vector, other = (grade_source(text)[name] for text in (plain, plain + STEP.format(name=name, form=FORMS[form])))
    assert vector.slip == other.slip == slip.identifier
    assert form == "single" or vector.group == other.group
