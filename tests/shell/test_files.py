"""Files to and from the page."""

import pytest

from app.shell import files
from tests.desk import until
from tests.shell.conftest import ORIGIN

POINTS = """# kind: points
# angles: ZYX
role,x_mm,y_mm,z_mm,a_deg,b_deg,c_deg
touch,500,0,500,0,0,180
"""


def upload_of(page, label):
    return next(w["id"] for w in page.state()["widgets"] if w["kind"] == "upload" and w["label"] == label)


def send(page, widget, drop="abc", content=b"x", **asked):
    query = "&".join(f"{k}={v}" for k, v in {"name": "points.csv", "last": 1, **asked}.items())
    return page.client.put(f"/upload/{widget}/{drop}?{query}", content=content, headers=ORIGIN)


def test_a_points_file_is_read_and_what_is_wrong_in_it_is_said_by_name_and_row(page):
    widget = upload_of(page, "Load a points file")
    assert send(page, widget, content=POINTS.encode()).status_code == 204
    until(lambda: page.live.read().level == "warning", "the refusal")
    words = page.live.read().message
    assert "/" not in words.split(":")[0], words


def test_a_file_for_nobody_is_refused(page):
    assert send(page, 10**6).status_code == 404
    button = next(w["id"] for w in page.state()["widgets"] if w["kind"] == "button")
    assert send(page, button).status_code == 404
    assert send(page, upload_of(page, "Load a points file"), drop="..").status_code in (404, 405)


def test_too_much_is_refused_while_it_comes_and_nothing_of_it_is_left(page, monkeypatch, client):
    monkeypatch.setattr(files, "LARGEST", 1000)
    widget = upload_of(page, "Drop a recording and its URDF")
    assert send(page, widget, content=b"x" * 600, last=0).status_code == 204
    assert send(page, widget, content=b"x" * 600).status_code == 413


def test_a_download_is_fetched_once_and_never_shown_as_a_page(page):
    page.live.context.send("<script>.html", b"<script>alert(1)</script>")
    token = page.hear("file")["token"]
    answer = page.client.get(f"/download/{token}")
    assert answer.content == b"<script>alert(1)</script>"
    assert answer.headers["content-disposition"].startswith("attachment")
    assert "sandbox" in answer.headers["content-security-policy"]
    assert answer.headers["content-type"] == "application/octet-stream"
    assert page.client.get(f"/download/{token}").status_code == 404


@pytest.mark.parametrize(
    "path", ["/static/../server.py", "/static/%2e%2e/server.py", "/static/..%2fserver.py"]
)
def test_only_the_pages_own_files_are_given_out(client, path):
    assert client.get(path).status_code == 404
    assert client.get("/static/main.js").status_code == 200
