"""Only the browser that was given the token is answered, and its pages load nothing from elsewhere."""

from __future__ import annotations

import pytest
from starlette.testclient import TestClient

from zlmreport.web.guard import Door

ADDRESSES = [
    "/",
    "/files/workbench.js",
    "/effects/backlash",
    "/documents/x.pdf",
    "/api/job",
    "/api/stamp",
    "/api/diagnosis",
]


@pytest.mark.parametrize("address", ADDRESSES)
def test_without_the_token_nothing_is_answered(stranger: TestClient, address: str) -> None:
    assert stranger.get(address).status_code == 403


@pytest.mark.parametrize("token", ["", "x", "ä"])
def test_a_wrong_token_opens_nothing(stranger: TestClient, token: str) -> None:
    answer = stranger.get("/", params={"token": token})
    assert answer.status_code == 403
    assert "set-cookie" not in answer.headers


def test_the_token_opens_the_page_and_leaves_the_address(stranger: TestClient, door: Door) -> None:
    answer = stranger.get(door.address)
    assert answer.status_code == 303
    assert answer.headers["location"] == "/"
    assert stranger.get("/").status_code == 200


def test_the_language_stays_in_the_address(stranger: TestClient, door: Door) -> None:
    assert stranger.get(f"{door.address}&lang=de").headers["location"] == "/?lang=de"


def test_no_script_reads_the_cookie_and_no_other_page_sends_it(stranger: TestClient, door: Door) -> None:
    cookie = stranger.get(door.address).headers["set-cookie"].lower()
    assert "httponly" in cookie
    assert "samesite=strict" in cookie


def test_the_token_opens_nothing_but_the_page(stranger: TestClient, door: Door) -> None:
    assert stranger.get("/api/job", params={"token": door.token}).status_code == 403


@pytest.mark.parametrize("host", ["evil.example", "evil.example:8420", "127.0.0.1", "127.0.0.1:80", ""])
def test_a_foreign_name_of_the_host_is_refused(browser: TestClient, host: str) -> None:
    """A foreign page that has its own name point to this computer is a foreign page still."""
    assert browser.get("/api/job", headers={"Host": host}).status_code == 421


@pytest.mark.parametrize(
    "origin", ["http://evil.example", "null", "http://127.0.0.1:80", "https://127.0.0.1:8420"]
)
@pytest.mark.parametrize("method", ["GET", "POST"])
def test_a_foreign_origin_is_refused(browser: TestClient, method: str, origin: str) -> None:
    answer = browser.request(method, "/api/certificate", headers={"Origin": origin})
    assert answer.status_code == 403


def test_a_change_without_an_origin_is_refused(browser: TestClient) -> None:
    del browser.headers["Origin"]
    assert browser.post("/api/change", json={}).status_code == 403


def test_a_form_of_another_page_is_refused(browser: TestClient) -> None:
    assert browser.post("/api/change", data={"action": "undo"}).status_code == 415


def test_a_body_without_end_is_refused(browser: TestClient) -> None:
    long = b"x" * 70_000
    answer = browser.post("/api/change", content=long, headers={"Content-Type": "application/json"})
    assert answer.status_code == 413


def test_a_length_that_is_no_count_is_refused(browser: TestClient) -> None:
    headers = {"Content-Type": "application/json", "Content-Length": "9" * 5000}
    assert browser.post("/api/change", content=b"{}", headers=headers).status_code == 413


@pytest.mark.parametrize("address", ADDRESSES[:4])
def test_every_answer_keeps_its_page_in(browser: TestClient, address: str) -> None:
    headers = browser.get(address).headers
    policy = headers["content-security-policy"]
    assert policy.startswith("default-src 'none'; script-src 'self'; style-src 'self'")
    assert "unsafe" not in policy
    assert headers["x-content-type-options"] == "nosniff"
    assert headers["referrer-policy"] == "no-referrer"


def test_a_refusal_keeps_its_page_in(stranger: TestClient) -> None:
    assert stranger.get("/").headers["content-security-policy"].startswith("default-src 'none'")


def test_the_page_holds_no_script_and_no_style_of_its_own(browser: TestClient) -> None:
    text = browser.get("/").text
    assert "<style" not in text
    assert "style=" not in text
    assert (
        text.count("<script") == text.count('<script type="module" src="/files/workbench.js"></script>') == 1
    )


@pytest.mark.parametrize("folder", ["files", "documents"])
@pytest.mark.parametrize(
    "name",
    [
        "../job.yaml",
        "..%2fjob.yaml",
        "%2e%2e/job.yaml",
        "%2e%2e%2fjob.yaml",
        "/etc/passwd",
        "%2fetc%2fpasswd",
        "job.yaml",
        "",
    ],
)
def test_no_path_leads_out(browser: TestClient, folder: str, name: str) -> None:
    assert browser.get(f"/{folder}/{name}").status_code == 404
