"""What holds for every wizard mode, also for those that are added later."""

import numpy as np
import pytest

from app.calibration.captures import ROLES
from app.calibration.modes import mode, modes
from app.errors import DegenerateGeometryError, InputError, UnknownNameError
from app.geometry import angle_between

EXACT = 1e-8
NOISE = 1e-4
#: A plate tells least; nothing is off by more than this many times the noise.
WORST = 40.0
TAUGHT = [key for key, m in modes().items() if m.most_touches > 0]


def test_the_modes_of_the_makers_are_there():
    assert set(modes()) >= {
        "touch", "touch_z", "touch_zx", "touch_xy", "touch_many", "six_point_xz", "six_point_xy",
        "abc_two_point", "abc_world", "direct", "reference", "plane", "spin",
    }  # fmt: skip


@pytest.mark.parametrize("key", modes())
def test_a_mode_is_found_by_its_key_and_its_steps_are_complete(key):
    found = mode(key)
    assert found.key == key and found.title
    for count in range(found.least_touches, min(found.most_touches, 9) + 1):
        steps = found.steps(count)
        assert len({s.key for s in steps}) == len(steps)
        for step in steps:
            assert step.title and step.instruction.endswith((".", ";")) and step.picture
            assert set(step.roles) <= set(ROLES)


@pytest.mark.parametrize("key", modes())
@pytest.mark.parametrize("seed", range(3))
def test_the_demonstration_without_noise_gives_the_true_tool_frame(key, seed):
    found = mode(key)
    demo = found.demo(touches=found.default_touches, seed=seed)
    assert [c.step_key for c in demo.captures] == [s.key for s in found.steps(found.default_touches)]
    result = found.solve(demo.captures, **demo.options)
    np.testing.assert_allclose(result.T_flange_tool.matrix, demo.T_flange_tool.matrix, atol=EXACT)
    assert result.rms < EXACT and not [w for w in result.warnings if w.severe]


@pytest.mark.parametrize("key", TAUGHT)
def test_noise_moves_the_result_no_further_than_predicted(key):
    found = mode(key)
    distances = []
    for seed in range(40):
        demo = found.demo(touches=found.default_touches, noise=NOISE, seed=seed)
        result = found.solve(demo.captures, **demo.options)
        off = result.tool_point - demo.T_flange_tool.position
        distances.append(off @ np.linalg.solve(result.covariance, off) / 3.0)
        assert np.linalg.norm(off) < WORST * NOISE
        turned = angle_between(result.T_flange_tool.rotation, demo.T_flange_tool.rotation)
        assert turned < WORST * NOISE / 0.1
    assert 0.2 < np.median(distances) < 3.0


@pytest.mark.parametrize("key", TAUGHT)
def test_captures_that_are_missing_are_named_and_never_crash(key):
    found = mode(key)
    demo = found.demo(touches=found.least_touches)
    for left_out in range(len(demo.captures)):
        rest = [c for i, c in enumerate(demo.captures) if i != left_out]
        try:
            found.solve(rest, **demo.options)
        except (DegenerateGeometryError, InputError) as error:
            assert "\n" not in str(error)
    with pytest.raises((DegenerateGeometryError, InputError)):
        found.solve([], **demo.options)


def test_an_unknown_mode_lists_those_there_are():
    with pytest.raises(UnknownNameError, match="touch_zx"):
        mode("touch_xz")


def test_direct_entry_reads_every_convention_and_refuses_what_is_no_number():
    direct = mode("direct")
    half = np.sqrt(0.5)
    result = direct.solve(
        (), position=(0.1, 0, 0.2), angles=(half, 0, 0, half), angle_convention="quaternion"
    )
    np.testing.assert_allclose(result.T_flange_tool.rotation @ [1, 0, 0], [0, 1, 0], atol=EXACT)
    for bad in (
        {"position": (1, 2)},
        {"angles": (0, np.nan, 0)},
        {"angles": (0,) * 4, "angle_convention": "quaternion"},
    ):
        with pytest.raises(InputError):
            direct.solve((), **bad)


def test_the_reference_mode_asks_for_the_known_tool():
    found = mode("reference")
    with pytest.raises(InputError, match="known_tool"):
        found.solve(found.demo().captures)


def test_a_plate_touched_with_little_tilt_is_refused_or_admits_it():
    found = mode("plane")
    demo = found.demo(touches=9)
    flat = [demo.captures[0]] * 9
    with pytest.raises(DegenerateGeometryError):
        found.solve(flat)
