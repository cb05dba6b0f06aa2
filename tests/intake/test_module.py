"""Source text of modules: encodings as Python reads them, and a sentence for what is no text."""

from __future__ import annotations

import codecs
import io
import tokenize

import pytest
from hypothesis import given
from hypothesis import strategies as st

from autograder.errors import RejectedUpload
from autograder.intake.module import MAX_SOURCE, declared_encoding, read_module


@pytest.mark.parametrize(
    ("data", "text"),
    [
        (b"x = 1\n", "x = 1\n"),
        ("é = 1\n".encode(), "é = 1\n"),
        (codecs.BOM_UTF8 + "é".encode(), "é"),
        (b"# -*- coding: latin-1 -*-\n# \xe9\n", "# -*- coding: latin-1 -*-\n# é\n"),
        (b"#!/usr/bin/python\n# vim: set fileencoding=cp1252 :\n# \x80", None),
        ("# coding: gb18030\n# 李".encode("gb18030"), "# coding: gb18030\n# 李"),
        ("# coding: shift_jis\n# ソ".encode("shift_jis"), "# coding: shift_jis\n# ソ"),
        (b"# coding: UTF-8-sig\r\nx\ry", "# coding: UTF-8-sig\nx\ny"),
        (b"x = 1\n# coding: latin-1\n# \xc3\xa9", "x = 1\n# coding: latin-1\n# é"),
        (b"", ""),
    ],
)
def test_an_encoding_is_honoured_as_python_does(data: bytes, text: str | None) -> None:
    """PEP 263: a mark of UTF-8, or a comment in the first two lines, else UTF-8."""
    read = read_module(data)
    assert text is None or read == text
    encoding, _ = tokenize.detect_encoding(io.BytesIO(data).readline)
    assert read == data.decode(encoding).replace("\r\n", "\n").replace("\r", "\n")


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (b"x = '\xe9'\n", "is not text in utf-8 (line 1); save it as UTF-8 in your editor"),
        (b"\n\n# \xff\n", "is not text in utf-8 (line 3)"),
        (b"x\0y", "is a binary file (it holds zero bytes)"),
        (b"# coding: rot13\nk = 1", "declares the encoding rot13, which is not read; save it as UTF-8"),
        (b"# coding: zlib\n", "declares the encoding zlib"),
        (b"# coding: unicode_escape\n", "declares the encoding unicode_escape"),
        (b"# coding: utf-7\n", "declares the encoding utf-7"),
        (b"# coding: undefined\n", "declares the encoding undefined"),
        (b"# coding: idna\n", "declares the encoding idna"),
        (b"# coding: ..x\n", "declares the encoding ..x"),
        (b"# coding: cp9999\n", "declares the encoding cp9999, which is not known here"),
        (b"# coding: " + b"a" * 5000, "declares the encoding " + "a" * 40 + ","),
        (codecs.BOM_UTF8 + b"# coding: latin-1\n", "begins with the mark of UTF-8 but declares latin-1"),
        (codecs.BOM_UTF16_LE + "x".encode("utf-16-le"), "is text in UTF-16; save it as UTF-8"),
        (b"PK\x03\x04..", "is a zip archive; give it a name that ends in .zip"),
        (b"%PDF-1.7", "is a PDF document"),
        (b"x" * (MAX_SOURCE + 1), "is larger than 1 MiB"),
        (b"# coding: latin-1\n# " + b"\xe9" * 700_000, "is larger than 1 MiB"),
    ],
)
def test_what_is_no_text_is_rejected_in_words(data: bytes, words: str) -> None:
    """What came, what was expected, what to try."""
    with pytest.raises(RejectedUpload) as raised:
        read_module(data)
    assert words in str(raised.value)


@given(
    st.lists(st.sampled_from([b"", b"# x", b"#!/bin/sh", b"x = 1", b"  # y", b"# coding: latin-1", b"#coding=ascii"])),
    st.sampled_from([b"\n", b"\r\n"]),
)
def test_the_declared_encoding_is_that_of_the_tokenizer(lines: list[bytes], end: bytes) -> None:
    """Wherever the comment stands, Python's own tokenizer finds the same."""
    data = end.join(lines)
    expected, _ = tokenize.detect_encoding(io.BytesIO(data).readline)
    assert codecs.lookup(declared_encoding(data)) == codecs.lookup(expected)


@given(st.one_of(st.binary(max_size=300), st.text(max_size=60).map(lambda text: f"# coding: {text}\n\xe9".encode())))
def test_no_bytes_make_it_fail_in_another_way(data: bytes) -> None:
    """Either text that can be encoded, or a sentence."""
    try:
        text = read_module(data)
    except RejectedUpload as error:
        text = str(error)
    assert text.encode() is not None
    assert "\r" not in text
