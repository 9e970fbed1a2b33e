"""One file a format. Each has a `FORMAT` with `key`, `title`, `matches(path, head)` and `read(path) -> Table`."""
