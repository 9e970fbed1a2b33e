"""Forms and cookies that are not the person's own do nothing."""

import hashlib

import pytest
from starlette.testclient import TestClient

from app.shell.security import COOKIE
from app.shell.signing import signed
from tests.people.conftest import PASSWORD, PIN
from tests.shell.accounts.forms import come, token
from tests.shell.conftest import ORIGIN


@pytest.mark.parametrize(
    "path", ["/login", "/join", "/logout", "/account/secret", "/account/erase", "/account/export"]
)
@pytest.mark.parametrize("forged", ["", "0" * 64, "another browser's"])
def test_a_form_without_its_own_token_does_nothing(browser, school, people, path, forged):
    client = browser(school["trainee1"])
    if forged.startswith("another"):
        forged = token(browser())
    said = {"token": forged, "login": "admin", "secret": PASSWORD, "code": school["class1"].code}
    answer = client.post(path, data={**said, "name": "New", "pin": PIN}, headers=ORIGIN)
    assert answer.status_code == 403
    assert client.get("/account").status_code == 200 and people.get(school["trainee1"].id) is not None


@pytest.mark.parametrize("origin", ["https://evil.example", "null", None])
def test_a_form_from_elsewhere_does_nothing(browser, school, origin):
    client = browser(school["trainee1"])
    headers = {} if origin is None else {"origin": origin}
    assert (
        client.post("/logout", data={"token": token(client, "/account")}, headers=headers).status_code == 403
    )
    assert client.get("/account").status_code == 200


def test_a_form_that_is_none_does_nothing(browser, school):
    client = browser()
    form = {**ORIGIN, "content-type": "application/x-www-form-urlencoded"}
    assert client.post("/login", content=b"a" * 100_000, headers=form).status_code == 403
    assert client.post("/login", content=b"\xff\xfe=%", headers=form).status_code == 403
    assert client.post("/login", json={"login": "admin"}, headers=ORIGIN).status_code == 403
    assert client.post("/login", content="&".join("a=1" for _ in range(900)), headers=form).status_code == 403


@pytest.mark.parametrize(
    "cookie",
    [
        "",
        "x",
        "x.y",
        ".",
        "STOLEN_HASH",
        "SECRET_ONLY",
        "OTHER_SIGNATURE",
        "\ud800".encode("utf-8", "surrogatepass").decode("latin-1"),
    ],
)
def test_a_forged_cookie_is_nobodys(browser, people, school, shell, cookie):
    secret = people.logins.begin(school["trainee1"].id)
    good = signed(shell._entrance.key, secret).rpartition(".")[2]
    forged = {
        "STOLEN_HASH": f"{hashlib.sha256(secret.encode()).hexdigest()}.{good}",
        "SECRET_ONLY": secret,
        "OTHER_SIGNATURE": f"{secret}.{good[::-1]}",
    }.get(cookie, cookie)
    client = browser()
    headers = {"cookie": f"{COOKIE}={forged}".encode("latin-1")}
    assert client.get("/state", headers=headers).status_code == 401
    assert client.get("/account", headers=headers).status_code == 303
    assert client.get("/account", headers={"cookie": f"{COOKIE}={secret}.{good}"}).status_code == 200


def test_a_log_in_brings_a_secret_that_no_browser_had_before(browser, school):
    client = browser(school["trainee1"])
    before = client.cookies[COOKIE]
    come(client, "/login", login=school["trainee2"].login, secret=PIN)
    assert client.cookies[COOKIE] != before
    old = {"cookie": f"{COOKIE}={before}"}
    assert browser().get("/account", headers=old).status_code == 303, "the log-in before has ended"


def test_cookies_are_hidden_from_scripts_and_sites_and_go_over_tls_alone(shell, school):
    client = TestClient(shell.app, base_url="https://127.0.0.1:8080", follow_redirects=False)
    answer = client.post(
        "/login",
        data={"token": token(client), "login": "admin", "secret": PASSWORD},
        headers={"origin": "https://127.0.0.1:8080"},
    )
    said = answer.headers["set-cookie"].lower()
    assert answer.status_code == 303
    assert all(word in said for word in ("httponly", "samesite=strict", "secure", "max-age=86400"))
    plain = {"origin": "http://127.0.0.1:8080"}
    assert client.post("/logout", headers=plain).status_code == 403, "a page without TLS is another place"
