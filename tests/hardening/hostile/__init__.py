"""Hostile requests at a server with accounts, while others work.

Run: python -m tests.hardening.hostile [COUNT [TRAINEES]]

The server is a process of its own, the attackers are another; this one plays the trainees, each of whom asks ten times
a second for an answer on his page's socket. Attackers come from 250 addresses (127.0.1.N), know every address of the
server, the ids and log-in names of others, cookies that have ended, and hold a log-in of their own. What they get is
looked at: anything but a refusal counts as let in. Prints one JSON object.

asking.py    one request, one log-in, one socket, from any address
attacks.py   the kinds of attack
working.py   the trainees meanwhile
running.py   all of it
"""
