"""ABB's words (FlexPendant, tool frame definition)."""

from app.calibration.vocabularies._vocabulary import Vocabulary, Words

VOCABULARY = Vocabulary(
    "abb",
    "ABB",
    "quaternion",
    ("q1", "q2", "q3", "q4"),
    {
        "en": Words(
            {"touch": "TCP (default orient.)", "touch_z": "TCP & Z", "touch_zx": "TCP & Z, X"},
            {
                "touch": "Point {n}",
                "touch+origin": "Point {n}",
                "x": "Elongator Point X",
                "z": "Elongator Point Z",
            },
            "Mean error",
            "Max error",
        ),
        "zh": Words(
            {"touch": "TCP（默认方向）", "touch_z": "TCP 和 Z", "touch_zx": "TCP 和 Z, X"},
            {"touch": "点 {n}", "touch+origin": "点 {n}", "x": "延伸器点 X", "z": "延伸器点 Z"},
            "平均误差",
            "最大误差",
        ),
    },
)
