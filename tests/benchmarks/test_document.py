"""Sections of documents that commands write."""

import benchmarks.real_static as real_static
from benchmarks.__main__ import main
from benchmarks._document import markdown, replace_section


def test_a_section_replaces_itself_and_nothing_else(tmp_path):
    path = tmp_path / "docs" / "page.md"
    replace_section(path, "one", "first")
    replace_section(path, "two", "second")
    path.write_text("# Title\n\n" + path.read_text() + "\nafterword\n")
    replace_section(path, "one", "third")
    text = path.read_text()
    assert text.startswith("# Title\n") and text.endswith("afterword\n")
    assert "first" not in text and text.index("third") < text.index("second")
    assert text.count("<!-- one: begin -->") == text.count("<!-- one: end -->") == 1


def test_a_bar_in_a_cell_does_not_end_it():
    assert markdown(["a"], [["1|2"]]).splitlines()[2] == "| 1\\|2 |"


def test_what_follows_a_benchmark_with_a_command_is_its_own(monkeypatch):
    given = []
    monkeypatch.setattr(real_static, "command", lambda arguments: given.append(list(arguments)) or 0)
    assert main(["real_static", "run.csv", "--write"]) == 0
    assert given == [["run.csv", "--write"]]


def test_three_runs_are_learnt_alone_all_but_one_and_together():
    assert [len(s) for s in real_static.learning_sets(["a", "b", "c"])] == [1, 1, 1, 2, 2, 2, 3]
    assert real_static.learning_sets(["a", "b"]) == [("a",), ("b",)]
