"""Log-in by a provider of OpenID Connect: a little one of the test's own, honest or not."""

import base64
import hmac
import http.server
import json
import threading
import time
from urllib.parse import parse_qs, urlsplit

import pytest
from joserfc import jwt
from joserfc.jwk import RSAKey
from starlette.testclient import TestClient

from app.errors import InputError
from app.people import People
from app.session import Store
from app.shell.provider import Provider
from app.shell.server import Shell
from app.workers.hub import Hub
from tests.people.conftest import PASSWORD
from tests.shell.conftest import ADDRESS

CLIENT, SECRET = "teachframe", "between us"


class School:
    """A provider: every code stands for one student, whose nonce it was given with."""

    def __init__(self):
        self.key = self.published = RSAKey.generate_key(2048, {"kid": "1"}, private=True)
        self.claims, self.header, self.asked = (
            {"sub": "s-1", "name": "Li Wei", "email": "li@school.example"},
            {},
            {},
        )
        outer = self

        class Handler(http.server.BaseHTTPRequestHandler):
            def do_GET(self):
                what = {
                    "/.well-known/openid-configuration": {
                        "issuer": outer.issuer,
                        "authorization_endpoint": f"{outer.issuer}/authorize",
                        "token_endpoint": f"{outer.issuer}/token",
                        "jwks_uri": f"{outer.issuer}/keys",
                    },
                    "/keys": {"keys": [outer.published.as_dict(private=False)]},
                }
                self._say(what.get(self.path))

            def do_POST(self):
                length = int(self.headers["content-length"])
                said = {k: v[0] for k, v in parse_qs(self.rfile.read(length).decode()).items()}
                outer.asked["token"] = said
                self._say({"access_token": "a", "token_type": "Bearer", "id_token": outer.token()})

            def _say(self, what):
                content = json.dumps(what).encode()
                self.send_response(200 if what is not None else 404)
                self.send_header("content-type", "application/json")
                self.send_header("content-length", str(len(content)))
                self.end_headers()
                self.wfile.write(content)

            def log_message(self, *args):
                pass

        self.server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        self.issuer = f"http://127.0.0.1:{self.server.server_port}"
        threading.Thread(target=self.server.serve_forever, daemon=True).start()

    def token(self):
        now = int(time.time())
        claims = {
            "iss": self.issuer,
            "aud": CLIENT,
            "iat": now,
            "exp": now + 300,
            "nonce": self.asked.get("nonce"),
            **self.claims,
        }
        return jwt.encode({"alg": "RS256", "kid": "1", **self.header}, claims, self.key)


@pytest.fixture
def school():
    school = School()
    yield school
    school.server.shutdown()
    school.server.server_close()


@pytest.fixture
def people(tmp_path):
    people = People(Store(tmp_path).database)
    people.add("admin", "Ada", "administrator", PASSWORD)
    return people


@pytest.fixture
def client(people, school, tmp_path):
    hub = Hub(Store(tmp_path), robot="ur10e", linger=30.0)
    shell = Shell(hub, "127.0.0.1", people=people, provider=Provider(school.issuer, CLIENT, SECRET))
    with TestClient(shell.app, base_url=ADDRESS, follow_redirects=False) as client:
        yield client
    hub.close()


def go(client, school):
    """To the provider; what it was asked."""
    there = client.get("/login/outside")
    assert there.status_code == 303 and there.headers["location"].startswith(f"{school.issuer}/authorize?")
    asked = {k: v[0] for k, v in parse_qs(urlsplit(there.headers["location"]).query).items()}
    school.asked["nonce"] = asked["nonce"]
    return asked


def back(client, asked, **said):
    return client.get("/login/outside/back", params={"state": asked["state"], "code": "c", **said})


def test_whom_the_school_vouches_for_is_let_in_and_known_again(client, school, people):
    assert "127.0.0.1" in client.get("/login").text
    asked = go(client, school)
    assert (
        asked["code_challenge_method"] == "S256" and asked["redirect_uri"] == f"{ADDRESS}/login/outside/back"
    )
    answer = back(client, asked)
    assert answer.status_code == 200 and 'content="0;url=/"' in answer.text
    assert "samesite=strict" in str(answer.headers).lower() and school.asked["token"]["code_verifier"]
    assert client.get("/account").status_code == 200
    person = people.find("li@school.example")
    assert person.role == "trainee" and person.name == "Li Wei"
    school.claims |= {"email": "other@school.example", "name": "Li Wei 2"}
    back(client, go(client, school))
    assert len(people.list()) == 2, "the same subject is the same person"


def test_a_name_that_is_taken_lets_nobody_into_that_account(client, school, people):
    school.claims |= {"preferred_username": "admin"}
    back(client, go(client, school))
    made = people.find("admin-2")
    assert made.role == "trainee" and "admin-2" in client.get("/account").text
    assert people.find("admin").name == "Ada"


def test_who_comes_by_the_school_alone_has_no_password_to_guess(client, school, people):
    back(client, go(client, school))
    from app.errors import PersonRefusedError

    for secret in ("", "x", PASSWORD):
        with pytest.raises(PersonRefusedError):
            people.authenticate("li@school.example", secret, "here")


def test_who_was_shut_out_stays_out(client, school, people):
    back(client, go(client, school))
    people.change(people.find("li@school.example").id, disabled=True)
    assert back(client, go(client, school)).status_code == 401
    assert client.get("/account").status_code == 303


@pytest.mark.parametrize(
    "wrong",
    [
        {"nonce": "another"},
        {"nonce": None},
        {"iss": "https://evil.example"},
        {"aud": "another client"},
        {"aud": [CLIENT, "another"], "azp": "another"},
        {"exp": 1},
        {"exp": "soon"},
        {"iat": 9_999_999_999},
        {"sub": "x" * 400},
        {"at_hash": "AAAA"},
    ],
)
def test_a_token_that_says_something_else_lets_nobody_in(client, school, people, wrong):
    asked = go(client, school)
    school.claims |= wrong
    answer = back(client, asked)
    assert answer.status_code == 401 and "did not" in answer.text and len(people.list()) == 1


def test_a_token_signed_by_somebody_else_lets_nobody_in(client, school, people):
    school.published = RSAKey.generate_key(2048, {"kid": "1"}, private=True)
    assert back(client, go(client, school)).status_code == 401 and len(people.list()) == 1


@pytest.mark.parametrize("alg", ["none", "HS256"])
def test_a_token_signed_by_nobody_or_by_the_public_key_lets_nobody_in(client, school, people, alg):
    asked = go(client, school)
    part = lambda d: base64.urlsafe_b64encode(json.dumps(d).encode()).rstrip(b"=").decode()  # noqa: E731
    now = int(time.time())
    claims = {
        "iss": school.issuer,
        "aud": CLIENT,
        "iat": now,
        "exp": now + 300,
        "nonce": asked["nonce"],
        "sub": "s",
    }
    signed = f"{part({'alg': alg, 'kid': '1'})}.{part(claims)}"
    public = school.key.as_pem(private=False)  # the shared secret, were it one
    by = b"" if alg == "none" else hmac.new(public, signed.encode(), "sha256").digest()
    school.token = lambda: f"{signed}.{base64.urlsafe_b64encode(by).rstrip(b'=').decode()}"
    assert back(client, asked).status_code == 401 and len(people.list()) == 1


def test_who_was_not_sent_there_by_us_is_not_let_in(client, school, people):
    asked = go(client, school)
    assert back(client, asked, state="another").status_code == 401
    assert back(client, asked, code="").status_code == 401
    client.cookies.delete("teachframe_outside")
    assert back(client, asked).status_code == 401, "the browser that left is not the one that came"
    client.cookies.set("teachframe_outside", "7b7d.00")
    assert back(client, asked).status_code == 401
    assert len(people.list()) == 1


def test_a_school_that_does_not_answer_is_said_in_one_line(client, school):
    school.server.shutdown()
    school.server.server_close()
    answer = client.get("/login/outside")
    assert answer.status_code == 503 and "does not answer" in answer.text


@pytest.mark.parametrize("issuer", ["http://login.example", "login.example", "", "ftp://127.0.0.1"])
def test_a_provider_without_tls_is_none(issuer):
    with pytest.raises(InputError):
        Provider(issuer, CLIENT, SECRET)
