"""One file a section of the page: what stands in it, as plain texts and numbers, given to its template."""
