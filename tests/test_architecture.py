"""The picture in app/__init__.py, held: every import points down, and third parties stay in their place."""

import ast
from pathlib import Path

APP = Path(__file__).parent.parent / "app"

#: Highest first; a package may import itself and what stands below it.
LAYERS = [
    "__main__",
    "cli",
    "pendant",
    "training",
    "session",
    "proof",
    "simulation",
    "diagnosis",
    "calibration",
    "recordings",
    "kinematics",
    "estimation",
    "geometry",
    "catalog",
    "resources",
    "phrases",
    "errors",
    "units",
    "__init__",
]

#: Third-party package -> the only layers that may import it.
CONFINED = {
    "viser": {"pendant"},
    "pinocchio": {"kinematics"},
    "coal": {"kinematics"},
    "tyro": {"cli"},
    "sqlalchemy": {"session", "training"},
    "rosbags": {"recordings"},
    "polars": {"recordings"},
}

#: The generator of sealed cases shares no code with the search it examines: only these may be seen from it.
PROOF_GENERATOR_SEES = {"errors", "units", "catalog", "resources"}

LONGEST_FILE = 300


def _imports(path):
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module and node.level == 0:
            yield node.module
            yield from (f"{node.module}.{alias.name}" for alias in node.names)


def _layer(path):
    part = path.relative_to(APP).parts[0]
    return part.removesuffix(".py")


def _files():
    return [p for p in sorted(APP.rglob("*.py")) if "_shipped" not in p.parts]


def test_every_file_belongs_to_a_layer():
    assert {_layer(p) for p in _files()} <= set(LAYERS)


def test_every_import_points_down():
    rank = {name: i for i, name in enumerate(LAYERS)}
    wrong = []
    for path in _files():
        for module in _imports(path):
            parts = module.split(".")
            if (
                parts[0] == "app"
                and len(parts) > 1
                and parts[1] in rank
                and rank[parts[1]] < rank[_layer(path)]
            ):
                wrong.append(f"{path.relative_to(APP)} imports {module}")
    assert not wrong, wrong


def test_third_parties_stay_in_their_place():
    wrong = []
    for path in _files():
        for module in _imports(path):
            allowed = CONFINED.get(module.partition(".")[0])
            if allowed is not None and _layer(path) not in allowed:
                wrong.append(f"{path.relative_to(APP)} imports {module}")
    assert not wrong, wrong


def test_the_proof_generator_shares_no_code_with_the_search():
    generator = APP / "proof" / "generator"
    wrong = []
    for path in sorted(generator.rglob("*.py")):
        for module in _imports(path):
            parts = module.split(".")
            own = parts[:3] == ["app", "proof", "generator"]
            if parts[0] == "app" and len(parts) > 1 and not own and parts[1] not in PROOF_GENERATOR_SEES:
                wrong.append(f"{path.relative_to(APP)} imports {module}")
    assert not wrong, wrong


def test_no_relative_imports_hide_an_arrow():
    for path in _files():
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            assert not (isinstance(node, ast.ImportFrom) and node.level), path


def test_conversion_factors_live_in_units_only():
    for path in _files():
        if path.name == "units.py":
            continue
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Mult | ast.Div):
                for side in (node.left, node.right):
                    value = side.value if isinstance(side, ast.Constant) else None
                    assert value not in (1000, 1000.0, 180, 180.0, 0.001), f"{path}:{node.lineno}"


def test_no_file_is_longer_than_one_idea():
    long = [
        f"{p}: {n}" for p in _files() if (n := len(p.read_text(encoding="utf-8").splitlines())) > LONGEST_FILE
    ]
    assert not long, long
