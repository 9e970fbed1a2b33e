"""A person without a screen: reads the page off the wire, presses its buttons, drags the handle."""

import threading
import time

import msgspec

from benchmarks._browser import Browser

PATIENCE_S = 60.0


class Hand(Browser):
    """Connected until `close`, or until the server dies.

    Attributes:
        rows: label -> uuid of every row of buttons on the page now.
        keys: hotkey -> uuid of its command.
        fields: label -> uuid of the sliders and number fields that were made last.
        gone: set when the connection has ended and all that came by it is read.
    """

    def __init__(self, port, token=None):
        self.rows, self.fields, self.keys, self._labels, self._handle = {}, {}, {}, {}, ("", "")
        self.gone, self._news = threading.Event(), threading.Condition()
        super().__init__(port, token)

    def wait_for(self, true):
        """Waits until something is so on the page; False where the connection ended before."""
        end = time.monotonic() + PATIENCE_S
        with self._news:
            while not true():
                if self.gone.is_set():
                    return False
                assert time.monotonic() < end, f"waited {PATIENCE_S:g} s; the page has {sorted(self.rows)}"
                self._news.wait(0.2)
        return True

    def press(self, row, button):
        """One button of a row, as viser's page sends it."""
        self.send("GuiUpdateMessage", uuid=self.rows[row], updates={"value": button})

    def type(self, field, *values, every=0.1):
        """What viser's page sends while somebody types: the number as it stands after each key."""
        for value in values:
            self.send("GuiUpdateMessage", uuid=self.fields[field], updates={"value": value})
            time.sleep(every)

    def key(self, name, times=1, every=0.033):
        """A key pressed, and repeated as a held one does: viser's page says no more of it."""
        for number in range(times):
            time.sleep(every if number else 0.0)
            self.send("CommandTriggerMessage", uuid=self.keys[name])

    def drag(self, pose):
        """Takes the handle to `pose`, T_base_tool, and lets go."""
        name, owner = self._handle
        self.send("TransformControlsDragStartMessage", name=name, owner=owner)
        self.send(
            "TransformControlsUpdateMessage",
            name=name,
            owner=owner,
            wxyz=tuple(map(float, pose.quaternion)),
            position=tuple(map(float, pose.position)),
        )
        self.send("TransformControlsDragEndMessage", name=name, owner=owner)

    def _listen(self):
        super()._listen()
        with self._news:
            self.gone.set()
            self._news.notify_all()

    def _text(self, data, unpack):
        text = super()._text(data, unpack)
        with self._news:
            for message in msgspec.msgpack.decode(text)["messages"]:
                self._hear(message)
            self._news.notify_all()
        return text

    def _hear(self, message):
        kind = message["type"]
        if kind == "GuiButtonGroupMessage":
            label, uuid = message["props"]["label"], message["uuid"]
            self.rows[label], self._labels[uuid] = uuid, label
        elif kind in ("GuiSliderMessage", "GuiNumberMessage", "GuiVector3Message"):
            self.fields[message["props"]["label"]] = message["uuid"]
        elif kind == "RegisterCommandMessage":
            self.keys[message["props"]["hotkey"]] = message["uuid"]
        elif kind == "GuiRemoveMessage":
            label = self._labels.pop(message["uuid"], None)
            if self.rows.get(label) == message["uuid"]:
                del self.rows[label]
        elif kind == "TransformControlsMessage" and message["name"] == "/handle":
            self._handle = message["name"], message.get("owner", "")
