"""The look at advisories: a weakness fails, nobody who answers does not."""

import json
from importlib.machinery import SourceFileLoader
from importlib.util import module_from_spec, spec_from_loader
from pathlib import Path
from subprocess import CompletedProcess

import pytest

FOUND = {
    "dependencies": [
        {"name": "good", "version": "1.0", "vulns": []},
        {"name": "left-out", "skip_reason": "not on any index"},
        {"name": "bad", "version": "2.1", "vulns": [{"id": "PYSEC-2026-1", "fix_versions": ["2.2", "3.0"]}]},
    ]
}


@pytest.fixture
def audit(monkeypatch):
    """The script, with answers of the programs it calls: answers[word of the command] = (code, report)."""
    loader = SourceFileLoader("audit", str(Path(__file__).parents[1] / ".ci" / "audit"))
    module = module_from_spec(spec_from_loader("audit", loader))
    loader.exec_module(module)
    module.answers = {"check": (0, None), "install": (0, None), "pip_audit": (0, None)}

    def answer(command, **_):
        code, report = next((module.answers[w] for w in command if w in module.answers), (0, None))
        if report is not None:
            Path(command[command.index("-o") + 1]).write_text(json.dumps(report), encoding="utf-8")
        return CompletedProcess(command, code, stdout="good==1.0\nbad==2.1\n")

    monkeypatch.setattr(module.subprocess, "run", answer)
    monkeypatch.setattr(module.venv, "create", lambda *_, **__: None)
    return module


def test_a_known_weakness_fails_and_is_named(audit, capsys):
    audit.answers["pip_audit"] = (1, FOUND)
    assert audit.main() == 1
    assert capsys.readouterr().out == "audit: bad 2.1: PYSEC-2026-1, mended in 2.2, 3.0\n"


def test_packages_that_do_not_fit_together_fail(audit):
    audit.answers["check"] = (1, None)
    assert audit.main() == 1


def test_nothing_known_is_said(audit, capsys):
    audit.answers["pip_audit"] = (0, {"dependencies": FOUND["dependencies"][:2]})
    assert audit.main() == 0
    assert "no advisory names any of 2 packages" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("silent", "line"), [("install", "no registry gives pip-audit"), ("pip_audit", "osv.dev do not answer")]
)
def test_nobody_who_answers_is_said_and_is_no_failure(audit, capsys, silent, line):
    audit.answers[silent] = (1, None)
    assert audit.main() == 0
    said = capsys.readouterr()
    assert line in said.err and said.err.startswith("audit: not looked at") and not said.out
