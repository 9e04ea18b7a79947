"""What the tests of moonrender's command line share: running it, and counting what is not as expected."""
import os
import struct
import subprocess
import sys
import zlib


class Harness:
    def __init__(self, program):
        self.program = program
        self.failures = 0

    def check(self, condition, what):
        if not condition:
            self.failures += 1
            print(f"FAILED: {what}")

    def run(self, *args, status=0, error="", output=None, **options):
        done = subprocess.run([self.program, *args], capture_output=True, text=True, timeout=600, **options)
        call = " ".join(args)
        self.check(done.returncode == status, f"{call}: exit {done.returncode}, expected {status}\n{done.stderr}")
        self.check(error in done.stderr, f"{call}: no '{error}' in: {done.stderr}")
        if output is None:
            self.check(done.stdout == "", f"{call}: standard output is not empty: {done.stdout[:200]}")
        else:
            self.check(output in done.stdout, f"{call}: no '{output}' on standard output: {done.stdout[:200]}")
        return done

    def finish(self):
        print("ok" if self.failures == 0 else f"{self.failures} failures")
        sys.exit(self.failures != 0)


def write(path, text):
    with open(path, "w") as file:
        file.write(text)
    return path


def bytes_of(path):
    with open(path, "rb") as file:
        return file.read()


class Exr:
    """As much of OpenEXR as the tests read: scan lines, ZIP or no compression, read by the published layout."""

    TYPES = {0: ("I", 4), 1: ("e", 2), 2: ("f", 4)}

    def __init__(self, path):
        data = bytes_of(path)
        assert data[:4] == b"\x76\x2f\x31\x01", "no EXR"
        at, self.attributes = 8, {}
        while data[at] != 0:
            name, at = self.text(data, at)
            kind, at = self.text(data, at)
            size, = struct.unpack_from("<i", data, at)
            self.attributes[name] = data[at + 4:at + 4 + size]
            at += 4 + size
        at += 1
        x0, y0, x1, y1 = struct.unpack("<4i", self.attributes["dataWindow"])
        self.window, self.width, self.height = (x0, y0), x1 - x0 + 1, y1 - y0 + 1
        self.full = struct.unpack("<4i", self.attributes["displayWindow"])
        self.kinds, where, listed = {}, 0, self.attributes["channels"]
        while listed[where] != 0:
            name, where = self.text(listed, where)
            self.kinds[name], = struct.unpack_from("<i", listed, where)
            where += 16
        self.channels = {name: [] for name in self.kinds}
        rows = {0: 1, 2: 1, 3: 16}[self.attributes["compression"][0]]
        count = (self.height + rows - 1) // rows
        for offset in struct.unpack_from(f"<{count}Q", data, at):
            y, size = struct.unpack_from("<ii", data, offset)
            self.block(data[offset + 8:offset + 8 + size], min(rows, self.height - (y - y0)))

    @staticmethod
    def text(data, at):
        end = data.index(b"\0", at)
        return data[at:end].decode(), end + 1

    def block(self, packed, rows):
        size = rows * self.width * sum(self.TYPES[kind][1] for kind in self.kinds.values())
        if len(packed) < size:
            packed = bytearray(zlib.decompress(packed))
            for k in range(1, len(packed)):
                packed[k] = (packed[k - 1] + packed[k] - 128) & 255
            half = (len(packed) + 1) // 2
            merged = bytearray(len(packed))
            merged[0::2], merged[1::2] = packed[:half], packed[half:]
            packed = bytes(merged)
        at = 0
        for _ in range(rows):
            for name, kind in self.kinds.items():
                letter, bytes_each = self.TYPES[kind]
                self.channels[name] += struct.unpack_from(f"<{self.width}{letter}", packed, at)
                at += self.width * bytes_each

    def fact(self, name):
        value = self.attributes.get("moonshade:" + name)
        return None if value is None else value.decode()

    def pixels(self):
        """All channels, to be compared: what differs from run to run stands in the attributes."""
        return {name: struct.pack(f"<{len(v)}{self.TYPES[self.kinds[name]][0]}", *v) for name, v in self.channels.items()}


def png_pixels(path):
    """The compressed pixels of a PNG."""
    data, at, found = bytes_of(path), 8, b""
    while at < len(data):
        size, kind = struct.unpack_from(">I4s", data, at)
        if kind == b"IDAT":
            found += data[at + 8:at + 8 + size]
        at += size + 12
    return found


def png_size(path):
    return struct.unpack_from(">II", bytes_of(path), 16)


def files_in(folder):
    return sorted(os.listdir(folder))
