"""What lives as long as a session is open: it wires the session, the scene, the screens; the web server speaks to it.

live.py      one open session: what a page may ask of it, what it is told
readout.py   the frame's figures: state, robot, tool, speed, axes, pose
attending.py what everybody of a class does: seen once a second, kept; brings hints
hinted.py    hints and watchers of one session
lessons.py   a lesson that is opened at somebody's pendant from another page
axes.py      what the pairs of jog buttons are called
warm.py      what every session needs, loaded before there is one
hub.py       who has which session open; one page a session; forgotten some time after the page has gone
"""
