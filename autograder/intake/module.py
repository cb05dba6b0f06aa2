"""A .py file becomes text: the encoding that it declares is honoured where that is safe, nothing is parsed."""

from __future__ import annotations

import codecs
import re

from autograder.errors import RejectedUpload

MAX_SOURCE = 1 << 20  # bytes of source text, of a module or of all code cells of a notebook

_TOO_LARGE = "is larger than 1 MiB, the limit for a .py file; remove data from the source"
_COOKIE = re.compile(rb"[ \t\f]*#.*?coding[:=][ \t]*([-\w.]+)")  # PEP 263
_BLANK = re.compile(rb"[ \t\f]*(?:#.*)?$")
# Only encodings of text that decode without surprises; a cookie like "zlib" or "unicode_escape" names a program.
_FAMILIES = re.compile(
    r"ascii|us-ascii|latin-?1|iso-?latin-1|iso-?8859-\d{1,2}|l1|cp\d{3,4}|windows-125\d|koi8-[rtu]|mac-?roman|"
    r"gbk|gb2312|gb18030|big5|big5hkscs|euc-?(?:jp|kr|cn)|shift-?jis|sjis|johab|hz"
)
_UTF8 = re.compile(r"utf-?8(?:-(?:sig|unix|dos|mac))?|u8")
_UTF16 = "text in UTF-16; save it as UTF-8"
_SIGNATURES = (
    (b"PK\x03\x04", "a zip archive; give it a name that ends in .zip"),
    (b"%PDF", "a PDF document; hand in the .py or .ipynb file itself"),
    (b"\x1f\x8b", "a gzip archive; pack it as .zip"),
    (b"Rar!", "a RAR archive; pack it as .zip"),
    (b"7z\xbc\xaf", "a 7z archive; pack it as .zip"),
    (b"{\\rtf", "a rich text document; save it as plain text"),
    (b"\x7fELF", "a program; hand in its source text"),
    (codecs.BOM_UTF16_LE, _UTF16),
    (codecs.BOM_UTF16_BE, _UTF16),
)


def read_module(data: bytes) -> str:
    """Decode the source of a module; raises RejectedUpload with the end of a sentence where it is no text."""
    if len(data) > MAX_SOURCE:
        raise RejectedUpload(_TOO_LARGE)
    reject_foreign(data)
    if b"\0" in data:
        raise RejectedUpload("is a binary file (it holds zero bytes), expected Python source; hand in the source text")
    encoding = declared_encoding(data)
    body = data.removeprefix(codecs.BOM_UTF8)
    try:
        text = body.decode(encoding)
    except UnicodeDecodeError as error:
        line = body.count(b"\n", 0, error.start) + 1
        raise RejectedUpload(f"is not text in {encoding} (line {line}); save it as UTF-8 in your editor") from None
    except (LookupError, ValueError):
        raise RejectedUpload(f"declares the encoding {encoding}, which is not known here; save it as UTF-8") from None
    if len(text.encode()) > MAX_SOURCE:
        raise RejectedUpload(_TOO_LARGE)
    return one_newline(text)


def declared_encoding(data: bytes) -> str:
    """Return the encoding that a module declares in its first two lines (PEP 263), "utf-8" where it declares none.

    Examples
    --------
    >>> declared_encoding(b"# -*- coding: latin-1 -*-"), declared_encoding(b"x = 1")
    ('latin-1', 'utf-8')
    """
    marked = data.startswith(codecs.BOM_UTF8)
    head = data.removeprefix(codecs.BOM_UTF8)[:8192].splitlines()[:2]
    for line in head:
        if found := _COOKIE.match(line):
            name = found[1].decode("ascii", "replace")
            plain = name.lower().replace("_", "-")
            if _UTF8.fullmatch(plain):
                return "utf-8"
            if marked:
                raise RejectedUpload(f"begins with the mark of UTF-8 but declares {name[:40]}; save it as UTF-8")
            if not _FAMILIES.fullmatch(plain):
                raise RejectedUpload(f"declares the encoding {name[:40]}, which is not read; save it as UTF-8")
            return plain
        if not _BLANK.match(line):
            break
    return "utf-8"


def reject_foreign(data: bytes) -> None:
    """Raise RejectedUpload where the first bytes show another kind of file, saying which."""
    for signature, words in _SIGNATURES:
        if data.startswith(signature):
            raise RejectedUpload(f"is {words}")
    if data[257:262] == b"ustar":
        raise RejectedUpload("is a tar archive; pack it as .zip")
    if data[:4].count(0) == 2 and b"\0\0" in (data[0:4:2], data[1:4:2]):  # without a mark; every other byte is 0
        raise RejectedUpload(f"is {_UTF16}")


def one_newline(text: str) -> str:
    r"""Write every line ending as "\n", so that the same source has the same digest from every system."""
    return text.replace("\r\n", "\n").replace("\r", "\n")
