"""A meshcat server, and pictures sent to it as they come."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from mcplan.view.stage import Stage


class LiveServer:
    """A meshcat server in a process of its own. Browsers that open its page later see what there is then.

    Attributes:
        url: What to open.
    """

    def __init__(self) -> None:
        import zmq  # comes with meshcat
        from meshcat.servers.zmqserver import start_zmq_server_as_subprocess  # type: ignore[import-untyped]

        self._server, self._zmq_url, self.url = start_zmq_server_as_subprocess()
        self._zmq = zmq
        self._socket: Any = self._connected()

    def wait(self) -> None:
        """Return when a browser has opened the page; Ctrl-C ends it."""
        self._send([b"wait"])
        # The server answers this from a timer, after which it does not notice what comes by the same connection.
        self._socket.close(linger=0)
        self._socket = self._connected()

    def show(self, stage: Stage) -> None:
        """Send what a stage has collected since the last time."""
        for command, path, packed in stage.taken():
            self._send([command, path, packed])

    def close(self) -> None:
        """End the server; what a browser shows stays."""
        self._socket.close(linger=0)
        self._server.terminate()
        self._server.wait()

    def _connected(self) -> Any:
        socket: Any = self._zmq.Context.instance().socket(self._zmq.REQ)
        socket.connect(self._zmq_url)
        return socket

    def _send(self, parts: list[bytes]) -> None:
        """Send a command and take the answer; a server that has been ended is no error: nothing is shown then."""
        if self._server.poll() is not None:
            return
        self._socket.send_multipart(parts)
        while not self._socket.poll(200):
            if self._server.poll() is not None:
                return
        self._socket.recv()
