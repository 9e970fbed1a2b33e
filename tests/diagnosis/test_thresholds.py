"""Numbers that decide stand in app/diagnosis/thresholds, each with its reason; what stands elsewhere is listed here."""

import ast
from pathlib import Path

from tests.source import parsed

DIAGNOSIS = Path(__file__).parents[2] / "app" / "diagnosis"
#: Pictures, pages and other programs' formats; nominal sizes of an effect belong to its own file.
ASIDE = {"report", "export", "effects", "thresholds"}

#: Numbers of the engine that decide no finding: why -> file -> names.
STAY = {
    "how long a solver goes on, and where it is sure of its digits": {
        "dynamic/conventions.py": {"ROUNDS"},
        "dynamic/crossed.py": {"JITTER"},
        "dynamic/fitting.py": {"ROUNDS", "SETTLED", "SETTLING"},
        "dynamic/shapes.py": {"STEP"},
        "dynamic/solution.py": {"RENEWALS"},
        "dynamic/study.py": {"RIDGE", "ROUNDS"},
        "kinematic/budget.py": {"_NONE"},
        "kinematic/describe.py": {"_LEFT", "_REFITS", "_ROUNDS", "_STILL"},
        "kinematic/elsewhere.py": {"_ROUNDS"},
        "kinematic/hypotheses.py": {"_STEPS"},
        "kinematic/moved_base.py": {"_STEPS", "_TRIED"},
        "models/dynamic/commands.py": {"ITERATIONS"},
        "models/dynamic/resonance.py": {"AROUND", "GOES_ON", "RATIOS"},
        "models/dynamic/two_mass.py": {"_CREEPING", "_SLOW"},
        "models/kinematic/geometry.py": {"_CROSSING", "_PARALLEL"},
        "models/kinematic/library.py": {"_ALIKE"},
        "models/kinematic/nuisance.py": {"_ALTERNATIONS", "_NEAR", "_TOLD"},
        "models/kinematic/rows.py": {"_FAR", "_FINEST"},
        "models/kinematic/situation.py": {"MOVED", "ROUNDING"},
        "models/kinematic/state.py": {"_DAMPING", "_SETTLED"},
        "regression/design.py": {"_DEPENDENT", "_ROUNDING"},
        "regression/inside.py": {"CHANGES", "ROUNDING"},
        "regression/instead.py": {"SLACK"},
    },
    "how much is looked at: more of it takes longer and says the same": {
        "dynamic/event_rows.py": {"ROWS"},
        "dynamic/events.py": {"STRIDE"},
        "dynamic/swelling.py": {"SWELLS", "TRIALS"},
        "dynamic/pieces.py": {"PIECES"},
        "dynamic/gains.py": {"ENOUGH"},
        "dynamic/loads.py": {"SHOWN", "TRIED"},
        "models/dynamic/repeats.py": {"STRETCHES"},
        "dynamic/ready.py": {"POSES"},
        "dynamic/saving.py": {"POSES", "STILL"},
        "dynamic/solution.py": {"BLOCKS", "FOLDS"},
        "kinematic/findings.py": {"_MOST_RIVALS"},
        "kinematic/regions.py": {"_HALVINGS"},
        "kinematic/hypotheses.py": {"_SHORT_LIST"},
        "models/dynamic/both_sides.py": {"FOLDS", "STRETCHES", "TURNS"},
        "models/dynamic/commands.py": {"STRETCHES"},
        "models/dynamic/every_sample.py": {"_AT_ONCE", "_SLOW", "_TURNED"},
        "models/dynamic/filters.py": {"_TOGETHER"},
        "models/dynamic/resonance.py": {"LOOSE", "SPACING", "STRETCH"},
        "models/dynamic/samples.py": {"ENOUGH", "KEPT", "LONGEST", "MOST"},
        "models/dynamic/smoothing.py": {"COMPARED", "PROBED"},
        "models/kinematic/saved.py": {"_POSES", "_STILL"},
        "observations/thinning.py": {
            "MOST_ROWS", "MOST_SAMPLES", "MOST_SESSIONS", "MOST_TARGETS", "STRETCH", "_MANY",
        },
        "regression/evidence.py": {"KEPT"},
        "regression/heldout.py": {"FOLDS"},
        "regression/weighing.py": {"FEW_WIDTHS"},
        "regression/nulls.py": {"_AT_ONCE"},
        "selection/change_points.py": {"_AT_ONCE", "_OFF", "_PAID_ALIKE"},
    },
    "how far a diagnosis is told to be while it goes on": {
        "dispatch.py": {"_AS_LONG"},
        "dynamic/fitting.py": {"_BEGUN", "_ROUND", "_SELECTED", "_SOLVED"},
        "models/dynamic/smoothing.py": {"_CHOOSING", "_PART_LEFT"},
    },
    "filters and processes by which a log is smoothed and its noise described": {
        "models/dynamic/filters.py": {
            "DEGREE", "HALF_WIDTHS", "_ALONG", "_BEFORE", "_JITTER", "_PROBE", "_QUIET", "_QUIET_VARIANCE",
            "_SIXTH",
        },
        "models/dynamic/noise.py": {"PIECES", "SKIPPED", "_FADED", "_RHO", "_THETA"},
        "models/dynamic/smoothing.py": {"BETTER", "LONGEST", "WORSE"},
        "models/kinematic/rows.py": {"_MEDIAN"},
        "observations/noise.py": {"_SQRT12"},
    },
    "what stands for a description that says nothing, and the smallest thing that one may say": {
        "models/dynamic/samples.py": {"LIGHTEST_LINK", "SMALLEST_LINK", "SMALLEST_SIZE"},
        "models/kinematic/cell.py": {"_STRAIGHT"},
        "models/kinematic/gravity.py": {"LUMPED_KG_PER_M"},
    },
    "advice on what to record next": {
        "dynamic/next_motion.py": {"APART", "COUNT", "SPEEDS"},
        "kinematic/next_poses.py": {"COUNT", "_APART", "_DRAWN", "_FLOOR", "_MARGIN"},
    },
    "names and units of conventions": {
        "observations/conventions.py": {
            "ANGLE_UNIT", "DELAY", "HORIZON", "INVERSE", "LATE", "LENGTH_UNIT", "MIRROR", "QUARTER", "SIGN", "SWAP",
            "_LENGTH_FACTORS", "_MIRROR", "_ROWS_APART",
        },
    },
    "bounds of a file that is read": {
        "model.py": {"LARGEST_FILE"},
        "model_checks.py": {"LARGEST", "LONGEST_TEXT", "MOST_EFFECTS", "MOST_NUMBERS", "MOST_PARAMETERS"},
    },
}  # fmt: skip


def _assigned(node):
    """Names and value of a module's own assignment."""
    if isinstance(node, ast.Assign):
        return {n.id for t in node.targets for n in ast.walk(t) if isinstance(n, ast.Name)}, node.value
    if isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name) and node.value is not None:
        return {node.target.id}, node.value
    return set(), None


def _holds_a_number(value):
    return any(
        isinstance(n, ast.Constant) and isinstance(n.value, int | float) and not isinstance(n.value, bool)
        for n in ast.walk(value)
    )


def _numbers(path):
    out = set()
    for node in parsed(path).body:
        names, value = _assigned(node)
        if value is not None and _holds_a_number(value):
            out |= names
    return out


def test_numbers_outside_thresholds_are_those_that_decide_nothing():
    found = {}
    for path in sorted(DIAGNOSIS.rglob("*.py")):
        if path.relative_to(DIAGNOSIS).parts[0] not in ASIDE and (numbers := _numbers(path)):
            found[path.relative_to(DIAGNOSIS).as_posix()] = numbers
    listed = {}
    for files in STAY.values():
        for file, names in files.items():
            listed.setdefault(file, set()).update(names)
    assert found == listed


def test_every_threshold_says_why():
    silent = []
    for path in sorted((DIAGNOSIS / "thresholds").glob("*.py")):
        lines = path.read_text(encoding="utf-8").splitlines()
        for node in ast.parse("\n".join(lines)).body:
            names, value = _assigned(node)
            if value is None:
                continue
            above = node.lineno - 1
            while lines[above - 1].startswith("#:"):
                above -= 1
            reason = " ".join(line.removeprefix("#:").strip() for line in lines[above : node.lineno - 1])
            if len(reason) < 20 or not reason.endswith("."):
                silent.append(f"{path.name}: {sorted(names)}")
    assert not silent, silent
