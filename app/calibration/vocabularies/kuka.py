"""KUKA's words (smartPAD, tool calibration)."""

from app.calibration.vocabularies._vocabulary import Vocabulary, Words

VOCABULARY = Vocabulary(
    "kuka",
    "KUKA",
    "ZYX",
    ("A", "B", "C"),
    {
        "en": Words(
            {
                "touch": "XYZ 4-point",
                "reference": "XYZ reference",
                "abc_two_point": "XYZ 4-point and ABC 2-point",
                "abc_world": "XYZ 4-point and ABC world",
                "direct": "Numeric input",
            },
            {
                "touch": "Measuring point {n}",
                "touch+origin": "Measuring point {n}",
                "known": "Reference point with the known tool",
                "minus_x": "Point on the negative X axis",
                "xy": "Point on the XY plane with positive Y",
                "world": "Tool axes parallel to WORLD",
            },
            "Measuring error",
            "Largest measuring error",
        ),
        "zh": Words(
            {
                "touch": "XYZ 4 点法",
                "reference": "XYZ 参照法",
                "abc_two_point": "XYZ 4 点法和 ABC 2 点法",
                "abc_world": "XYZ 4 点法和 ABC 世界坐标法",
                "direct": "数字输入",
            },
            {
                "touch": "测量点 {n}",
                "touch+origin": "测量点 {n}",
                "known": "用已知工具移至参照点",
                "minus_x": "X 轴负方向上的点",
                "xy": "XY 平面上 Y 为正的点",
                "world": "工具坐标轴平行于世界坐标系",
            },
            "测量误差",
            "最大测量误差",
        ),
    },
)
