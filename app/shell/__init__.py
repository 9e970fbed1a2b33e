"""The pendant's page and its web server; the only package that imports Starlette. Knows nothing of viser.

server.py     the server: routes, start and stop
security.py   Host, Origin, cookie, headers: looked at before anything else
messages.py   what page and server say to each other: typed, with a version
words.py      the page's socket: beats and presses in, figures and changes out
bridge.py     the scene's page and socket under our own address
files.py      uploads and downloads
pages/        the page: HTML, CSS, JavaScript, written by hand, without a build step
"""
