"""Accounts at the command line: secrets come on stdin, mistakes get one line and exit code 2."""

import io
import json
import zipfile

import pytest

from app.cli import run
from app.people import People
from app.session import Store
from tests.people.conftest import PASSWORD, PIN


@pytest.fixture
def cli(tmp_path, monkeypatch, capsys):
    """Runs a command line with a line on stdin: (exit code, stdout, stderr)."""

    def run_(*words, said=""):
        monkeypatch.setattr("sys.stdin", io.StringIO(said + "\n" if said else ""))
        code = run([*words, "--data", str(tmp_path / "data")])
        return code, *capsys.readouterr()

    return run_


@pytest.fixture
def people(tmp_path):
    return People(Store(tmp_path / "data").database)


@pytest.fixture
def staffed(cli):
    assert cli("people", "add", "ada", "--role", "administrator", said=PASSWORD)[0] == 0
    assert cli("people", "add", "tom", "--name", "Tom", "--role", "trainer", said=PASSWORD)[0] == 0
    assert cli("class", "make", "Monday", "--trainer", "tom")[0] == 0


def test_a_school_is_set_up_changed_and_read(cli, staffed, people):
    (at,) = people.classes.list()
    li = people.join(at.code, "Li Wei", PIN, "here")
    assert f"Monday  {at.code}  tom      1" in cli("class", "list")[1]
    assert "Li Wei" in cli("class", "members", at.code)[1]
    assert cli("class", "change", "Monday", "--new-code", "--trainer", "ada", "--name", "Friday")[0] == 0
    (now,) = people.classes.list()
    assert now.code != at.code and now.name == "Friday" and now.trainer == people.find("ada").id
    assert cli("people", "reset", li.login, "--pin", said="739105")[0] == 0
    assert people.authenticate(li.login, "739105", "here")
    assert cli("people", "role", "tom", "administrator")[0] == 0
    assert cli("people", "remove", "ada")[0] == 0 and people.find("ada").disabled
    assert cli("class", "members", "Friday", "--dismiss", li.login)[1] == "nobody yet\n"
    assert cli("class", "delete", "Friday")[0] == 0 and not people.classes.list()
    deeds = [json.loads(line)["deed"] for line in cli("audit", "--json")[1].splitlines()]
    assert deeds[0] == "add" and {"class_make", "class_delete", "change_role", "change_disabled"} <= set(
        deeds
    )


def test_everything_kept_is_written_and_erased(cli, staffed, people, tmp_path, monkeypatch):
    monkeypatch.setattr("app.cli.accounts.people_erase._CLOSED", 0.0)
    out, li = tmp_path / "li.zip", people.join(people.classes.list()[0].code, "Li Wei", PIN, "here")
    assert cli("people", "export", li.login, "--out", str(out))[0] == 0
    assert li.login in zipfile.ZipFile(out).read("people.jsonl").decode()
    assert cli("people", "erase", li.login)[0] == 2 and people.get(li.id)
    assert cli("people", "erase", li.login, "--sure")[0] == 0 and people.get(li.id) is None
    assert li.id in cli("audit")[1] and "li wei" not in cli("audit")[1]


@pytest.mark.parametrize(
    "words, said, line",
    [
        (("people", "add", "x"), "", "no password came on stdin"),
        (("people", "add", "x"), "short", "A password has 10 to 200 characters"),
        (("people", "add", "ada"), PASSWORD, "The log-in name ada is taken."),
        (("people", "add", "a b"), PASSWORD, "A log-in name has"),
        (("people", "add", "x", "--role", "king"), PASSWORD, "invalid"),
        (("people", "role", "nobody", "trainer"), "", "Nobody here is called nobody."),
        (("people", "role", "ada", "trainee"), "", "This is the last administrator"),
        (("people", "role", "tom", "trainee"), "", "This trainer has classes"),
        (("people", "remove", "ada"), "", "This is the last administrator"),
        (("people", "reset", "tom", "--pin"), "123456", "A PIN has 6 to 12 digits"),
        (("people", "export", "tom", "--out", "/nowhere/x.zip"), "", "/nowhere"),
        (("people",), "", "misplaced options: --data"),
        (("class", "make", "A", "--trainer", "nobody"), "", "Nobody here is called nobody."),
        (("class", "make", "  ", "--trainer", "tom"), "", "A name has"),
        (("class", "delete", "Tuesday"), "", "No one class is meant by Tuesday; there are: Monday"),
        (("audit", "--most", "0"), "", "expected 1 or more"),
    ],
)
def test_what_cannot_be_gets_one_line(cli, staffed, words, said, line):
    code, out, err = cli(*words, said=said)
    assert code == 2 and not out and err.count("\n") == 1 and line.lower() in err.lower()


def test_the_first_account_is_an_administrators(cli, people):
    assert cli("people", "add", "tom", "--role", "trainer", said=PASSWORD)[0] == 2
    assert not people.any()


def test_a_trainee_gets_no_class(cli, staffed, people):
    people.add("eve", "Eve", "trainee", PASSWORD)
    assert "eve is neither trainer nor administrator" in cli("class", "make", "B", "--trainer", "eve")[2]


@pytest.mark.parametrize(
    "words",
    [
        ("--host", "0.0.0.0"),
        ("--host", "::"),
        ("--host", "10.0.0.7"),
        ("--host", "myhost"),
        ("--proxy-headers",),
        ("--name", "class.example.org"),
    ],
)
def test_no_other_machine_is_let_in_without_accounts(cli, words):
    code, _, err = cli("serve", *words)
    assert code == 2 and err.count("\n") == 1 and "teachframe people add NAME --role administrator" in err


@pytest.mark.parametrize(
    "words, line",
    [
        (("--tls-cert", "/nowhere.pem"), "a certificate and its key belong together"),
        (("--tls-cert", "/nowhere.pem", "--tls-key", "/nowhere.key"), "no certificate with its key"),
        (("--prefix", "teach frame"), "is no path"),
        (("--name", "http://x"), "is no host name"),
    ],
)
def test_a_way_that_cannot_be_is_refused(cli, words, line):
    code, _, err = cli("serve", *words)
    assert code == 2 and err.count("\n") == 1 and line in err
