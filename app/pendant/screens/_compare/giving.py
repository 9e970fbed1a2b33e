"""What the operator takes away: the report and the model, as downloads."""

from __future__ import annotations

from typing import TYPE_CHECKING

from app.diagnosis.model import model_of
from app.diagnosis.report import as_page
from app.pendant.screens._compare.loaded import Loaded

if TYPE_CHECKING:
    from app.pendant.client import Pendant


def send_report(pendant: Pendant, loaded: Loaded | None) -> None:
    """The page of `teachframe diagnose --report`, with the same content, in the operator's language."""
    if loaded is None or loaded.diagnosis is None:
        return
    named = f" --robot {loaded.named}" if loaded.named else ""
    page = as_page(
        [loaded.diagnosis],
        [loaded.robot],
        command=f"teachframe diagnose {loaded.path.name}{named}",
        language=pendant.language,
    )
    name = f"{loaded.path.stem}.report.html"
    pendant.client.send_file_download(name, page.encode("utf-8"), save_immediately=True)
    pendant.say("good", pendant.t("compare.given", name=name))


def send_model(pendant: Pendant, loaded: Loaded | None) -> None:
    """The findings as a model file."""
    import msgspec

    if loaded is None or loaded.diagnosis is None:
        return
    content = msgspec.json.format(msgspec.json.encode(model_of(loaded.diagnosis)), indent=2)
    name = f"{loaded.path.stem}.model.json"
    pendant.client.send_file_download(name, content, save_immediately=True)
    pendant.say("good", pendant.t("compare.given", name=name))
