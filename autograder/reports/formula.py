"""Formulas of written answers as MathML: what students type most; anything else stays as it was typed."""

from __future__ import annotations

import re

from markupsafe import escape

_TOKEN = re.compile(r"\\[A-Za-z]+|\\.|\d+(?:[.,]\d+)*|[A-Za-z]|\S|\s+")
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
}  # fmt: skip
_FONTS = {"mathbf": "bold", "boldsymbol": "bold", "bm": "bold", "mathrm": "normal", "text": "normal", "mathit": ""}
_SPACES = {",", ";", ":", "!", " ", "quad", "qquad", "left", "right", "displaystyle"}


class _UnknownError(Exception):
    """Something that this small reader does not know."""


def mathml(formula: str) -> str | None:
    r"""Write a formula as MathML; None where it holds something that is not known.

    Examples
    --------
    >>> mathml("x^{2}")
    '<math><msup><mi>x</mi><mn>2</mn></msup></math>'
    >>> mathml(r"\\begin{matrix}") is None
    True
    """
    if len(formula) > _LONGEST or not formula.isprintable():
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
        base = self.one()
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
        return "<mo>′</mo>" if token == "'" else f"<mo>{escape(token)}</mo>"

    def command(self, name: str) -> str:
        """Read a command with its arguments."""
        if name in _LETTERS:
            return f"<mi>{_LETTERS[name]}</mi>"
        if name in _OPERATORS:
            return f"<mo>{_OPERATORS[name]}</mo>"
        if name in _SPACES:
            return ""
        if name in _FONTS:
            inside = self.one()
            return f'<mrow class="{_FONTS[name]}">{inside}</mrow>' if _FONTS[name] else inside
        if name in ("frac", "tfrac", "dfrac"):
            return f"<mfrac>{self.one() or '<mrow></mrow>'}{self.one() or '<mrow></mrow>'}</mfrac>"
        if name == "sqrt":
            return f"<msqrt>{self.one()}</msqrt>"
        if name in ("hat", "bar", "tilde"):
            mark = {"hat": "^", "bar": "¯", "tilde": "~"}[name]
            return f"<mover>{self.one() or '<mrow></mrow>'}<mo>{mark}</mo></mover>"
        raise _UnknownError
