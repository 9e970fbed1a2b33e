"""How browsers come: by TLS of the server's own, through a proxy, under a prefix."""

import datetime
import http.client
import ssl

import pytest
from cryptography import x509
from cryptography.hazmat.primitives import hashes, serialization
from cryptography.hazmat.primitives.asymmetric import ec
from cryptography.x509.oid import NameOID
from starlette.testclient import TestClient

from app.people import People
from app.session import Store
from app.shell.server import PendantServer, Shell
from app.shell.way import Way
from app.workers.hub import Hub
from tests.people.conftest import PASSWORD
from tests.shell.conftest import ADDRESS, ORIGIN, SOCKET


@pytest.fixture
def certified(tmp_path):
    """A certificate for 127.0.0.1 by its own key, as two files."""
    key = ec.generate_private_key(ec.SECP256R1())
    name = x509.Name([x509.NameAttribute(NameOID.COMMON_NAME, "127.0.0.1")])
    now = datetime.datetime.now(datetime.UTC)
    made = x509.CertificateBuilder(name, name, key.public_key(), x509.random_serial_number())
    made = (
        made.not_valid_before(now)
        .not_valid_after(now + datetime.timedelta(days=1))
        .sign(key, hashes.SHA256())
    )
    parts = {
        "cert.pem": made.public_bytes(serialization.Encoding.PEM),
        "key.pem": key.private_bytes(
            serialization.Encoding.PEM, serialization.PrivateFormat.PKCS8, serialization.NoEncryption()
        ),
    }
    for file, content in parts.items():
        (tmp_path / file).write_bytes(content)
    return tmp_path / "cert.pem", tmp_path / "key.pem"


@pytest.fixture
def serve(tmp_path):
    """Starts a server with one account."""
    servers = []

    def serve_(way):
        store = Store(tmp_path / "data")
        people = People(store.database)
        if not people.any():
            people.add("ada", "Ada", "administrator", PASSWORD)
        servers.append(PendantServer(store, port=0, people=people, way=way, robot="ur10e"))
        return servers[-1]

    yield serve_
    for server in servers:
        server.stop()


def test_over_tls_of_its_own_cookies_go_over_tls_alone(serve, certified):
    server = serve(Way(certificate=certified[0], key=certified[1]).checked())
    assert server.address.startswith("https://127.0.0.1:")
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
    context.check_hostname, context.verify_mode = False, ssl.CERT_NONE
    asked = http.client.HTTPSConnection("127.0.0.1", server.port, context=context, timeout=20)
    asked.request("GET", "/login")
    answer = asked.getresponse()
    answer.read()
    asked.close()
    assert answer.status == 200 and "secure" in answer.headers["set-cookie"].lower()


def test_a_key_of_another_certificate_is_refused(certified, tmp_path):
    other = ec.generate_private_key(ec.SECP256R1()).private_bytes(
        serialization.Encoding.PEM, serialization.PrivateFormat.PKCS8, serialization.NoEncryption()
    )
    (tmp_path / "other.pem").write_bytes(other)
    with pytest.raises(Exception, match="no certificate with its key"):
        Way(certificate=certified[0], key=tmp_path / "other.pem").checked()


@pytest.mark.parametrize("proxy", [True, False])
def test_a_proxy_is_believed_only_where_one_is_said_to_be(serve, proxy):
    server = serve(Way(names=("class.school.example",), proxy=proxy))
    asked = http.client.HTTPConnection("127.0.0.1", server.port, timeout=20)
    head = {"Host": "class.school.example", "X-Forwarded-Proto": "https", "X-Forwarded-For": "10.9.8.7"}
    asked.request("GET", "/login", headers=head)
    answer = asked.getresponse()
    answer.read()
    asked.close()
    assert answer.status == 200 and ("secure" in answer.headers["set-cookie"].lower()) == proxy


def test_a_proxys_browsers_are_counted_one_by_one(serve):
    """Were all of them taken for the proxy, five wrong tries would turn a whole class away."""
    server = serve(Way(proxy=True))

    def wrong(address):
        asked = http.client.HTTPConnection("127.0.0.1", server.port, timeout=20)
        asked.request("GET", "/login", headers={"X-Forwarded-For": address})
        answer = asked.getresponse()
        token = answer.read().decode().partition('name="token" value="')[2].partition('"')[0]
        head = {
            "Cookie": answer.headers["set-cookie"].partition(";")[0],
            "Origin": f"http://127.0.0.1:{server.port}",
            "Content-Type": "application/x-www-form-urlencoded",
            "X-Forwarded-For": address,
        }
        asked.request("POST", "/login", f"token={token}&login=ada&secret=wrong", head)
        answer = asked.getresponse()
        answer.read()
        asked.close()
        return answer.status

    assert [wrong("10.0.0.1") for _ in range(6)] == [401] * 5 + [429]
    assert wrong("10.0.0.2") == 401


def test_under_a_prefix_everything_stands_below_it(tmp_path):
    hub = Hub(Store(tmp_path), robot="ur10e", linger=30.0)
    people = People(hub.store.database)
    people.add("ada", "Ada", "administrator", PASSWORD)
    app = Shell(hub, "127.0.0.1", people=people, prefix="/teachframe").app
    with TestClient(app, base_url=ADDRESS, follow_redirects=False) as client:
        assert client.get("/login").status_code == 404
        lost = client.get("/teachframe/nothing", headers={"accept": "text/html"})
        assert lost.status_code == 404 and 'href="/teachframe/"' in lost.text
        assert "content-security-policy" in lost.headers and "此地址" in lost.text
        assert client.get("/teachframe/nothing").text == "Not Found"  # no page for programs
        assert client.get("/teachframe/").headers["location"] == "/teachframe/login"
        page = client.get("/teachframe/login")
        assert (
            'href="/teachframe/static/forms.css"' in page.text and 'action="/teachframe/login"' in page.text
        )
        assert "path=/teachframe;" in page.headers["set-cookie"].lower()
        token = page.text.partition('name="token" value="')[2].partition('"')[0]
        said = {"token": token, "login": "ada", "secret": PASSWORD}
        answer = client.post("/teachframe/login", data=said, headers=ORIGIN)
        assert answer.status_code == 303 and answer.headers["location"] == "/teachframe/"
        pendant = client.get("/teachframe/")
        assert pendant.status_code == 200 and 'src="static/main.js"' in pendant.text
        for file in ("static/main.js", "static/forms.css", "account", "scene/", "state"):
            assert client.get(f"/teachframe/{file}").status_code == 200, file
        with client.websocket_connect(f"{SOCKET}/teachframe/words", headers=ORIGIN) as socket:
            assert socket.receive_text()
    hub.close()
