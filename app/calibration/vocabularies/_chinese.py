"""What the operator does at each step, in Chinese, and the names of modes and steps that no maker has words for."""

from __future__ import annotations

INSTRUCTIONS: dict[str, str] = {
    "first_touch": "将工具尖端对准固定尖点，然后记录。",
    "touch": "绕另一根轴将工具转动 45 度以上，再次对准同一尖点，然后记录。",
    "touch+origin": "绕另一根轴将工具转动 45 度以上，对准同一尖点并记录；后续移动从此处开始。",
    "origin": "将工具摆成要示教的姿态，尖端对准尖点，然后记录。",
    "x": "保持工具姿态不变，沿工具 +X 方向移动 100 毫米以上，然后记录。",
    "y": "保持工具姿态不变，沿工具 +Y 方向移动 100 毫米以上，然后记录。",
    "z": "保持工具姿态不变，沿工具 +Z 方向移动 100 毫米以上，然后记录。",
    "known": "安装并选择已知工具，将其尖端对准固定尖点，然后记录。",
    "plane": "换一个方向倾斜工具，轮流接近竖直与大幅倾斜，尖端接触平板上任意一点，然后记录。",
    "spin": "保持工具轴线不动，绕该轴线转动工具 60 度以上，然后记录。",
    "minus_x": "将工具 -X 轴上的一点对准同一尖点，然后记录。",
    "xy": "将工具 XY 平面上 +Y 一侧的一点对准同一尖点，然后记录。",
    "world": "使工具 X 轴朝下，Y 轴平行于基座 +Y，Z 轴平行于基座 +X，然后记录。",
}

#: Mode key -> its own name.
MODES: dict[str, str] = {
    "touch": "工具点（N 次接触）",
    "touch_many": "工具点（任意次接触）",
    "touch_z": "工具点与 Z",
    "touch_zx": "工具点与 Z/X",
    "touch_xy": "工具点与 X/Y",
    "six_point_xz": "六点法（X 与 Z）",
    "six_point_xy": "六点法（X 与 Y）",
    "abc_two_point": "工具点，再用 -X 上一点和 XY 平面上一点",
    "abc_world": "工具点，再使工具平行于基座",
    "direct": "直接输入",
    "plane": "接触平板",
    "reference": "以已知工具为参照",
    "spin": "工具点，再绕工具轴自转求 Z",
}

#: Role -> title of a step; `{n}` is its number among its kind.
STEPS: dict[str, str] = {
    "touch": "接触点 {n}",
    "touch+origin": "接触点 {n}（起点）",
    "origin": "姿态原点",
    "x": "+X 方向",
    "y": "+Y 方向",
    "z": "+Z 方向",
    "known": "已知工具",
    "plane": "平板点 {n}",
    "spin": "自转 {n}",
    "minus_x": "-X 上的点",
    "xy": "XY 平面上的点",
    "world": "平行于基座",
}
