"""The one key that is pressed next: on a page at most one stands out, whatever screen is open."""


def standing_out(panel, screen):
    """Labels of the enabled keys of the first rank that are seen while a screen is open, as the page is told.

    Args:
        panel: a session's widgets.
        screen: key of the open one; strips and dialogs are seen beside every screen, whichever made them.
    """
    widgets = {data.id: data for data in panel.widgets()}

    def seen(data):
        if data.kind in ("screen", "strip", "dialog"):
            return data.visible and (data.kind != "screen" or data.key == screen)
        return data.visible and (not data.parent or seen(widgets[data.parent]))

    return [
        data.label if data.kind == "button" else data.options[0]
        for data in widgets.values()
        if data.kind in ("button", "buttons") and data.rank == "main" and not data.disabled and seen(data)
    ]


def two_stand_out(panel):
    """Screens on which more than one key stands out, each with the labels of those keys; empty where all is well."""
    found = {data.key: standing_out(panel, data.key) for data in panel.widgets() if data.kind == "screen"}
    return {screen: labels for screen, labels in found.items() if len(labels) > 1}
