"""FANUC's words (iPendant, tool frame setup)."""

from app.calibration.vocabularies._vocabulary import Vocabulary, Words

_STEPS = {
    "touch": "Approach point {n}",
    "touch+origin": "Approach point {n}",
    "origin": "Orient Origin Point",
    "x": "X Direction Point",
    "y": "Y Direction Point",
    "z": "Z Direction Point",
}
_CHINESE_STEPS = {
    "touch": "接近点 {n}",
    "touch+origin": "接近点 {n}",
    "origin": "坐标原点",
    "x": "X 方向点",
    "y": "Y 方向点",
    "z": "Z 方向点",
}

VOCABULARY = Vocabulary(
    "fanuc",
    "FANUC",
    "XYZ",
    ("W", "P", "R"),
    {
        "en": Words(
            {
                "touch": "Three Point",
                "six_point_xz": "Six Point (XZ)",
                "six_point_xy": "Six Point (XY)",
                "direct": "Direct Entry",
            },
            _STEPS,
            "Mean error",
            "Maximum error",
        ),
        "zh": Words(
            {
                "touch": "三点法",
                "six_point_xz": "六点法 (XZ)",
                "six_point_xy": "六点法 (XY)",
                "direct": "直接输入法",
            },
            _CHINESE_STEPS,
            "平均误差",
            "最大误差",
        ),
    },
)
