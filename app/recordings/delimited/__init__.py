"""Text tables of any dialect, read in bounded time and memory.

source.py   bytes of a file as UTF-8 with line feeds: UTF-16, carriage returns, a mark at its front
header.py   `# key: value` lines: scalars and flat lists, without aliases, tags and nesting
dialect.py  comma, semicolon or tab; decimal point or comma
rows.py     every row looked at: as wide as the header, nothing but text, not endless
body.py     the rows as columns
"""
