"""The Python client takes and refuses what the bench's own codec does: python_codec.py CLIENT_VECTORS ROOT"""

import random
import subprocess
import sys

sys.path.insert(0, sys.argv[2] + "/clients/python")
import towbench  # noqa: E402

REFUSALS = {KeyError: "unknown", EOFError: "truncated", ValueError: "bad_field"}


def verdict_of(payload: bytes) -> str:
    try:
        kind, fields, edges = towbench.decode(payload)
    except tuple(REFUSALS) as error:
        return REFUSALS[type(error)]
    hello = kind in (towbench.HELLO, towbench.HELLO_REPLY)
    assert hello or towbench.encode(kind, *fields, edges=edges) == payload, payload.hex()
    return "ok"


def payloads_of(framing_type, stream: bytes, step: int) -> list:
    framing = framing_type(towbench.Counts())
    found = []
    for at in range(0, len(stream), step):
        found += framing.feed(stream[at : at + step])
    return found


vectors = subprocess.run([sys.argv[1]], capture_output=True, text=True, check=True).stdout.splitlines()
counted = {}
streams = {}
for line in vectors:
    kind, _, digits = line.partition(" ")
    if kind in ("frames", "cobs") or kind.startswith("can"):
        streams[kind] = bytes.fromhex(digits)
        continue
    counted[kind] = counted.get(kind, 0) + 1
    assert verdict_of(bytes.fromhex(digits)) == kind, f"the bench says {kind}, the client {verdict_of(bytes.fromhex(digits))}: {digits}"
assert min(counted.get(kind, 0) for kind in ("ok", "unknown", "truncated", "bad_field")) > 5, counted

for name, framing_type in (("frames", towbench.LengthFraming), ("cobs", towbench.CobsFraming)):
    stream = streams[name]
    whole = payloads_of(framing_type, stream, len(stream))
    assert len(whole) == 200, (name, len(whole))
    assert b"".join(map(framing_type.frame, whole)) == stream, f"{name}: another frame than the bench's"
    for step in (1, 7, 1000):
        assert payloads_of(framing_type, stream, step) == whole, (name, step)
    damage = random.Random(3)
    for _ in range(300):  # a damaged byte costs few messages, and no wrong one comes
        at = damage.randrange(len(stream))
        broken = stream[:at] + bytes([stream[at] ^ 1 + damage.randrange(255)]) + stream[at + 1 :]
        # What a false header holds back comes when its length of bytes has.
        rest = payloads_of(framing_type, broken + bytes(5000), 4096)
        assert all(payload in whole for payload in rest), (name, at)
        assert len(rest) >= 198, (name, at, len(rest))


def of_lengths(stream: bytes) -> list:
    return payloads_of(towbench.LengthFraming, stream, 4096)


def taken(frames: bytes) -> tuple:
    """The legal payloads in a controller's frames, and what was counted besides."""
    framing = towbench.CanFraming(towbench.Counts())
    found = []
    for at in range(0, len(frames), 16):  # as the port hands them over
        found += [payload for payload in framing.feed(frames[at : at + 16]) if verdict_of(payload) == "ok"]
    return found, framing.counts


for name in ("can", "can_hurt"):
    expected = of_lengths(streams[name + "_taken"])
    found, counts = taken(streams[name])
    differ = [i for i, pair in enumerate(zip(found, expected)) if pair[0] != pair[1]]
    assert found == expected, (name, len(found), len(expected), differ[:3])
    assert (counts.sequence_gaps > 10) == (name == "can_hurt"), (name, counts)
    packed = [1 for at in range(0, len(streams[name]), 16) if streams[name][at : at + 2] in (b"\x90\x01", b"\x91\x01")]
    assert len(packed) > 1000, len(packed)
sent = of_lengths(streams["can_payloads"])
assert len(sent) == 4 * 33_000 + 3, len(sent)
assert b"".join(map(towbench.CanFraming.frame, sent)) == streams["can_sent"], "another frame than the packer's"


def takes(bench: towbench.Bench, kind: int, *fields: int) -> None:
    bench._take(towbench.encode(kind, *fields))


# As KnowsWhatAnAbsoluteEncoderTells of the client in C.
client = towbench.Bench(None, towbench.LengthFraming(towbench.Counts()), towbench.Counts())
client.axes = {"y": towbench.Axis(), "x": towbench.Axis()}
takes(client, towbench.ADVANCED, 0)
assert client.counts.sequence_gaps == 0, "who tells nothing is not missed"
takes(client, towbench.ABSOLUTE_COUNT, 1, 1_000_000, -70_000, 0)
takes(client, towbench.ADVANCED, 1_000_000)
takes(client, towbench.ABSOLUTE_COUNT, 1, 2_000_000, 123_456, 1)
takes(client, towbench.ADVANCED, 2_000_000)
assert (client.axes["x"].absolute, client.axes["x"].absolute_at_start) == (123_456, -70_000), client.axes
assert client.axes["y"].absolute is None, client.axes
assert client.counts.sequence_gaps == 0, client.counts
takes(client, towbench.ADVANCED, 3_000_000)
assert client.counts.sequence_gaps == 1, "a turn without it"
takes(client, towbench.ABSOLUTE_COUNT, 1, 4_000_000, 123_456, 3)
takes(client, towbench.ADVANCED, 4_000_000)
assert client.counts.sequence_gaps == 2, "a gap in its sequence"
print(counted)
