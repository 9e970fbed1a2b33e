"""What may stay Latin in a Chinese sentence: names, units, symbols, columns and commands; nothing else."""

import re

_SYMBOLS = "X Y Z A B C W P R N p q rms BIC SCARA TCP URDF CSV JSON robot"
_UNITS = "mm um m deg rad Nm kg s Hz"
_COLUMNS = (
    "angle_deg axis1_sense axis2_sense towards_workspace_mm T_tracker_base T_tracker_maker T_base1_base2"
)
ALLOWED = {*_SYMBOLS.split(), *_UNITS.split(), *_COLUMNS.split()}
CHINESE = re.compile(r"[\u4e00-\u9fff]")
_WORD = re.compile(r"[A-Za-z][A-Za-z0-9_]*")


def english_left(sentence, names=()):
    """Latin words of a sentence that are neither allowed nor among these names."""
    for name in names:
        sentence = sentence.replace(name, "")
    return [word for word in _WORD.findall(sentence) if word not in ALLOWED]
