"""Live voices: sound made while the client changes the parameters, over one WebSocket per voice.

Design note
===========

The goal is a short, even delay from a slider to the sound, for several voices at a time, while the same server also
answers requests. One voice makes a block of 10 ms a hundred times a second.

- **A process of its own** (``voice_process``). All voices are played by one thread of one process of high priority.
  Threads per voice would compete for Python's lock, and the load of the server would be heard as gaps. ``host`` starts
  the process with the first voice, restarts it after a crash, and counts the voices.
- **Handover of the connection** (``handover``). The server accepts the WebSocket, checks host, origin and token, and
  passes the socket itself to the voice process, with the handshake still to be sent. After that the server has no part
  in the voice. A TLS connection cannot be passed on: there the server copies bytes between the client and a socket
  pair.
- **A WebSocket that never waits** (``client``). Short masked text frames in and unmasked frames out are read and
  written directly. Everything else (close, ping, fragments, faults) goes through the protocol of ``websockets``.
  A client that sends too much, or takes its sound too slowly, is disconnected.
- **Pacing** (``pace``). A control message is followed at once by all blocks that are due before the next expected
  message. That has the same latency as waking for every block, with 60 instead of 100 wake-ups a second.
- **The voice** (``player``) limits how fast parameters move, makes the blocks, and records on request (``recording``).
  ``state_frame`` and ``strobe`` make the 12 pictures a second that the page draws.
- **Messages** (``protocol``) are part of the public interface.
"""
