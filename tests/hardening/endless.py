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
    first, again, last = {
        "one cell": (b'"', b"a", b'"'),
        "a cell that is not closed": (b'"', b"a\n", b""),
        "line ends": (b"", b"\n", b""),
        "returns": (b"", b"\r", b""),
        "commas": (b"", b",", b""),
        "rows of commas": (b"", commas + b"\n", b""),
        "rows of empty quotes": (b"", b'""' + commas + b"\n", b""),
        "blank lines": (b"", b" \n", b""),
        "remarks": (b"", b"#\n", b""),
        "quotes": (b"", b'"', b""),
        "blanks": (b"", b" ", b""),
        "digits": (b"", b"1", b""),
        "zeros": (b"", b"\0", b""),
        "words": (b"", b"a\n", b""),
    }[what]
    return head + row + first + again * (size // len(again)) + last + b"\n" + row


KINDS_OF_END = (
    "one cell", "a cell that is not closed", "line ends", "returns", "commas", "rows of commas", "rows of empty quotes",
    "blank lines", "remarks", "quotes", "blanks", "digits", "zeros", "words",
)  # fmt: skip
