"""Seeing a picture while it renders: tev's protocol, written anew here, and --preview. live.py MOONRENDER SCENES"""
import os
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import time

from harness import Exr, Harness, files_in, png_pixels, png_size


class Viewer:
    """As much of tev as receives pictures (its src/Ipc.cpp says the layout)."""

    def __init__(self, packets_before_hanging_up=None):
        self.server = socket.create_server(("127.0.0.1", 0))
        self.place = "127.0.0.1:%d" % self.server.getsockname()[1]
        self.images, self.updates, self.problems = {}, 0, []
        self.patience = packets_before_hanging_up
        self.thread = threading.Thread(target=self.serve, daemon=True)
        self.thread.start()

    def serve(self):
        connection, _ = self.server.accept()
        with connection:
            while head := self.take(connection, 4):
                size, = struct.unpack("<I", head)
                self.packet(self.take(connection, size - 4))
                if self.patience is not None:
                    self.patience -= 1
                    if self.patience <= 0:
                        return

    @staticmethod
    def take(connection, size):
        data = b""
        while len(data) < size:
            piece = connection.recv(size - len(data))
            if not piece:
                return b""
            data += piece
        return data

    def packet(self, data):
        self.data, self.at = data, 0
        kind, grab = self.numbers("BB")
        name = self.text()
        if kind == 4:  # CreateImage
            width, height, count = self.numbers("iii")
            channels = [self.text() for _ in range(count)]
            self.images[name] = (width, height, {c: [0.0] * (width * height) for c in channels})
        elif kind == 6:  # UpdateImage, third version
            count, = self.numbers("i")
            channels = [self.text() for _ in range(count)]
            x, y, width, height = self.numbers("iiii")
            offsets, strides = self.numbers(f"{count}q"), self.numbers(f"{count}q")
            values = self.numbers(f"{(len(data) - self.at) // 4}f")
            full_width, full_height, image = self.images[name]
            if (x, y, width, height) != (0, 0, full_width, full_height):
                self.problems.append("a part of the image only")
            for channel, offset, stride in zip(channels, offsets, strides):
                image[channel] = list(values[offset::stride])
            self.updates += 1
        else:
            self.problems.append(f"packet of kind {kind}")
        if self.at != len(data):
            self.problems.append(f"{len(data) - self.at} bytes too many")

    def numbers(self, format):
        values = struct.unpack_from("<" + format, self.data, self.at)
        self.at += struct.calcsize("<" + format)
        return values

    def text(self):
        end = self.data.index(b"\0", self.at)
        text, self.at = self.data[self.at:end].decode(), end + 1
        return text


harness = Harness(sys.argv[1])
check, run = harness.check, harness.run
bumpy = os.path.join(sys.argv[2], "bumpy.scene.lua")

with tempfile.TemporaryDirectory() as folder:
    image, preview = os.path.join(folder, "a.exr"), os.path.join(folder, "p.png")

    # The viewer has the picture of the file in the end.
    viewer = Viewer()
    run(bumpy, "-o", image, "--size=40x30", "--spp=64", f"--tev={viewer.place}")
    viewer.thread.join(timeout=60)
    check(not viewer.problems, f"tev: {viewer.problems}")
    check(list(viewer.images) == [image], f"tev: {list(viewer.images)}")
    width, height, channels = viewer.images[image]
    check((width, height) == (40, 30) and list(channels) == ["R", "G", "B"], "tev: another shape")
    written = Exr(image)
    check(all(tuple(channels[c]) == tuple(written.channels[c]) for c in "RGB"), "tev: another picture than the file")
    check(viewer.updates >= 2, f"tev: {viewer.updates} updates: the first pass is shown, and the last")
    # A viewer that goes away does not take the render with it.
    viewer = Viewer(packets_before_hanging_up=2)
    run(bumpy, "-o", image, "--size=400x300", "--spp=24", f"--tev={viewer.place}", error="the render goes on without it")
    check(Exr(image).fact("samples") == "24", "the render ended with the viewer")
    # Nor does one that takes nothing: sending gives up.
    deaf = socket.create_server(("127.0.0.1", 0))
    run(bumpy, "-o", image, "--size=1280x720", "--spp=1", "--depth=1", "--tev=127.0.0.1:%d" % deaf.getsockname()[1],
        error="does not take the picture; the render goes on without it")
    check(Exr(image).width == 1280, "the render ended with the viewer")
    deaf.close()
    # None there: said before the work. The usual place has port 14158.
    os.remove(image)
    run(bumpy, "-o", image, "--tev=127.0.0.1:1", status=3, error="--tev: tev at 127.0.0.1:1: Connection refused")
    try:
        socket.create_server(("127.0.0.1", 14158)).close()
        run("--tev", bumpy, "-o", image, status=3, error="tev at 127.0.0.1:14158: Connection refused")
    except OSError:
        pass  # someone's viewer is there
    check(files_in(folder) == [], f"files are left: {files_in(folder)}")

    # --preview: there while the render goes on, whole at any moment, and the final picture in the end.
    final = os.path.join(folder, "a.png")
    process = subprocess.Popen([sys.argv[1], bumpy, "-o", final, "--size=64x48", "--spp=1000000",
                                f"--preview={preview}"], stderr=subprocess.PIPE, text=True)
    seen, deadline = set(), time.monotonic() + 300
    while len(seen) < 2 and time.monotonic() < deadline:
        if os.path.exists(preview):
            seen.add(png_pixels(preview))
            check(png_size(preview) == (64, 48), "size of the preview")
        time.sleep(0.02)
    check(len(seen) == 2, "the preview is not refreshed")
    check(not os.path.exists(final), "the image is there before it is done")
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=600)
    check(process.returncode == 130, f"interrupted: exit {process.returncode}")
    check(png_pixels(preview) == png_pixels(final), "the last preview is not the picture")
    check(files_in(folder) == ["a.png", "p.png"], f"files: {files_in(folder)}")
    run(bumpy, "-o", final, "--preview=p.bmp", status=2, error="--preview=p.bmp: the ending is none of")
    run(bumpy, "-o", final, f"--preview={folder}/none/p.png", status=3, error="--preview: ")
    run(bumpy, "-o", final, f"--preview={final}", status=2, error="another file than the image")

    # Progress: samples, rays a second, time left; on a terminal a bar that is taken away again.
    process = subprocess.Popen([sys.argv[1], bumpy, "-o", final, "--size=64x48", "--spp=10000000"],
                               stderr=subprocess.PIPE, text=True)
    line = process.stderr.readline()
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=600)
    check(all(word in line for word in ("/10000000 samples", " M rays/s", " left")), f"progress: {line}")
    master, slave = os.openpty()
    process = subprocess.Popen([sys.argv[1], bumpy, "-o", final, "--size=64x48", "--spp=10000000", "--time=1"],
                               stderr=slave)
    os.close(slave)
    drawn = b""
    try:
        while piece := os.read(master, 65536):
            drawn += piece
    except OSError:
        pass  # the other end is closed
    process.wait(timeout=600)
    check(b"[#" in drawn and b"rays/s" in drawn, f"no bar: {drawn[:200]}")
    check(drawn.endswith(b"\r\x1b[K"), f"the bar stays: {drawn[-80:]}")

harness.finish()
