"""A motion controller's side of the towbench protocol. Standard library only, Python 3.9 or later.

    bench = towbench.connect("local:/tmp/tb/plant")
    bench.greet(reference=True)
    while bench.turn():                      # outputs out, time goes on, inputs in
        y = bench.axes["y"]
        bench.drive("y", 4.0 * (y.reference.position_m - METRES_PER_COUNT * y.count))

Bytes and rules: docs/reference/protocol.md.
"""

from __future__ import annotations

import math
import os
import select
import socket
import struct
import sys
import time
from dataclasses import dataclass, field
from functools import reduce
from operator import getitem, xor
from typing import Any, Callable, Iterator, NamedTuple, Tuple

VERSION = 2
CONTROLLER, PLANT, OBSERVER = 0, 1, 2
EDGES, DIGEST, REFERENCE, RESETS, ABSOLUTE = 1, 2, 4, 8, 16  # capabilities
AXES = ("y", "x", "z", "a", "b", "c")
HALL_Y_MIN, HALL_Y_MAX, HALL_X_MIN, HALL_X_MAX, KILL_SWITCH, READY_Y, READY_X = (1 << n for n in range(7))
FURTHER_HALLS = sum(1 << n for n in range(7, 15))  # z min, z max, a min ... c max
FURTHER_READY = 1 << 15  # of z to c, in series
HOMES = sum(1 << n for n in range(16, 22))  # home switch of y, x, z, a, b, c
HALLS = HALL_Y_MIN | HALL_Y_MAX | HALL_X_MIN | HALL_X_MAX | FURTHER_HALLS
MAX_EDGES = 1024
_EDGES_HEADER = 25

# The error numbers of version 2.
KNOWN_CODES = frozenset(
    [0, *range(100, 110), *range(200, 212), *range(300, 304), *range(310, 316), 320, 321, 330, 340, 350, 351]
    + [*range(400, 407), *range(410, 415), *range(420, 425), *range(500, 506)]
)


class BenchError(Exception):
    """The bench refused us, is gone, or is silent."""


# --- messages ---------------------------------------------------------------------------------------------------


Fields = Tuple[Any, ...]


class Layout(NamedTuple):
    """The fields behind the id, little-endian, and whether they are legal together."""

    name: str
    fields: struct.Struct
    legal: Callable[[Fields], Any]


def _hello(m: Fields) -> Any:
    return m[1] <= OBSERVER and m[2] < 1 << len(AXES)


def _finite(values: Fields) -> bool:
    """Singles, of which no sum leaves the doubles: one that is infinite or no number makes the sum so."""
    return math.isfinite(sum(values))


HELLO, HELLO_REPLY, PWM_DUTY, ENCODER_EDGES, ENCODER_REPORT, DIGITAL_INPUTS, DIGITAL_OUTPUTS = range(1, 8)
FORCE_SAMPLE, CURRENT_SAMPLE, ADVANCE, ADVANCED, HEARTBEAT, FAULT, BYE, REFERENCE_POINT, RESET, ABSOLUTE_COUNT = range(8, 18)

LAYOUTS: dict[int, Layout] = {
    HELLO: Layout("Hello", struct.Struct("<HBBIIIQ"), _hello),
    HELLO_REPLY: Layout("HelloReply", struct.Struct("<HBBIIIQH"), lambda m: _hello(m) and m[7] in KNOWN_CODES),
    PWM_DUTY: Layout(
        "PwmDuty", struct.Struct("<BBHHHI"), lambda m: m[0] < len(AXES) and m[1] < 2 and 0 < m[4] >= max(m[2], m[3])
    ),
    # With the count of edges, which stand behind: 32 bits each.
    ENCODER_EDGES: Layout(
        "EncoderEdges",
        struct.Struct("<BBqqIH"),
        lambda m: m[0] < len(AXES) and m[1] < 8 and m[2] >= 0 and m[3] >= 0 and m[5] <= MAX_EDGES,
    ),
    ENCODER_REPORT: Layout(
        "EncoderReport", struct.Struct("<BBqiqIiHHI"), lambda m: m[0] < len(AXES) and m[1] < 8 and 0 <= m[4] <= m[2]
    ),
    DIGITAL_INPUTS: Layout("DigitalInputs", struct.Struct("<IqI"), lambda m: m[0] < 1 << 22 and m[1] >= 0),
    # Enables of the amplifiers, then releases of the holding brakes.
    DIGITAL_OUTPUTS: Layout("DigitalOutputs", struct.Struct("<HqI"), lambda m: m[0] < 1 << 2 * len(AXES) and m[1] >= 0),
    FORCE_SAMPLE: Layout("ForceSample", struct.Struct("<q6f"), lambda m: m[0] >= 0 and _finite(m[1:])),
    CURRENT_SAMPLE: Layout(
        "CurrentSample", struct.Struct("<Bqf"), lambda m: m[0] < len(AXES) and m[1] >= 0 and math.isfinite(m[2])
    ),
    ADVANCE: Layout("Advance", struct.Struct("<q"), lambda m: m[0] >= 0),
    ADVANCED: Layout("Advanced", struct.Struct("<q"), lambda m: m[0] >= 0),
    HEARTBEAT: Layout("Heartbeat", struct.Struct("<qI"), lambda m: m[0] >= 0),
    FAULT: Layout("Fault", struct.Struct("<HqI"), lambda m: m[0] in KNOWN_CODES and m[1] >= 0),
    BYE: Layout("Bye", struct.Struct("<q"), lambda m: m[0] >= 0),
    REFERENCE_POINT: Layout(
        "Reference", struct.Struct("<Bq3f"), lambda m: m[0] < len(AXES) and m[1] >= 0 and _finite(m[2:])
    ),
    RESET: Layout("Reset", struct.Struct("<q"), lambda m: m[0] >= 0),
    ABSOLUTE_COUNT: Layout("AbsoluteCount", struct.Struct("<BqiI"), lambda m: m[0] < len(AXES) and m[1] >= 0),
}


_ID = {kind: bytes((kind,)) for kind in LAYOUTS}


def encode(kind: int, *fields: float, edges: tuple[int, ...] = ()) -> bytes:
    """The payload: one byte of id, then the fields."""
    payload = _ID[kind] + LAYOUTS[kind].fields.pack(*fields)
    return payload + struct.pack(f"<{len(edges)}I", *edges) if edges else payload


def decode(payload: bytes) -> tuple[int, Fields, tuple[int, ...]]:
    """Id, fields and edges. KeyError: unknown id; EOFError: shorter than its message; ValueError: an illegal field."""
    if not payload:
        raise EOFError("empty")
    kind = payload[0]
    layout = LAYOUTS[kind]
    if len(payload) == _SIZE.get(kind):
        fields = layout.fields.unpack_from(payload, 1)
        if not layout.legal(fields):
            raise ValueError(layout.name)
        return kind, fields, ()
    size = 1 + layout.fields.size
    if len(payload) < size:
        raise EOFError(layout.name)
    fields = layout.fields.unpack_from(payload, 1)
    if not layout.legal(fields):
        raise ValueError(layout.name)
    edges: tuple[int, ...] = ()
    if kind == ENCODER_EDGES:
        size += 4 * fields[5]
        if len(payload) != size:
            raise ValueError(layout.name)
        edges = struct.unpack_from(f"<{fields[5]}I", payload, _EDGES_HEADER)
        length = sum(edge & 0x3FFFFFFF for edge in edges)
        if any(edge >> 30 == 3 for edge in edges) or length > fields[3] - fields[2]:
            raise ValueError(layout.name)
    # The greeting of another version may be longer than ours; nothing else may be.
    if len(payload) > size and (kind not in (HELLO, HELLO_REPLY) or fields[0] == VERSION):
        raise ValueError(layout.name)
    return kind, fields, edges


# Of the messages that have one size only.
_SIZE = {kind: 1 + m.fields.size for kind, m in LAYOUTS.items() if kind not in (HELLO, HELLO_REPLY, ENCODER_EDGES)}


def is_plausible(kind: int, size: int) -> bool:
    """Whether a payload of this id can have this size."""
    layout = LAYOUTS.get(kind)
    if layout is None:
        return False
    shortest = 1 + layout.fields.size
    if kind in (HELLO, HELLO_REPLY):
        return shortest <= size <= 255
    if kind == ENCODER_EDGES:
        return shortest <= size <= shortest + 4 * MAX_EDGES and (size - shortest) % 4 == 0
    return size == shortest


# --- checksum and framing -----------------------------------------------------------------------------------------


def _byte_table() -> list[int]:
    table = []
    for value in range(256):
        for _ in range(8):
            value = value >> 1 ^ (0x82F63B78 if value & 1 else 0)
        table.append(value)
    return table


_LONGEST_BY_PLACE = 64
# What a byte adds to the checksum, by how many bytes follow it; the farthest first.
_CRC_BY_PLACE = [_byte_table()]
for _ in range(1, _LONGEST_BY_PLACE):
    _CRC_BY_PLACE.insert(0, [value >> 8 ^ _CRC_BY_PLACE[-1][value & 255] for value in _CRC_BY_PLACE[0]])
_CRC_BY_SIZE = [_CRC_BY_PLACE[_LONGEST_BY_PLACE - size :] for size in range(_LONGEST_BY_PLACE + 1)]


def _crc_step(crc: int, data: bytes) -> int:
    table = _CRC_BY_PLACE[-1]
    for byte in data:
        crc = table[(crc ^ byte) & 255] ^ crc >> 8
    return crc


_CRC_START = [_crc_step(0xFFFFFFFF, bytes(size)) ^ 0xFFFFFFFF for size in range(_LONGEST_BY_PLACE + 1)]


_CRC_OF_CHECKED = 0x48674BC7  # of whatever is followed by its checksum


def crc32c(data: bytes) -> int:
    """CRC-32C. It is linear: for a short message, each byte's contribution comes from a table by its place."""
    size = len(data)
    if size > _LONGEST_BY_PLACE:
        return _crc_step(0xFFFFFFFF, data) ^ 0xFFFFFFFF
    return reduce(xor, map(getitem, _CRC_BY_SIZE[size], data), _CRC_START[size])  # type: ignore[arg-type]


@dataclass
class Counts:
    """What a reader met that was no message, gaps in sequence numbers, and turns without an absolute count."""

    bad_checksum: int = 0
    too_long: int = 0
    truncated: int = 0
    unknown: int = 0
    bad_field: int = 0
    discarded_bytes: int = 0
    sequence_gaps: int = 0


_LENGTH, _CHECKSUM = struct.Struct("<H"), struct.Struct("<I")


class LengthFraming:
    """length u16, payload, CRC-32C over both: for a stream that loses nothing."""

    def __init__(self, counts: Counts) -> None:
        self.counts = counts
        self._held = b""
        self._in_place = True

    @staticmethod
    def frame(payload: bytes) -> bytes:
        covered = _LENGTH.pack(len(payload)) + payload
        return covered + _CHECKSUM.pack(crc32c(covered))

    def feed(self, data: bytes) -> Iterator[bytes]:
        held = self._held + data if self._held else data
        at, there = 0, len(held)
        while there - at >= 3:
            size = held[at] | held[at + 1] << 8
            kind = held[at + 2]
            if size == _SIZE.get(kind) or is_plausible(kind, size):
                end = at + 6 + size
                if there < end:
                    break
                if crc32c(held[at:end]) == _CRC_OF_CHECKED:
                    yield held[at + 2 : end - 4]
                    at = end
                    self._in_place = True
                    continue
                self.counts.bad_checksum += self._in_place
            elif self._in_place:
                self.counts.truncated += 1
            self._in_place = False
            self.counts.discarded_bytes += 1
            at += 1
        self._held = held[at:]


class CobsFraming:
    """COBS(payload, CRC-32C over it), 0: for a serial line."""

    _LONGEST = _EDGES_HEADER + 4 * MAX_EDGES + 4

    def __init__(self, counts: Counts) -> None:
        self.counts = counts
        self._held = bytearray()

    @staticmethod
    def frame(payload: bytes) -> bytes:
        covered = payload + crc32c(payload).to_bytes(4, "little")
        out = bytearray()
        for block in covered.split(b"\0"):
            while len(block) >= 254:
                out.append(255)
                out += block[:254]
                block = block[254:]
            out.append(len(block) + 1)
            out += block
        return bytes(out) + b"\0"

    @staticmethod
    def _unstuff(data: bytes) -> bytes | None:
        out = bytearray()
        at = 0
        while at < len(data):
            step = data[at]
            if step == 0 or at + step > len(data):
                return None
            out += data[at + 1 : at + step]
            at += step
            if step < 255 and at < len(data):
                out.append(0)
        return bytes(out)

    def feed(self, data: bytes) -> Iterator[bytes]:
        self._held += data
        while (end := self._held.find(0)) >= 0:
            stuffed = bytes(self._held[:end])
            del self._held[: end + 1]
            if not stuffed:
                continue
            plain = self._unstuff(stuffed)
            if plain is not None and len(plain) > 4 and crc32c(plain) == _CRC_OF_CHECKED:
                yield plain[:-4]
            else:
                self.counts.bad_checksum += 1
                self.counts.discarded_bytes += end + 1
        if len(self._held) > 2 * self._LONGEST:
            self.counts.too_long += 1
            self.counts.discarded_bytes += len(self._held)
            self._held.clear()


_CAN_FRAME = struct.Struct("<IB3x8s")  # identifier, length, data, as the kernel has them
# Identifiers to the plant, or of an axis; those to the controller are one higher.
_CAN_FAULT, _CAN_BYE, _CAN_LINES, _CAN_DUTY, _CAN_INDEX, _CAN_DIGEST = 0x40, 0x50, 0x80, 0x100, 0x180, 0x190
_CAN_TIME, _CAN_LONG, _CAN_HEARTBEAT = 0x200, 0x600, 0x700
_SEGMENT, _FIRST_SEGMENT = 7, 0x80


@dataclass
class _CanReport:
    """What a packed report of an axis is relative to: the one before."""

    time_ns: int = 0
    interval_ns: int = 0
    edge_ns: int = 0
    period_ns: int = 0
    index_count: int = 0
    sequence: int = 0
    noted: int = 0  # in a row, up to two: then the interval is known
    index: int | None = None  # the frame of an index pulse that came before


class _Segments:
    """Puts together what took several frames."""

    def __init__(self, counts: Counts, longest: int) -> None:
        self.counts, self.longest = counts, longest
        self._held, self._following = b"", 0

    def take(self, data: bytes) -> bytes | None:
        is_first, behind = data[0] & _FIRST_SEGMENT, data[0] & (_FIRST_SEGMENT - 1)
        if is_first:
            self.counts.truncated += self._following > 0
            self._held = b""
        elif self._following == 0 or behind + 1 != self._following:
            self.counts.truncated += 1
            self._drop()
            return None
        if len(self._held) + (behind + 1) * _SEGMENT > self.longest:
            self.counts.too_long += 1
            self._drop()
            return None
        self._held += data[1:]
        self._following = behind
        if behind:
            return None
        covered = 1 + self._held[0]
        if len(self._held) != -(-(covered + 4) // _SEGMENT) * _SEGMENT:
            self.counts.truncated += 1
        elif crc32c(self._held[: covered + 4]) != _CRC_OF_CHECKED:
            self.counts.bad_checksum += 1
        else:
            return self._held[1:covered]
        return None

    def _drop(self) -> None:
        self.counts.discarded_bytes += 1 + _SEGMENT
        self._following = 0


class CanFraming:
    """Classic CAN: a frame for what every turn sends, segments with a checksum for the rest."""

    def __init__(self, counts: Counts) -> None:
        self.counts = counts
        self._reports = [_CanReport() for _ in AXES]
        self._last_sequence = {DIGITAL_INPUTS: -1, HEARTBEAT: -1}
        self._long, self._fault = _Segments(counts, 266), _Segments(counts, 21)

    @staticmethod
    def frame(payload: bytes) -> bytes:
        kind = payload[0]
        if kind == PWM_DUTY:
            axis, enable, channel_a, channel_b, period, sequence = LAYOUTS[kind].fields.unpack_from(payload, 1)
            word = channel_a | channel_b << 16 | period << 32 | enable << 48 | (sequence & 0x7FFF) << 49
            return _can_frame(_CAN_DUTY + axis, word)
        if kind == DIGITAL_OUTPUTS:
            lines, change_ns, sequence = LAYOUTS[kind].fields.unpack_from(payload, 1)
            if lines < 1 << 8 and 0 <= change_ns < 1 << 48:
                return _can_frame(_CAN_LINES, lines | (sequence & 0xFF) << 8 | change_ns << 16)
        if kind in (ADVANCE, BYE):
            return _CAN_FRAME.pack(_CAN_TIME if kind == ADVANCE else _CAN_BYE, 8, payload[1:])
        covered = bytes((len(payload),)) + payload
        covered += crc32c(covered).to_bytes(4, "little")
        parts = [covered[at : at + _SEGMENT] for at in range(0, len(covered), _SEGMENT)]
        heads = [len(parts) - 1 - i | (0 if i else _FIRST_SEGMENT) for i in range(len(parts))]
        return b"".join(_CAN_FRAME.pack(_CAN_LONG, 8, bytes((head,)) + part) for head, part in zip(heads, parts))

    def feed(self, data: bytes) -> Iterator[bytes]:
        for identifier, size, body in _CAN_FRAME.iter_unpack(data):
            if identifier not in _CAN_TO_CONTROLLER:
                continue
            if size != 8:
                self.counts.truncated += 1
                self.counts.discarded_bytes += size
                continue
            payload = self._payload(identifier, body)
            if payload is not None:
                self._note(payload)
                yield payload

    def _payload(self, identifier: int, body: bytes) -> bytes | None:
        word = int.from_bytes(body, "little")
        if identifier & ~7 == _CAN_INDEX:
            self._reports[identifier & 7].index = word
            return None
        if identifier & ~7 == _CAN_DIGEST:
            return self._report(identifier & 7, word)
        if identifier == _CAN_LINES + 1:
            return encode(DIGITAL_INPUTS, word & 0xFF, word >> 16, self._sequence(DIGITAL_INPUTS, word >> 8, 0xFF))
        if identifier == _CAN_HEARTBEAT + 1:
            return encode(HEARTBEAT, word >> 16, self._sequence(HEARTBEAT, word, 0xFFFF))
        if identifier in (_CAN_TIME + 1, _CAN_BYE + 1):
            return _ID[ADVANCED if identifier == _CAN_TIME + 1 else BYE] + body
        return (self._fault if identifier == _CAN_FAULT + 1 else self._long).take(body)

    def _sequence(self, kind: int, low: int, mask: int) -> int:
        """The first number after the last one whose low bits are these."""
        following = self._last_sequence[kind] + 1
        return following + (low - following & mask) & 0xFFFFFFFF

    def _report(self, axis: int, word: int) -> bytes | None:
        """The report that the frame stands for; None where one before it is missing."""
        last = self._reports[axis]
        index, last.index = last.index, None
        sequence = last.sequence + 1 & 0xFFFFFFFF
        edges = word >> 15 & 3  # none, one, several
        time_ns, edge_ns, period_ns = last.time_ns + last.interval_ns, last.edge_ns, last.period_ns
        known = last.noted == 2 and word >> 18 & 63 == sequence & 63 and edges < 3 and 0 <= time_ns < 1 << 63
        known = known and (word >> 17 & 1) == (index is not None)
        known = known and (index is None or index >> 48 == sequence & 0xFFFF)
        if known and edges:
            edge_ns = time_ns - (word >> 24 & 0xFFFFF)
            known = edge_ns >= last.edge_ns
            to_edge_ns = min(edge_ns - last.edge_ns, 0xFFFFFFFF) if last.edge_ns else period_ns
            period_ns = to_edge_ns if edges == 1 else word >> 44
        if not known:
            last.noted = 0
            self.counts.sequence_gaps += 1
            return None
        change = (word & 0xFFF ^ 0x800) - 0x800
        count = last.index_count if index is None else (index & 0xFFFFFFFF ^ 1 << 31) - (1 << 31)
        pulses = 0 if index is None else index >> 32 & 0xFFFF
        # One with illegal transitions goes whole.
        return encode(
            ENCODER_REPORT, axis, word >> 12 & 7, time_ns, change, edge_ns, period_ns, count, pulses, 0, sequence
        )  # fmt: skip

    def _note(self, payload: bytes) -> None:
        """Whatever way it came: the next packed one is read relative to it."""
        kind = payload[0]
        if kind not in (ENCODER_REPORT, DIGITAL_INPUTS, HEARTBEAT):
            return
        try:
            _, fields, _ = decode(payload)
        except (EOFError, ValueError):
            return
        if kind != ENCODER_REPORT:
            self._last_sequence[kind] = fields[-1]
            return
        axis, _, time_ns, _, edge_ns, period_ns, index_count, _, _, sequence = fields
        last = self._reports[axis]
        follows = last.noted > 0 and sequence == last.sequence + 1 & 0xFFFFFFFF
        interval_ns = time_ns - last.time_ns if follows else 0
        self._reports[axis] = _CanReport(
            time_ns, interval_ns, edge_ns, period_ns, index_count, sequence, 1 + follows, last.index
        )  # fmt: skip


def _can_frame(identifier: int, word: int) -> bytes:
    return _CAN_FRAME.pack(identifier, 8, word.to_bytes(8, "little"))


_CAN_TO_CONTROLLER = frozenset(
    [base + nth for base in (_CAN_INDEX, _CAN_DIGEST) for nth in range(len(AXES))]
    + [base + 1 for base in (_CAN_FAULT, _CAN_BYE, _CAN_LINES, _CAN_TIME, _CAN_LONG, _CAN_HEARTBEAT)]
)


# --- where the bytes go -------------------------------------------------------------------------------------------


_SPINS, _MOST_READS_WITHOUT = 32, 1024
_SAME_PATIENCE_S = 0.01


def _cores() -> int:
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


class SocketPort:
    def __init__(self, path: str, patience_s: float) -> None:
        deadline = time.monotonic() + patience_s
        while True:
            self._socket = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
            try:
                self._socket.connect(path)
                self._patience_s = 0.0
                self._reads_without, self._reads_left = 1, 1 if _cores() > 1 else sys.maxsize
                return
            except (FileNotFoundError, ConnectionRefusedError) as error:
                self._socket.close()
                if time.monotonic() > deadline:
                    raise BenchError(f"{path}: nobody listens ({error})") from error
                time.sleep(0.01)

    def send(self, data: bytes) -> None:
        self._socket.sendall(data)

    def receive(self, timeout_s: float) -> bytes:
        data = self._spin()
        if data is None:
            if abs(timeout_s - self._patience_s) > _SAME_PATIENCE_S:
                self._be_patient(timeout_s)
            try:
                data = self._socket.recv(65536)
            except BlockingIOError:
                return b""
        if not data:
            raise BenchError("the bench closed the connection")
        return data

    def _be_patient(self, timeout_s: float) -> None:
        """The kernel counts the time of a blocked read: one system call less a turn than to ask before."""
        seconds = int(timeout_s)
        at_least_us = max(int(1e6 * (timeout_s - seconds)), 1)  # zero would wait for ever
        self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVTIMEO, struct.pack("ll", seconds, at_least_us))
        self._patience_s = timeout_s

    def _spin(self) -> bytes | None:
        """What comes before a blocked read could be woken; None if nothing does, and then seldom tried again."""
        self._reads_left -= 1
        if self._reads_left > 0:
            return None
        for _ in range(_SPINS):
            try:
                data = self._socket.recv(65536, socket.MSG_DONTWAIT)
                self._reads_without = self._reads_left = 1
                return data
            except BlockingIOError:
                pass
        self._reads_left = self._reads_without = min(2 * self._reads_without, _MOST_READS_WITHOUT)
        return None


class SerialPort:
    def __init__(self, device: str, baud: int) -> None:
        import termios
        import tty

        self._line = os.open(device, os.O_RDWR | os.O_NOCTTY)
        tty.setraw(self._line)
        attributes = termios.tcgetattr(self._line)
        attributes[4] = attributes[5] = getattr(termios, f"B{baud}")
        termios.tcsetattr(self._line, termios.TCSANOW, attributes)

    def send(self, data: bytes) -> None:
        while data:
            data = data[os.write(self._line, data) :]

    def receive(self, timeout_s: float) -> bytes:
        ready, _, _ = select.select([self._line], [], [], timeout_s)
        return os.read(self._line, 65536) if ready else b""


class CanPort:
    def __init__(self, interface: str) -> None:
        try:
            self._socket = socket.socket(socket.AF_CAN, socket.SOCK_RAW, socket.CAN_RAW)
            self._socket.bind((interface,))
        except (AttributeError, OSError) as error:
            raise BenchError(f"can:{interface}: {error}") from error

    def send(self, data: bytes) -> None:
        for at in range(0, len(data), _CAN_FRAME.size):
            self._socket.send(data[at : at + _CAN_FRAME.size])

    def receive(self, timeout_s: float) -> bytes:
        ready, _, _ = select.select([self._socket], [], [], timeout_s)
        return self._socket.recv(_CAN_FRAME.size) if ready else b""


# --- the controller's end -----------------------------------------------------------------------------------------


class Reference(NamedTuple):
    """Where the axis is to be now, counted from where it stood when the run began."""

    position_m: float = 0.0
    velocity_m_per_s: float = 0.0
    acceleration_m_per_s2: float = 0.0


@dataclass
class Axis:
    count: int = 0  # of its edges since the run began
    index_count: int | None = None  # at the last index pulse
    illegal_transitions: int = 0
    reference: Reference = Reference()
    current_A: float | None = None
    absolute: int | None = None  # what an absolute encoder tells, 0 at the machine's zero
    absolute_at_start: int | None = None  # what it told first
    follows_absolute: bool = False  # greet() asked for it
    _levels: int | None = None
    _sequence: int | None = None
    _absolute_sequence: int | None = None
    _absolute_ns: int = 0
    _duty_sequence: int = 0

    @property
    def way(self) -> int:
        """Counts since the run began: by the absolute encoder where greet() asked for it, by its edges elsewhere."""
        return self.absolute - self.absolute_at_start if self.follows_absolute else self.count


# Of (A, B) before << 2 | after: A leads B towards max.
_STEP = {0b0010: 1, 0b1011: 1, 0b1101: 1, 0b0100: 1, 0b0001: -1, 0b0111: -1, 0b1110: -1, 0b1000: -1}


@dataclass
class Bench:
    """One run: greet() once, then turn() until it says False."""

    port: SocketPort | SerialPort | CanPort
    framing: LengthFraming | CobsFraming | CanFraming
    counts: Counts
    silence_s: float = 1.0
    period_ticks: int = 1000
    now_ns: int = 0
    exchange_ns: int = 1_000_000
    lines: int = 0
    axes: dict[str, Axis] = field(default_factory=dict)  # of those that were greeted with
    faults: list[Fields] = field(default_factory=list)  # number, time, detail: what the bench refused
    gives_reference: bool = False
    gives_absolute: bool = False  # of one axis at least
    reset: bool = False  # in this turn the operator asked to leave the safe state
    _out: bytearray = field(default_factory=bytearray)
    _outputs_sequence: int = 0
    _enabled: tuple | None = None
    _ended: int = 0  # the message that ended the last wait
    _reply: Fields | None = None
    _waiting: list[bytes] = field(default_factory=list)

    def send(self, kind: int, *fields: float) -> None:
        """Leaves with the next turn."""
        self._out += self.framing.frame(encode(kind, *fields))

    def greet(
        self,
        axes: tuple[str, ...] = ("y", "x"),
        exchange_ns: int = 1_000_000,
        tick_ns: int = 100_000,
        reference: bool = False,
        edges: bool = False,
        resets: bool = False,
        absolute: tuple[str, ...] = (),
        version: int = VERSION,
    ) -> None:
        """Agrees with the bench and hears the first inputs. BenchError says why it was refused.

        `absolute`: the axes of which it needs what an absolute encoder tells.
        """
        self.exchange_ns, self.axes = exchange_ns, {name: Axis() for name in axes}
        mask = sum(1 << AXES.index(name) for name in axes)
        edges = edges and not isinstance(self.framing, CanFraming)
        wanted = (EDGES if edges else DIGEST) | REFERENCE * reference | RESETS * resets | ABSOLUTE * bool(absolute)
        self.send(HELLO, version, CONTROLLER, mask, tick_ns, exchange_ns, wanted, 0)
        self._wait(HELLO_REPLY)
        assert self._reply is not None
        if self._reply[7] != 0:
            raise BenchError(f"refused with error {self._reply[7]}; the plant says {self._reply[:7]}")
        self.gives_reference = bool(self._reply[5] & REFERENCE)
        self.gives_absolute = bool(self._reply[5] & ABSOLUTE)
        self.send(ADVANCE, 0)
        self._wait(ADVANCED)
        for name in absolute:
            if self.axes[name].absolute is None:
                raise BenchError(f"the encoder of {name} is not absolute")
            self.axes[name].follows_absolute = True

    def enable(self, *axes: str, released: tuple[str, ...] = ()) -> None:
        """Of these axes the amplifier is on from now on, of the others off; `released`: likewise of the holding brakes."""
        if (axes, released) == self._enabled:
            return
        self._enabled = axes, released
        lines = sum(1 << AXES.index(name) for name in axes) | sum(1 << len(AXES) + AXES.index(name) for name in released)
        self.send(DIGITAL_OUTPUTS, lines, self.now_ns, self._outputs_sequence)
        self._outputs_sequence = self._outputs_sequence + 1 & 0xFFFFFFFF

    def drive(self, axis: str, duty: float, enable: bool = True) -> None:
        """Duty from -1 to 1, positive towards max. A number that is none drives nothing."""
        state = self.axes[axis]
        ticks = round(max(-1.0, min(1.0, duty)) * self.period_ticks) if math.isfinite(duty) else 0
        self.send(
            PWM_DUTY, AXES.index(axis), int(enable), max(ticks, 0), max(-ticks, 0), self.period_ticks,
            state._duty_sequence,
        )  # fmt: skip
        state._duty_sequence = state._duty_sequence + 1 & 0xFFFFFFFF

    def turn(self) -> bool:
        """Sends what was said since the last turn and hears what happened until the next exchange.

        False when the bench has ended the run; BenchError when it is gone.
        """
        self.send(ADVANCE, self.now_ns + self.exchange_ns)
        self.reset = False
        self._wait(ADVANCED)
        if self._ended != BYE:
            return True
        self.send(BYE, self.now_ns)
        try:
            self.port.send(bytes(self._out))
        except OSError:
            pass  # the bench need not wait for the answer
        return False

    def _wait(self, expected: int) -> None:
        try:
            self.port.send(bytes(self._out))
        except OSError as error:
            raise BenchError(f"the bench is gone: {error}") from error
        self._out.clear()
        deadline = time.monotonic() + self.silence_s
        left_s = self.silence_s
        while True:
            while self._waiting:
                kind = self._take(self._waiting.pop())
                if kind == expected or kind == BYE:
                    self._ended = kind
                    return
                if kind == HEARTBEAT:  # somebody holds the bench, and it says so
                    deadline = time.monotonic() + self.silence_s
                    left_s = self.silence_s
            if left_s <= 0:
                raise BenchError(f"the bench was silent for {self.silence_s} s")
            self._waiting = list(self.framing.feed(self.port.receive(left_s)))[::-1]  # taken from the end
            left_s = deadline - time.monotonic()

    def _take(self, payload: bytes) -> int:
        try:
            kind, fields, edges = decode(payload)
        except KeyError:
            self.counts.unknown += 1
            return 0
        except EOFError:
            self.counts.truncated += 1
            return 0
        except ValueError:
            self.counts.bad_field += 1
            return 0
        if kind == ENCODER_REPORT:
            axis = self._axis(fields[0])
            axis._sequence = self._checked(axis._sequence, fields[9])
            axis.count += fields[3]
            axis.illegal_transitions += fields[8]
            if fields[7]:
                axis.index_count = fields[6]
        elif kind == REFERENCE_POINT:
            self._axis(fields[0]).reference = Reference(*fields[2:])
        elif kind == ABSOLUTE_COUNT:
            self._take_absolute(self._axis(fields[0]), *fields[1:])
        elif kind == ADVANCED:
            self.now_ns = fields[0]
            self._miss_absolute()
        elif kind == ENCODER_EDGES:
            self._count_edges(self._axis(fields[0]), fields, edges)
        elif kind == DIGITAL_INPUTS:
            self.lines = fields[0]
        elif kind == RESET:
            self.reset = True
        elif kind == FAULT:
            self.faults.append(fields)
        elif kind == CURRENT_SAMPLE:
            self._axis(fields[0]).current_A = fields[2]
        elif kind == HELLO_REPLY:
            self._reply = fields
        return kind

    def _axis(self, number: int) -> Axis:
        return self.axes.setdefault(AXES[number], Axis())

    def _checked(self, before: int | None, sequence: int) -> int:
        if before is not None and sequence != before + 1 & 0xFFFFFFFF:
            self.counts.sequence_gaps += 1
        return sequence

    def _take_absolute(self, axis: Axis, time_ns: int, count: int, sequence: int) -> None:
        axis._absolute_sequence = self._checked(axis._absolute_sequence, sequence)
        axis.absolute, axis._absolute_ns = count, time_ns
        if axis.absolute_at_start is None:
            axis.absolute_at_start = count

    def _miss_absolute(self) -> None:
        """One that has told its count tells it in every turn."""
        for axis in self.axes.values():
            self.counts.sequence_gaps += axis.absolute is not None and axis._absolute_ns != self.now_ns

    def _count_edges(self, axis: Axis, fields: Fields, edges: tuple[int, ...]) -> None:
        axis._sequence = self._checked(axis._sequence, fields[4])
        levels = fields[1]
        for edge in edges:
            line = edge >> 30
            before = levels
            levels ^= 1 << line
            if line == 2:
                if levels & 4:
                    axis.index_count = axis.count
            else:
                # Bit 0 is A, bit 1 is B: the table wants A first.
                a, b, a_now, b_now = before & 1, before >> 1 & 1, levels & 1, levels >> 1 & 1
                axis.count += _STEP[a << 3 | b << 2 | a_now << 1 | b_now]
        axis._levels = levels


def run(program: Callable[[], None]) -> None:
    """What a bench refuses ends the program in one line, with code 1."""
    try:
        program()
    except BenchError as error:
        sys.exit(str(error))


_LONGEST_START_S = 60.0  # of a bench on a bus; it waits for a controller as long


def connect(address: str, patience_s: float = 10.0) -> Bench:
    """local:PATH, serial:DEVICE[@BAUD] or can:INTERFACE. Waits for a bench that is still starting."""
    counts = Counts()
    scheme, _, place = address.partition(":")
    if scheme == "local":
        return Bench(SocketPort(place, patience_s), LengthFraming(counts), counts)
    if scheme == "serial":
        device, _, baud = place.partition("@")
        return Bench(SerialPort(device, int(baud or 921600)), CobsFraming(counts), counts, silence_s=patience_s)
    if scheme == "can":
        bench = Bench(CanPort(place), CanFraming(counts), counts, silence_s=max(patience_s, _LONGEST_START_S))
        bench._wait(HEARTBEAT)  # a bus has no connection: the bench says that it waits
        bench.silence_s = 1.0
        return bench
    raise BenchError(f"{address!r}: local:PATH, serial:DEVICE[@BAUD] or can:INTERFACE")
