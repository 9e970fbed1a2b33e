"""Every number by which the diagnosis decides, with its unit and its reason, by what it decides.

evidence      what a group costs and must bring
naming        names on poses, and what both kinds share; naming_logs: names on joint logs
conventions   how a recording of poses was written down; readings: how a joint log is to be read
rows          what counts and what is set aside
noise         how loud, and when more is left
repeats       when differences of two runs are noise
events        changes in the middle of a joint log
friction      how sharply it turns over at rest
commands      measured angles behind commanded ones
drivers       what effects follow, and how far what was learnt holds

Nominal sizes of an effect stand in the effect's own file: they say how large it is in arms as they are built. Steps
of a solver, sizes of its work and of pictures stand where they are used: they decide no finding.
"""
