"""Many recordings: a row a file, on all cores or on a cluster, nothing done twice.

finding.py   which files of a folder or list are recordings, and whose and when each is
keys.py      what makes two pieces of work the same: content, program version, settings
work.py      one recording to one row, within its time
ledger.py    rows as they come, on the disk; from there to Parquet
local.py     the work on this machine's cores
cluster.py   the same work on a Dask cluster                                   only here: distributed
run.py       what is left to do, done; progress
summary/     which arms share which effect, drift over months, what is new
"""
