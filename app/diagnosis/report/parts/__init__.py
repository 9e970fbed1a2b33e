"""One file a section of the page; each gives HTML, or nothing where it has nothing to say."""
