"""The picture in app/__init__.py, held: every import points down, and third parties stay in their place."""

import ast
from pathlib import Path

from tests.source import parsed

APP = Path(__file__).parent.parent / "app"
DIAGNOSIS = APP / "diagnosis"

#: Highest first; a package may import itself and what stands below it.
LAYERS = [
    "__main__",
    "cli",
    "shell",
    "workers",
    "screens",
    "scene",
    "panel",
    "classroom",
    "people",
    "training",
    "session",
    "fleet",
    "proof",
    "simulation",
    "diagnosis",
    "calibration",
    "recordings",
    "kinematics",
    "estimation",
    "geometry",
    "catalog",
    "texts",
    "resources",
    "phrases",
    "files",
    "apart",
    "steps",
    "templating",
    "figures",
    "typed",
    "errors",
    "units",
    "__init__",
]

#: Third-party package -> the only layers that may import it.
CONFINED = {
    "viser": {"scene"},
    "starlette": {"shell"},
    "uvicorn": {"shell"},
    "websockets": {"shell", "scene"},
    "pinocchio": {"kinematics"},
    "coal": {"kinematics"},
    "trimesh": {"kinematics"},
    "xacrodoc": {"kinematics"},
    "h5py": {"recordings"},
    "tyro": {"cli"},
    "alembic": {"session"},
    "sqlalchemy": {"session", "training", "people", "classroom"},
    "argon2": {"people"},
    "authlib": {"shell"},
    "joserfc": {"shell"},
    "httpx": {"shell"},
    "rosbags": {"recordings"},
    "polars": {"recordings", "fleet"},
    "distributed": {"fleet"},
    "dask": {"fleet"},
}

#: The generator of sealed cases shares no code with the search it examines: only these may be seen from it.
PROOF_GENERATOR_SEES = {"errors", "files", "units", "catalog", "resources"}

#: Neither knows the other: the web server speaks to sessions, the scene is drawn by them.
STRANGERS = [("shell", "scene"), ("scene", "shell"), ("shell", "screens"), ("session", "panel")]

LONGEST_FILE = 300

#: Modules of the diagnosis from one that is asked down to one that imports none of them. What a file names for the type
#: checker alone is no step, nor what a function imports when it is called.
DEEPEST_IMPORT = 8


def _imports(path):
    for node in ast.walk(parsed(path)):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module and node.level == 0:
            yield node.module
            yield from (f"{node.module}.{alias.name}" for alias in node.names)


def _run_time_imports(path):
    """Modules imported when the file is: not inside functions, not for the type checker alone."""
    for node in parsed(path).body:
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module:
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


def test_strangers_do_not_import_each_other():
    wrong = []
    for path in _files():
        for module in _imports(path):
            for one, other in STRANGERS:
                if _layer(path) == one and module.split(".")[:2] == ["app", other]:
                    wrong.append(f"{path.relative_to(APP)} imports {module}")
    assert not wrong, wrong


def test_no_file_imports_itself_in_a_circle():
    edges = {}
    names = {p: ".".join(p.relative_to(APP.parent).with_suffix("").parts) for p in _files()}
    known = set(names.values())
    for path, name in names.items():
        edges[name] = {m for m in _run_time_imports(path) if m in known and m != name}
    for start in sorted(edges):
        seen, todo = set(), list(edges[start])
        while todo:
            at = todo.pop()
            assert at != start, f"{start} imports itself in a circle"
            if at not in seen:
                seen.add(at)
                todo.extend(edges[at])


def test_no_chain_of_imports_in_the_diagnosis_is_long():
    files = {".".join(p.relative_to(APP.parent).with_suffix("").parts): p for p in DIAGNOSIS.rglob("*.py")}
    # a package's own file is called by the package's name
    files = {name.removesuffix(".__init__"): path for name, path in files.items()}
    chains = {}

    def chain(name):
        if name not in chains:
            below = {m for m in _run_time_imports(files[name]) if m in files and m != name}
            # from package import member: the member is what is needed
            below -= {m for m in below if any(other.startswith(f"{m}.") for other in below)}
            chains[name] = (*max((chain(m) for m in sorted(below)), key=len, default=()), name)
        return chains[name]

    longest = max(map(chain, files), key=len)
    assert len(longest) <= DEEPEST_IMPORT, longest


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
        for node in ast.walk(parsed(path)):
            assert not (isinstance(node, ast.ImportFrom) and node.level), path


def test_conversion_factors_live_in_units_only():
    for path in _files():
        if path.name == "units.py":
            continue
        for node in ast.walk(parsed(path)):
            if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Mult | ast.Div):
                for side in (node.left, node.right):
                    value = side.value if isinstance(side, ast.Constant) else None
                    assert value not in (1000, 1000.0, 180, 180.0, 0.001), f"{path}:{node.lineno}"


def test_no_file_is_longer_than_one_idea():
    long = [
        f"{p}: {n}" for p in _files() if (n := len(p.read_text(encoding="utf-8").splitlines())) > LONGEST_FILE
    ]
    assert not long, long


#: Where a word that is an effect's key stands for something else: file below app/diagnosis, word -> what it is there.
OTHERWISE = {
    ("result.py", "unnamed"): "a family of the error budget",
    ("observations/pose_data.py", "payload"): "an array with one value a row",
    ("observations/pose_reading.py", "payload"): "a column of a recording",
    ("observations/conventions.py", "delay"): "the number by which a clock is late",
    ("export/targets/_words.py", "delay"): "a word of the remark at the top of a file",
    ("export/targets/mjcf.py", "delay"): "an attribute of MuJoCo's motor",
}
EFFECTS = DIAGNOSIS / "effects"


def _keys():
    from app.diagnosis import effects

    return {key for kind in effects.FOLDERS for key in effects.of_kind(kind)}


def _said_in(tree, keys):
    """Effects whose key stands as a text in a syntax tree, docstrings not counted."""
    docstrings = {
        id(node.body[0].value)
        for node in ast.walk(tree)
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef)
        and node.body
        and isinstance(node.body[0], ast.Expr)
    }
    return {
        node.value
        for node in ast.walk(tree)
        if isinstance(node, ast.Constant)
        and isinstance(node.value, str)
        and node.value in keys
        and id(node) not in docstrings
    }


def _effect_modules(path, keys):
    """Files of single effects that a file imports; what effects have in common begins with an underscore."""
    return {
        module
        for module in _imports(path)
        if module.startswith("app.diagnosis.effects.") and set(module.split(".")[4:]) & keys
    }


def test_no_effect_is_known_by_name_outside_its_own_file():
    keys = _keys()
    files = [p for p in DIAGNOSIS.rglob("*.py") if EFFECTS not in p.parents]
    said = {(p.relative_to(DIAGNOSIS).as_posix(), key) for p in files for key in _said_in(parsed(p), keys)}
    assert said == set(OTHERWISE)  # an exception that is none any longer goes, too
    assert not {p.name: found for p in files if (found := _effect_modules(p, keys))}


def test_effects_on_poses_do_not_know_each_other():
    keys = _keys()
    for path in (EFFECTS / "kinematic").glob("*.py"):
        assert _said_in(parsed(path), keys) - {"unnamed"} <= {path.stem}, path  # a family of the budget


def test_a_key_that_is_planted_is_seen():
    planted = 'def asks(law):\n    "payload"\n    return law.key in ("joint_zero", "friction")'
    assert _said_in(ast.parse(planted), _keys()) == {"joint_zero"}
