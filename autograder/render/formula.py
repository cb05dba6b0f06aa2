"""Formulas as MathML, which browsers show and print by themselves: what the handout and students type most."""

from __future__ import annotations

import re

from markupsafe import escape

__all__ = ["mathml"]

_TOKEN = re.compile(
    r"\\(?:begin|end)\{[a-z]+\}|\\text\{[^{}$\\]*\}|\\operatorname\*?\{[A-Za-z]+\}"
    r"|\\[A-Za-z]+|\\.|\d+(?:[.,]\d+)*|[A-Za-z]|\S|\s+"
)
_LONGEST = 400  # characters
_DEEPEST = 12
_NAMES = """alpha beta gamma delta epsilon varepsilon zeta eta theta lambda mu nu xi pi rho sigma tau phi varphi chi psi
omega Gamma Delta Theta Lambda Xi Pi Sigma Phi Psi Omega infty partial nabla ell top"""
_LETTERS = dict(zip(_NAMES.split(), "αβγδϵεζηθλμνξπρστϕφχψωΓΔΘΛΞΠΣΦΨΩ∞∂∇ℓ⊤", strict=True))
_OPERATORS = {
    "cdot": "⋅", "times": "×", "pm": "±", "le": "≤", "leq": "≤", "ge": "≥", "geq": "≥", "ne": "≠", "neq": "≠",
    "approx": "≈", "equiv": "≡", "sim": "∼", "to": "→", "rightarrow": "→", "Rightarrow": "⇒", "mapsto": "↦", "in": "∈",
    "sum": "∑", "prod": "∏", "int": "∫", "min": "min", "max": "max", "log": "log", "exp": "exp", "ldots": "…",
    "dots": "…", "cdots": "⋯", "mid": "|", "lVert": "‖", "rVert": "‖", "|": "‖", "{": "{", "}": "}", "ll": "≪",
    "Vert": "‖",
}  # fmt: skip
_FONTS = {"mathbf": "bold", "boldsymbol": "bold", "bm": "bold", "mathrm": "normal", "mathit": ""}
_SCRIPT = {"N": "𝒩", "L": "ℒ", "O": "𝒪"}
_MATRICES = {"pmatrix": "()", "bmatrix": "[]", "matrix": ("", ""), "vmatrix": "||"}
_UNDER = ("<mo>∑</mo>", "<mo>∏</mo>", "<mo>min</mo>", "<mo>max</mo>")  # what stands below them stands right below
_SPACES = {",", ";", ":", "!", " ", "left", "right", "displaystyle"}
_SIGNS = {"'": "′", "-": "−"}
_BEFORE_A_SIGN = {"=", "\\approx", "\\cr", "\\\\", "&"}  # where a sign belongs to what comes after it
_WIDE = {"quad": "1em", "qquad": "2em"}


class _UnknownError(Exception):
    """Something that this small reader does not know."""


def mathml(formula: str, longest: int = _LONGEST) -> str | None:
    r"""Write a formula as MathML; None where it is too long or holds something that is not known.

    Parameters
    ----------
    formula : str
        What stands between the dollars, in one line.
    longest : int
        Characters that are read; text from elsewhere can be made to be slow.

    Examples
    --------
    >>> mathml("x^{2}")
    '<math><msup><mi>x</mi><mn>2</mn></msup></math>'
    >>> mathml(r"\\begin{matrix}") is None
    True
    """
    if len(formula) > longest or not formula.isprintable():
        return None
    reader = _Reader([token for token in _TOKEN.findall(formula) if not token.isspace()])
    try:
        inside = reader.row("")
    except (_UnknownError, IndexError):
        return None
    return f"<math>{inside}</math>" if inside else None


class _Reader:
    """Reads tokens from left to right."""

    def __init__(self, tokens: list[str]) -> None:
        self.tokens = tokens
        self.at = self.depth = 0

    def row(self, end: str) -> str:
        """Read until `end`, which is taken too."""
        self.depth += 1
        if self.depth > _DEEPEST:
            raise _UnknownError
        parts: list[str] = []
        while self.at < len(self.tokens) and self.tokens[self.at] != end:
            parts.append(self.scripted())
        if end:
            self.take()
        self.depth -= 1
        parts = [part for part in parts if part]
        return parts[0] if len(parts) == 1 else f"<mrow>{''.join(parts)}</mrow>" if parts else ""

    def take(self) -> str:
        """Take the next token."""
        token = self.tokens[self.at]
        self.at += 1
        return token

    def scripted(self) -> str:
        """Read one thing with what stands above and below it."""
        under = self.tokens[self.at].startswith(("\\underbrace", "\\operatorname*"))
        base = self.one()
        under = under or base in _UNDER
        above = below = ""
        while self.at < len(self.tokens) and self.tokens[self.at] in ("^", "_"):
            if self.take() == "^":
                if above:
                    raise _UnknownError
                above = self.one() or "<mrow></mrow>"
            else:
                if below:
                    raise _UnknownError
                below = self.one() or "<mrow></mrow>"
        base = base or ("<mrow></mrow>" if above or below else "")
        if under and below:
            return f"<munder>{base}{below}</munder>" if not above else f"<munderover>{base}{below}{above}</munderover>"
        if above and below:
            return f"<msubsup>{base}{below}{above}</msubsup>"
        if above:
            return f"<msup>{base}{above}</msup>"
        return f"<msub>{base}{below}</msub>" if below else base

    def one(self) -> str:
        """Read one letter, number, sign, group or command."""
        token = self.take()
        if token == "{":
            return self.row("}")
        if token.startswith("\\"):
            return self.command(token[1:])
        if token[0].isdigit():
            return f"<mn>{token}</mn>"
        if token.isalpha():
            return f"<mi>{escape(token)}</mi>"
        if token in ("}", "^", "_", "&", "#", "%", "$"):
            raise _UnknownError
        before = self.tokens[self.at - 2] if self.at > 1 else ""
        form = ' form="prefix"' if token in "+-" and before in _BEFORE_A_SIGN else ""
        if token in "()[]":
            form = ' stretchy="false"'  # or it is lowered where an index or a power follows
        return f"<mo{form}>{_SIGNS.get(token) or escape(token)}</mo>"

    def command(self, name: str) -> str:
        """Read a command with its arguments."""
        if name in _LETTERS:
            return _upright(_LETTERS[name]) if name[0].isupper() else f"<mi>{_LETTERS[name]}</mi>"
        if name in _OPERATORS:
            return f"<mo>{_OPERATORS[name]}</mo>"
        if name in _SPACES:
            return ""
        if name in _WIDE:
            return f'<mspace width="{_WIDE[name]}"></mspace>'
        if name in _FONTS:
            return self.font(_FONTS[name])
        word, _, inside = name.rstrip("}").partition("{")
        if word == "text" and word != name:
            return f"<mtext>{escape(inside)}</mtext>"
        if word.startswith("operatorname") and word != name:
            return f"<mo>{inside}</mo>"
        return self.matrix(inside) if word == "begin" and inside in _MATRICES else self.structure(name)

    def font(self, weight: str) -> str:
        """Read what stands in bold or upright letters."""
        inside = self.one()
        if not weight:
            return inside
        return f'<mrow class="{weight}">{re.sub(r"<mi>(.)</mi>", lambda letter: _upright(letter[1]), inside)}</mrow>'

    def structure(self, name: str) -> str:
        """Read what is built of parts: fractions, roots, marks above and braces below."""
        if name in ("frac", "tfrac", "dfrac"):
            return f"<mfrac>{self.one() or '<mrow></mrow>'}{self.one() or '<mrow></mrow>'}</mfrac>"
        if name == "sqrt":
            return f"<msqrt>{self.one()}</msqrt>"
        if name in ("hat", "bar", "tilde"):
            mark = {"hat": "^", "bar": "¯", "tilde": "~"}[name]
            return f"<mover>{self.one() or '<mrow></mrow>'}<mo>{mark}</mo></mover>"
        if name == "underbrace":
            return f"<munder>{self.one() or '<mrow></mrow>'}<mo>⏟</mo></munder>"
        if name == "underset":
            below = self.one() or "<mrow></mrow>"
            return f"<munder>{self.one() or '<mrow></mrow>'}{below}</munder>"
        if name == "mathcal":
            return self.calligraphic()
        raise _UnknownError

    def calligraphic(self) -> str:
        """Read one calligraphic letter."""
        letter = self.take()
        if letter not in _SCRIPT:
            raise _UnknownError
        return f"<mi>{_SCRIPT[letter]}</mi>"

    def matrix(self, name: str) -> str:
        """Read rows and columns until the matrix ends."""
        self.depth += 1
        if self.depth > _DEEPEST:
            raise _UnknownError
        rows: list[list[str]] = [[""]]
        while (token := self.tokens[self.at]) != f"\\end{{{name}}}":
            if token == "&":
                self.take()
                rows[-1].append("")
            elif token in {"\\cr", "\\\\"}:
                self.take()
                rows.append([""])
            else:
                rows[-1][-1] += self.scripted()
        self.take()
        self.depth -= 1
        table = "".join(f"<mtr>{''.join(f'<mtd>{cell}</mtd>' for cell in row)}</mtr>" for row in rows)
        left, right = (f"<mo>{fence}</mo>" if fence else "" for fence in _MATRICES[name])
        return f'<mrow class="{name}">{left}<mtable>{table}</mtable>{right}</mrow>'


def _upright(letter: str) -> str:
    return f'<mi mathvariant="normal">{letter}</mi>'
