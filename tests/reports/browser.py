"""Drives a headless Chromium through its debugging pipe: no driver, no port, nothing to install beside it."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import time
from pathlib import Path
from types import TracebackType
from typing import Any, Self

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
_FLAGS = (
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--disable-extensions",
    "--disable-default-apps",
    "--hide-scrollbars",
    "--remote-debugging-pipe",
    "about:blank",
)
AXE = os.environ.get("AXE_CORE", "")  # where axe.min.js lies; .ci/run installs it
_PATIENCE = 30.0  # seconds


class Browser:
    """One browser with one page.

    Parameters
    ----------
    profile : Path
        A new folder for everything that the browser writes.
    """

    def __init__(self, profile: Path) -> None:
        assert CHROMIUM is not None
        theirs_in, self._out = os.pipe()
        self._in, theirs_out = os.pipe()
        command = [CHROMIUM, f"--user-data-dir={profile}", *_FLAGS]
        # The browser reads commands from descriptor 3 and answers on 4.
        shell = f'exec "$@" 3<&{theirs_in} 4>&{theirs_out}'
        self._process = subprocess.Popen(
            ["bash", "-c", shell, "bash", *command],
            pass_fds=(theirs_in, theirs_out),
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            env={**os.environ, "HOME": str(profile)},
        )
        os.close(theirs_in)
        os.close(theirs_out)
        os.set_blocking(self._in, False)
        self._buffer = b""
        self._number = 0
        self._session = ""
        self.events: list[dict[str, Any]] = []
        target = self.send("Target.createTarget", url="about:blank")["targetId"]
        self._session = self.send("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Network", "Log"):
            self.send(f"{domain}.enable")

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        os.close(self._out)
        os.close(self._in)
        self._process.kill()
        self._process.wait()

    def send(self, method: str, **parameters: Any) -> dict[str, Any]:
        """Send a command and return its result; events that arrive meanwhile are kept."""
        self._number += 1
        message: dict[str, Any] = {"id": self._number, "method": method, "params": parameters}
        if self._session:
            message["sessionId"] = self._session
        self._write(json.dumps(message).encode() + b"\0")
        while True:
            answer = self._receive()
            if answer.get("id") == self._number:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']}")
                result: dict[str, Any] = answer["result"]
                return result
            self.events.append(answer)

    def _write(self, data: bytes) -> None:
        while data:
            data = data[os.write(self._out, data[:4096]) :]

    def _receive(self) -> dict[str, Any]:
        deadline = time.monotonic() + _PATIENCE
        while b"\0" not in self._buffer:
            try:
                chunk = os.read(self._in, 1 << 16)
            except BlockingIOError:
                chunk = b""
                time.sleep(0.005)
            self._buffer += chunk
            if time.monotonic() > deadline:
                raise TimeoutError("the browser does not answer")
        data, _, self._buffer = self._buffer.partition(b"\0")
        message: dict[str, Any] = json.loads(data)
        return message

    def open(self, path: Path | str, *, width: int = 1200, dark: bool = False, script: bool = True) -> None:
        """Open a file or an address at a width, in light or dark mode, with or without its script; wait for it."""
        self.send(
            "Emulation.setDeviceMetricsOverride", width=width, height=900, deviceScaleFactor=1, mobile=width < 600
        )
        scheme = {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}
        self.send("Emulation.setEmulatedMedia", features=[scheme])
        self.send("Emulation.setScriptExecutionDisabled", value=not script)
        self._navigate("about:blank")
        self._navigate(path if isinstance(path, str) else path.as_uri())

    def _navigate(self, url: str) -> None:
        self.events.clear()
        self.send("Page.navigate", url=url)
        while not any(event.get("method") == "Page.loadEventFired" for event in self.events):
            self.events.append(self._receive())

    def run(self, expression: str) -> Any:
        """Evaluate JavaScript in the page, whatever the page's own policy; return its value."""
        answer = self.send("Runtime.evaluate", expression=expression, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in answer:
            raise RuntimeError(answer["exceptionDetails"]["text"] + str(answer["result"].get("description", "")))
        return answer["result"].get("value")

    def press(self, text: str) -> None:
        """Type text into what has the focus."""
        for character in text:
            self.send("Input.dispatchKeyEvent", type="keyDown", text=character, key=character)
            self.send("Input.dispatchKeyEvent", type="keyUp", key=character)

    def escape(self) -> None:
        """Press the escape key."""
        for kind in ("rawKeyDown", "keyUp"):
            self.send("Input.dispatchKeyEvent", type=kind, key="Escape", code="Escape", windowsVirtualKeyCode=27)

    def violations(self) -> list[Any]:
        """Return what axe-core finds wrong with the page."""
        self.run(Path(AXE).read_text(encoding="utf-8"))
        listed = "r.violations.map((v) => [v.id, v.nodes.map((n) => n.html)])"
        passed, found = self.run(f"axe.run().then((r) => [r.passes.length, {listed}])")
        assert passed > 10, "axe-core has looked at nothing"
        return list(found)

    def wait_for(self, expression: str) -> None:
        """Wait until JavaScript says true, also across a new page."""
        deadline = time.monotonic() + _PATIENCE
        while True:
            try:
                if self.run(expression):
                    return
            except RuntimeError:
                pass  # the old page is gone, the new one not yet there
            if time.monotonic() > deadline:
                raise TimeoutError(expression)
            time.sleep(0.02)

    def complaints(self) -> list[str]:
        """Return errors and warnings since the page was opened: the console's, the policy's, uncaught exceptions."""
        found = []
        for event in self.events:
            parameters = event.get("params", {})
            if event.get("method") == "Runtime.exceptionThrown":
                found.append(str(parameters["exceptionDetails"]))
            elif event.get("method") == "Log.entryAdded":
                found.append(parameters["entry"]["text"])
            elif event.get("method") == "Runtime.consoleAPICalled":
                found.append(str(parameters["args"]))
        return found

    def requests(self) -> list[str]:
        """Return the addresses that were asked for since the page was opened, without data in the page itself."""
        asked = [e["params"]["request"]["url"] for e in self.events if e.get("method") == "Network.requestWillBeSent"]
        return [url for url in asked if not url.startswith("data:")]
