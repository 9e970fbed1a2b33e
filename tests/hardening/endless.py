"""Files of one thing without end, behind a good beginning."""

HEADS = {
    "points": (
        b"# kind: points\n# angles: ZYX\nrole,x_mm,y_mm,z_mm,a_deg,b_deg,c_deg\n",
        b"touch,1,2,3,4,5,6\n",
        ("solve",),
    ),
    "arcs": (b"# kind: arcs\naxis,x_mm,y_mm,z_mm\n", b"1,1,2,3\n", ("base",)),
    "log": (
        b"# kind: motion\nt_s," + b",".join(b"q%d_rad" % j for j in range(1, 7)) + b",tau1_Nm\n",
        b"0,0,0,0,0,0,0,0\n",
        ("diagnose", "--robot", "ur5"),
    ),
    "rtde": (
        b"timestamp " + b" ".join(b"actual_q_%d" % j for j in range(6)) + b"\n",
        b"0 0 0 0 0 0 0\n",
        ("diagnose", "--robot", "ur5"),
    ),
    "list": (b"Point ID;X [mm];Y [mm];Z [mm]\n", b"a1;1;2;3\n", ("base",)),
}


def endless(kind: str, what: str, size: int) -> bytes:
    """About `size` bytes of a file."""
    head, row, _ = HEADS[kind]
    commas = b"," * row.count(b",")
    pieces = {
        "one cell": b'"' + b"a" * size + b'"',
        "a cell that is not closed": b'"' + b"a\n" * (size // 2),
        "line ends": b"\n" * size,
        "returns": b"\r" * size,
        "commas": b"," * size,
        "rows of commas": (commas + b"\n") * (size // (len(commas) + 1)),
        "rows of empty quotes": (b'""' + commas + b"\n") * (size // (len(commas) + 3)),
        "blank lines": b" \n" * (size // 2),
        "remarks": b"#\n" * (size // 2),
        "quotes": b'"' * size,
        "blanks": b" " * size,
        "digits": b"1" * size,
        "zeros": b"\0" * size,
        "words": b"a\n" * (size // 2),
    }
    return head + row + pieces[what] + b"\n" + row


KINDS_OF_END = (
    "one cell", "a cell that is not closed", "line ends", "returns", "commas", "rows of commas", "rows of empty quotes",
    "blank lines", "remarks", "quotes", "blanks", "digits", "zeros", "words",
)  # fmt: skip
