"""Where the recordings of real arms are, which are not part of this project."""

import os
from pathlib import Path

import pytest


def data_folder() -> Path:
    """The folder of real recordings: $TEACHFRAME_DATA, else ../shared/data beside the checkout.

    Under CI a missing folder is a failure; elsewhere the test is skipped and says why.
    """
    named = os.environ.get("TEACHFRAME_DATA")
    folder = Path(named) if named else Path(__file__).parents[2] / "shared" / "data"
    if not folder.is_dir():
        reason = f"no real recordings at {folder}; set TEACHFRAME_DATA to their folder"
        if os.environ.get("CI"):
            pytest.fail(reason)
        pytest.skip(reason)
    return folder
