"""Laws as the world has them, written apart from the library of the diagnosis.

term.py     one effect at one place with its values; reading `NAME:joint=2,size=0.1` from a command line
static/     laws seen in where a tool point is
motion/     laws seen in joint torques over time
outside/    static/ and motion/: laws that the diagnosis does not hold, on purpose
"""
