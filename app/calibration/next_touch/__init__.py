"""Where to touch next, and what a touch would bring.

prediction.py   orientations of touches -> uncertainty of the tool point, before any of them is made
candidates.py   the orientations that are allowed: tilt and turn about a reference
plan.py         the best set of further touches, chosen all at once
proposal.py     the next touch as a pose that the arm reaches, within limits and free of collision

proposal = propose(rotations, tool=…, spike=…, robot=robot, collides=world.check)
proposal.q              ghost arm
proposal.now, .after    predicted half length of the tool point's 95% region [m]
"""

from app.calibration.next_touch.candidates import TouchLimits
from app.calibration.next_touch.plan import plan_touches
from app.calibration.next_touch.prediction import predicted_covariance, predicted_error
from app.calibration.next_touch.proposal import Proposal, propose

__all__ = [
    "Proposal",
    "TouchLimits",
    "plan_touches",
    "predicted_covariance",
    "predicted_error",
    "propose",
]
