"""Pictures attached to markdown cells: small PNG and JPEG files, taken apart and put together again without extras."""

from __future__ import annotations

import base64
import binascii
import hashlib
import re
import zlib
from collections.abc import Iterable, Iterator, Mapping
from itertools import islice

import msgspec

MAX_PICTURE = 512 << 10  # bytes of one picture
MAX_PICTURES = 2 << 20  # bytes of all pictures of a submission
_MOST = 64  # pictures that one cell shows; each is looked for again in the written answers
_KINDS = 4  # media types of one attachment that are looked at
_MAX_SIDE = 8192  # pixels
_ATTACHMENT = re.compile(r"attachment:([^\s)\"'>]{1,200})")
_KINDS_OF = msgspec.json.Decoder(dict[str, str])
_PNG = b"\x89PNG\r\n\x1a\n"
_KEPT = {b"IHDR", b"PLTE", b"tRNS", b"IDAT", b"IEND"}  # what a picture needs; text, times and colours of a camera go
_FRAMES = {*range(0xC0, 0xD0)} - {0xC4, 0xC8, 0xCC}  # markers that carry the size of a JPEG
_SCAN = 0xDA


def with_pictures(text: str, attached: Mapping[str, msgspec.Raw], left: int) -> tuple[str, dict[str, str], int]:
    """Name the attachments of one cell by their content, and return those that may be shown.

    Parameters
    ----------
    text : str
        Markdown of the cell.
    attached : mapping
        Name -> media type -> base64, as Jupyter writes it, the inner table still undecoded.
    left : int
        Bytes that this submission may still use.

    Returns
    -------
    tuple
        The text with new names, new name -> data URI, and the bytes that are left.
    """
    names: dict[str, str] = {}
    pictures: dict[str, str] = {}
    shown = dict.fromkeys(found[1] for found in _ATTACHMENT.finditer(text))  # each once: a cell may name one often
    for name in islice((name for name in shown if name in attached), _MOST):
        for data in islice(_kinds(attached[name]), _KINDS):
            if len(data) > 2 * MAX_PICTURE:
                continue
            try:
                found = cleaned(base64.b64decode("".join(data.split()), validate=True))
            except (binascii.Error, ValueError):
                continue
            if found is None or len(found[1]) > left:
                continue
            kind, clean = found
            left -= len(clean)
            names[name] = f"{hashlib.sha256(clean).hexdigest()[:20]}.{kind}"
            pictures[names[name]] = f"data:image/{kind};base64,{base64.b64encode(clean).decode()}"
            break
    if not names:
        return text, pictures, left
    renamed = _ATTACHMENT.sub(lambda found: f"attachment:{names.get(found[1], found[1])}", text)
    return renamed, pictures, left


def _kinds(raw: msgspec.Raw) -> Iterable[str]:
    try:
        return _KINDS_OF.decode(raw).values()
    except (msgspec.DecodeError, RecursionError, ValueError):
        return ()


def cleaned(data: bytes) -> tuple[str, bytes] | None:
    """Return kind and bytes of a PNG or JPEG without its extras; None where it is none, broken, or too large."""
    if len(data) > MAX_PICTURE:
        return None
    try:
        if data.startswith(_PNG):
            return "png", _png(data)
        if data.startswith(b"\xff\xd8\xff"):
            return "jpeg", _jpeg(data)
    except (ValueError, IndexError):
        return None
    return None


def _png(data: bytes) -> bytes:
    chunks = list(_chunks(data))
    kinds = [kind for kind, _ in chunks]
    if kinds[:1] != [b"IHDR"] or kinds[-1:] != [b"IEND"] or b"IDAT" not in kinds or len(chunks[0][1]) != 13:
        raise ValueError("no whole PNG")
    head = chunks[0][1]
    _check_size(int.from_bytes(head[:4], "big"), int.from_bytes(head[4:8], "big"))
    kept = [_chunk(kind, body) for kind, body in chunks if kind in _KEPT]
    return _PNG + b"".join(kept)


def _chunks(data: bytes) -> Iterator[tuple[bytes, bytes]]:
    at = len(_PNG)
    while at < len(data):
        length, kind = int.from_bytes(data[at : at + 4], "big"), data[at + 4 : at + 8]
        body, check = data[at + 8 : at + 8 + length], data[at + 8 + length : at + 12 + length]
        if len(check) != 4 or int.from_bytes(check, "big") != zlib.crc32(kind + body):
            raise ValueError("a broken chunk")
        yield kind, body
        if kind == b"IEND":
            return
        at += 12 + length


def _chunk(kind: bytes, body: bytes) -> bytes:
    return len(body).to_bytes(4, "big") + kind + body + zlib.crc32(kind + body).to_bytes(4, "big")


def _jpeg(data: bytes) -> bytes:
    kept = [b"\xff\xd8"]
    at, sized = 2, False
    while True:
        if data[at] != 0xFF:
            raise ValueError("no marker")
        marker = data[at + 1]
        length = int.from_bytes(data[at + 2 : at + 4], "big")
        segment = data[at : at + 2 + length]
        if length < 2 or len(segment) != 2 + length:
            raise ValueError("a broken segment")
        if marker in _FRAMES:
            _check_size(int.from_bytes(segment[7:9], "big"), int.from_bytes(segment[5:7], "big"))
            sized = True
        if not (0xE1 <= marker <= 0xEF or marker == 0xFE):  # applications' data, where it was taken, comments
            kept.append(segment)
        if marker == _SCAN:
            end = data.rindex(b"\xff\xd9")
            if not sized or end < at:
                raise ValueError("no whole JPEG")
            return b"".join([*kept, data[at + 2 + length : end + 2]])
        at += 2 + length


def _check_size(wide: int, high: int) -> None:
    if not (0 < wide <= _MAX_SIDE and 0 < high <= _MAX_SIDE):
        raise ValueError("too many pixels")
