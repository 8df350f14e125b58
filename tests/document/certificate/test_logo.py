"""The logo is read once, recognised by its bytes, and bounded."""

from io import BytesIO
from pathlib import Path

import pytest
from PIL import Image

from document.certificate.documents import certificate, having
from zlmreport.plugin import AccessError, InputError


def logo_of(path: Path) -> tuple[bytes | None, str]:
    """Return the logo on a certificate of a laboratory that has this file as one, and its media type."""
    letterhead = certificate(path.parent, having("laboratory.logo", path.name)).letterhead
    assert letterhead is not None
    return letterhead.logo, letterhead.logo_type


def picture(path, kind="PNG", size=(30, 10), mode="RGB", **settings):
    content = BytesIO()
    Image.new(mode, size).save(content, kind, **settings)
    path.write_bytes(content.getvalue())
    return path


@pytest.mark.parametrize(
    ("kind", "media_type", "mode", "settings"),
    [
        ("PNG", "image/png", "RGB", {}),
        ("PNG", "image/png", "RGBA", {}),
        ("PNG", "image/png", "P", {"transparency": 0}),
        ("JPEG", "image/jpeg", "RGB", {}),
        ("JPEG", "image/jpeg", "L", {"progressive": True}),
        ("JPEG", "image/jpeg", "RGB", {"icc_profile": b"profile" * 3000}),
    ],
)
def test_a_picture_is_recognised_by_its_bytes_and_not_by_its_name(tmp_path, kind, media_type, mode, settings):
    path = picture(tmp_path / "logo.dat", kind, mode=mode, **settings)
    assert logo_of(path) == (path.read_bytes(), media_type)


def test_a_picture_for_a_printing_press_is_refused(tmp_path):
    with pytest.raises(InputError, match=r"logo\.jpg is in CMYK colours.*save it in RGB"):
        logo_of(picture(tmp_path / "logo.jpg", "JPEG", mode="CMYK"))


@pytest.mark.parametrize("kind", ["PNG", "JPEG"])
def test_a_small_file_that_unpacks_to_a_huge_picture_is_refused(tmp_path, kind):
    path = picture(tmp_path / "logo", kind, size=(8000, 4000), mode="L")
    assert path.stat().st_size < 1024 * 1024
    with pytest.raises(InputError, match="8000 by 4000 pixels"):
        logo_of(path)


@pytest.mark.parametrize(
    "content",
    [
        b"\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\0\x09\0\0\0\x09\x08\x02\0\0\0....\0\0\x90\0IDATbroken off",
        b"\xff\xd8\xff\xc0\0\x11\x08\0\x09\0\x09\x03 broken off",
        b"\x89PNG\r\n\x1a\nrest",
        b"\xff\xd8\xffrest",
        b"\xff\xd8\xff\xe0\x00\x00" * 9,
    ],
)
def test_a_picture_without_a_size_or_an_end_is_damaged(tmp_path, content):
    path = tmp_path / "logo.png"
    path.write_bytes(content)
    with pytest.raises(InputError, match="is damaged; save it again"):
        logo_of(path)


@pytest.mark.parametrize("content", [b"", b"<svg/>", b"GIF89a"])
def test_anything_else_is_refused_at_its_place_in_the_job(tmp_path, content):
    path = tmp_path / "logo.png"
    path.write_bytes(content)
    with pytest.raises(InputError, match=r"job\.yaml:\d+:9: the logo logo\.png is neither PNG nor JPEG"):
        logo_of(path)


def test_a_logo_above_2_mib_is_refused_without_being_read_whole(tmp_path):
    path = tmp_path / "logo.png"
    with path.open("wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n")
        file.truncate(1 << 30)
    with pytest.raises(InputError, match="larger than 2 MiB"):
        logo_of(path)


def test_a_missing_logo_is_a_file_that_cannot_be_read(tmp_path):
    with pytest.raises(AccessError, match="cannot be read"):
        logo_of(tmp_path / "none.png")
