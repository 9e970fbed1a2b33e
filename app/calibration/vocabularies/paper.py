"""The paper's own words (Xiong, Ye, Jiang 2012)."""

from app.calibration.vocabularies._vocabulary import Vocabulary, Words

VOCABULARY = Vocabulary(
    "paper",
    "Xiong 2012",
    "ZYX",
    ("A", "B", "C"),
    {
        "en": Words(
            {
                "touch": "TCP position, default direction",
                "touch_z": "TCP position and Z direction",
                "touch_zx": "TCP position and Z/X direction",
            },
            {
                "touch": "Calibration point {n}",
                "touch+origin": "Calibration point {n}, first orientation point",
                "x": "Orientation point along +X",
                "z": "Orientation point along +Z",
            },
            "mean error",
            "largest error",
        ),
        "zh": Words(
            {
                "touch": "TCP 位置标定，默认方向",
                "touch_z": "TCP 位置与 Z 方向标定",
                "touch_zx": "TCP 位置与 Z/X 方向标定",
            },
            {
                "touch": "标定点 {n}",
                "touch+origin": "标定点 {n}（姿态标定第 1 点）",
                "x": "+X 方向姿态标定点",
                "z": "+Z 方向姿态标定点",
            },
            "平均偏差",
            "最大偏差",
        ),
    },
)
