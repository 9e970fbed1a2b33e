"""How many spoilt texts each reader is given, and how a good text is spoilt."""

from hypothesis import strategies as st

#: Examples of one run of each test; `an importer` counts for each of the formats.
EXAMPLES = {
    "spoilt points file": 1600,
    "any numbers": 900,
    "any bytes": 300,
    "an importer": 900,
}

_PIECES = st.one_of(
    st.text(max_size=8),
    st.sampled_from(["nan", "inf", "1e999", "-", "0" * 400, "{", "]", "\x00", "${", "!", ";"]),
)


def mangled(text):
    """A good text with a piece cut out, doubled or replaced."""
    places = st.integers(0, len(text))
    return st.builds(
        lambda a, b, piece: text[: min(a, b)] + piece + text[max(a, b) :], places, places, _PIECES
    )
