"""What every command keeps to: help, exit codes, one line for bad input, results apart from progress."""

import subprocess
import sys

import pytest

from app import catalog
from tests.cli.running import assert_one_line, teachframe

COMMANDS = [name.replace("_", "-") for name in catalog.module_names("app.cli.commands")]


@pytest.mark.parametrize("name", COMMANDS)
def test_every_command_has_help_and_exits_0(name):
    said = teachframe(name, "--help")
    assert said.code == 0
    assert said.out.startswith(f"usage: teachframe {name}")
    assert said.err == ""


@pytest.mark.parametrize("name", COMMANDS)
def test_an_option_that_does_not_exist_is_one_line_and_exit_2(name):
    assert_one_line(teachframe(name, "--no-such-option"), f"teachframe {name}", "--help")


def test_the_overview_names_every_command_with_what_it_does():
    said = teachframe("--help")
    assert said.code == 0
    for name in COMMANDS:
        line = next(line for line in said.out.splitlines() if line.split()[:1] == [name])
        assert len(line.split()) > 3, line


def test_a_command_that_does_not_exist_lists_those_that_do():
    assert_one_line(teachframe("diagnoze"), "diagnoze", "diagnose")


def test_no_command_at_all_shows_the_overview_and_exits_2():
    said = teachframe()
    assert said.code == 2 and "diagnose" in said.out


def test_the_version_is_said():
    from app import __version__

    assert teachframe("--version").out == f"teachframe {__version__}\n"


def test_an_internal_fault_exits_1_with_one_line_and_no_trace(monkeypatch):
    from app.cli.commands import robots

    def fail(self):
        raise ZeroDivisionError("a fault\nof this program")

    monkeypatch.delenv("TEACHFRAME_DEBUG", raising=False)
    monkeypatch.setattr(robots.Command, "run", fail)
    said = teachframe("robots")
    assert said.code == 1 and said.out == ""
    assert said.err.count("\n") == 1 and "internal fault" in said.err and "ZeroDivisionError" in said.err


def test_an_interrupt_exits_130(monkeypatch):
    from app.cli.commands import robots

    def stop(self):
        raise KeyboardInterrupt

    monkeypatch.setattr(robots.Command, "run", stop)
    assert teachframe("robots").code == 130


def test_python_m_app_is_the_same_command():
    def ran(*argv):
        done = subprocess.run([*argv, "--help"], capture_output=True, text=True, check=False)
        return done.returncode, done.stdout, done.stderr

    module = ran(sys.executable, "-m", "app")
    script = ran(sys.executable, "-c", "from app.__main__ import main; main()")
    assert module == script
    assert module[0] == 0 and "diagnose" in module[1]


def test_the_installed_script_is_the_same_entry_point():
    from importlib.metadata import entry_points

    scripts = [e for e in entry_points(group="console_scripts") if e.name == "teachframe"]
    assert [e.value for e in scripts] == ["app.__main__:main"]


def test_help_does_not_wait_for_heavy_packages():
    """A person who asks for help waits for nothing: no numpy, no pin, no viser is read."""
    code = (
        "import sys; from app.cli import run; run(['diagnose', '--help']); "
        "print(','.join(m for m in ('pinocchio', 'viser', 'polars', 'scipy') if m in sys.modules), file=sys.stderr)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stderr.strip() == ""


def test_a_closed_pipe_is_no_fault():
    code = "import sys; from app.cli import run; sys.exit(run(['robots']))"
    done = subprocess.run(
        f'{sys.executable} -c "{code}" | head -c 1 >/dev/null; echo ${{PIPESTATUS[0]}}',
        shell=True,
        executable="/bin/bash",
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stdout.strip() == "0" and "Traceback" not in done.stderr
