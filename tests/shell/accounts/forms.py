"""Forms as a browser sends them: with the token of the page that shows them."""

from tests.shell.conftest import ORIGIN


def token(client, path="/login"):
    page = client.get(path).text
    return page.partition('name="token" value="')[2].partition('"')[0]


def come(client, path, **fields):
    return client.post(path, data={"token": token(client, path), **fields}, headers=ORIGIN)


def do(client, path, **fields):
    return client.post(path, data={"token": token(client, "/account"), **fields}, headers=ORIGIN)
