"""What the operator takes away, as downloads: the report, the model, and the arm with it for a simulator."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from app.diagnosis.model import model_of
from app.diagnosis.report import as_page
from app.screens._compare.loaded import Loaded

if TYPE_CHECKING:
    from app.screens.context import Context


def send_report(context: Context, loaded: Loaded | None) -> None:
    """The page of `teachframe diagnose --report`, with the same content, in the operator's language."""
    if loaded is None or loaded.diagnosis is None:
        return
    # The file's name alone: where a server keeps what was sent is nothing for a sheet that is handed on.
    named = f" --robot {Path(loaded.named).name}" if loaded.named else ""
    page = as_page(
        [loaded.diagnosis],
        [loaded.robot],
        command=f"teachframe diagnose {loaded.path.name}{named}",
        language=context.language,
    )
    name = f"{loaded.path.stem}.report.html"
    context.send(name, page.encode("utf-8"))
    context.say("good", context.t("compare.given", name=name))


def send_model(context: Context, loaded: Loaded | None) -> None:
    """The findings as a model file."""
    import msgspec

    if loaded is None or loaded.diagnosis is None:
        return
    content = msgspec.json.format(msgspec.json.encode(model_of(loaded.diagnosis)), indent=2)
    name = f"{loaded.path.stem}.model.json"
    context.send(name, content)
    context.say("good", context.t("compare.given", name=name))


def send_simulation(context: Context, loaded: Loaded | None, key: str) -> None:
    """The arm with what was found, as a simulator reads it; what that cannot carry is said, with its size.

    Args:
        key: of the target: urdf, mjcf, sdf, usd.
    """
    from app.diagnosis.export import export_model, target

    if loaded is None or loaded.diagnosis is None:
        return
    exported = export_model(loaded.robot, model_of(loaded.diagnosis), key)
    name = f"{loaded.path.stem}.model{target(key).suffix}"
    context.send(name, exported.text.encode("utf-8"))
    context.say("good", context.t("compare.given", name=name))
    if exported.left:
        left = "; ".join(str(entry) for entry in exported.left)
        context.say("warning", context.t("compare.not_carried", form=exported.version, left=left))
