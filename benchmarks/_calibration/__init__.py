"""An ordinary static calibration by least squares, the peer that the diagnosis is compared with on real recordings.

It is what a careful user does without this program: base and tool; then every joint zero and every length and angle
of every link; then one stiffness a joint as well. It knows nothing of the diagnosis and shares no code with it.

chain.py     forward kinematics of a serial arm with deviations, and the derivative by each deviation
readings.py  touches and tracker recordings as arrays
fit.py       Gauss-Newton with truncated singular values; rows far off set aside; held-out errors
peer.py      from files to errors, here and carried to another run
"""
