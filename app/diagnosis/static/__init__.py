"""The engine for touches and tracker points: what differs between the description and a static recording.

recording, reading, suspicion     the rows, checked
situation, gravity, geometry      the drivers that errors can follow
cell, setup                       the exact forward model, and what every recording leaves open
sensitivity, nuisance, fit        analytic columns and Gauss-Newton on everything free
effect, library                   an effect; all effects at all places as one matrix
score, scan, heldout, search      what earns its place, against chance and against rows left out
robust, noise, shape, leftover    outliers; the noise floor; the driver's curve; what remains
alternatives, next_poses          what the recording cannot tell apart, and the poses that would
diagnose, verdict, findings       the whole, and its words
predict, corrected_urdf           a saved model put to use
"""

from app.diagnosis.static.diagnose import diagnose

__all__ = ["diagnose"]
