"""A load that the description does not have, or a hand that it has and the arm has not; on the flange or on a link."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from app.diagnosis.effects.described import Body, body
from app.diagnosis.effects.dynamic._law import Values, Where
from app.diagnosis.effects.dynamic._load import SMALLEST, Load
from app.diagnosis.effects.effect import Place
from app.diagnosis.models.dynamic.state import State
from app.diagnosis.result import Parameter
from app.kinematics import RobotModel

FARTHEST = 1.0  # m from the flange: farther out is no load's centre


class Payload(Load):
    key = "payload"
    title = "a load"
    family = "load"
    likely = True
    apart = True
    equation = "tau = tau of a mass at its centre in the frame of the flange, or of the link it is fixed to"

    def places(self, situation: State) -> Iterable[Place]:
        """The flange; a load on another link has the columns of that link's masses and is told from their values."""
        return [Place({"body": "tool"})]

    def aliases(self, place: Place, joints: int) -> Sequence[tuple[str, Where]]:
        return [("link_inertia", {"link": place.where.get("link", joints)})]

    def lawful(self, parameters: Values) -> bool:
        far = max(abs(parameters[f"com_{c}"]) for c in "xyz")
        return abs(parameters["mass"]) > SMALLEST and far < FARTHEST

    def described(self, robot: RobotModel, where: Where, parameters: Values) -> tuple[Body, ...]:
        return body(where, parameters)

    def sentence(self, place: Place, parameters: tuple[Parameter, ...]) -> str:
        values = {p.name: p.value for p in parameters}
        at = f"({values['com_x']:.3f}, {values['com_y']:.3f}, {values['com_z']:.3f}) m"
        if "link" in place.where:
            return (
                f"A load of {values['mass']:.3f} kg on link {place.where['link']}, its centre at {at} of the link's "
                "frame, as far as this motion shows it."
            )
        if values["mass"] < 0:
            return f"The description carries {-values['mass']:.3f} kg at {at} of the flange that the arm has not."
        return f"A load of {values['mass']:.3f} kg on the flange, its centre at {at}."


EFFECT = Payload()
