"""Universal Robots' words (PolyScope, TCP)."""

from app.calibration.vocabularies._vocabulary import Vocabulary, Words

VOCABULARY = Vocabulary(
    "ur",
    "Universal Robots",
    "rotvec",
    ("RX", "RY", "RZ"),
    {
        "en": Words(
            {"touch": "TCP position (3 to 4 poses)", "touch_many": "TCP position", "direct": "TCP offset"},
            {"touch": "Pose {n}", "touch+origin": "Pose {n}"},
            "Mean deviation",
            "Largest deviation",
        ),
        "zh": Words(
            {"touch": "TCP 位置（3 至 4 个位姿）", "touch_many": "TCP 位置", "direct": "TCP 偏移"},
            {"touch": "位姿 {n}", "touch+origin": "位姿 {n}"},
            "平均偏差",
            "最大偏差",
        ),
    },
    angle_unit="rad",
)
