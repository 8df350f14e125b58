"""The logo is read once, recognised by its bytes, and bounded."""

import pytest

from zlmreport.certificate.logo import read_logo
from zlmreport.errors import AccessError, InputError, Place

PLACE = Place("job.yaml", 3, 9)


@pytest.mark.parametrize(
    ("signature", "media_type"),
    [(b"\x89PNG\r\n\x1a\n", "image/png"), (b"\xff\xd8\xff", "image/jpeg")],
)
def test_a_picture_is_recognised_by_its_bytes_and_not_by_its_name(tmp_path, signature, media_type):
    path = tmp_path / "logo.dat"
    path.write_bytes(signature + b"rest")
    assert read_logo(path, PLACE) == (signature + b"rest", media_type)


@pytest.mark.parametrize("content", [b"", b"<svg/>", b"GIF89a"])
def test_anything_else_is_refused_at_its_place_in_the_job(tmp_path, content):
    path = tmp_path / "logo.png"
    path.write_bytes(content)
    with pytest.raises(InputError, match=r"job\.yaml:3:9: the logo logo\.png is neither PNG nor JPEG"):
        read_logo(path, PLACE)


def test_a_logo_above_2_mib_is_refused_without_being_read_whole(tmp_path):
    path = tmp_path / "logo.png"
    with path.open("wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n")
        file.truncate(1 << 30)
    with pytest.raises(InputError, match="larger than 2 MiB"):
        read_logo(path, PLACE)


def test_a_missing_logo_is_a_file_that_cannot_be_read(tmp_path):
    with pytest.raises(AccessError, match="cannot be read"):
        read_logo(tmp_path / "none.png", PLACE)
