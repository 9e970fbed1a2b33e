"""Which sealed cases are drawn: static/ and motion/, one file a stratum, each with a `STRATUM`."""
