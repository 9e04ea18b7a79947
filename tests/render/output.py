"""Pictures as files: AOVs, crops, metadata, animations. output.py MOONRENDER SCENES"""
import json
import os
import sys
import tempfile

from harness import Exr, Harness, bytes_of, files_in, png_pixels, png_size, write

harness = Harness(sys.argv[1])
check, run = harness.check, harness.run
bumpy = os.path.join(sys.argv[2], "bumpy.scene.lua")
small = ["--size=40x30", "--spp=4"]

with tempfile.TemporaryDirectory() as folder:
    exr, png = os.path.join(folder, "a.exr"), os.path.join(folder, "a.png")

    # AOVs under the names that other tools expect; radiance is not touched by them.
    run(bumpy, "-o", exr, *small)
    plain = Exr(exr)
    check(sorted(plain.kinds) == ["B", "G", "R"], f"channels: {plain.kinds}")
    run(bumpy, "-o", exr, *small, "--aov=all")
    image = Exr(exr)
    expected = ["B", "G", "N.X", "N.Y", "N.Z", "P.X", "P.Y", "P.Z", "R", "Z", "albedo.B", "albedo.G", "albedo.R",
                "faults", "id.material", "id.object", "sampleCount", "variance.B", "variance.G", "variance.R"]
    check(sorted(image.kinds) == expected, f"channels: {sorted(image.kinds)}")
    check(all(image.pixels()[c] == plain.pixels()[c] for c in "RGB"), "AOVs change the picture")
    check(set(image.channels["sampleCount"]) == {4}, "sample counts")
    names = json.loads(image.fact("objects"))
    seen = set(image.channels["id.object"])
    check(len(seen) > 1 and all(k == 0 or str(k) in names for k in seen), f"ids {seen} of {names}")
    lengths = [x * x + y * y + z * z for x, y, z in zip(*(image.channels["N." + c] for c in "XYZ"))]
    check(max(lengths) < 1.001 and max(lengths) > 0.99, "normals are not of unit length at most")
    run(bumpy, "-o", exr, *small, "--aov=id,depth")
    check(sorted(Exr(exr).kinds) == ["B", "G", "R", "Z", "id.material", "id.object"], "--aov=id,depth")
    run(bumpy, "-o", exr, *small, "--aov=depht", status=2, error="unknown 'depht'; did you mean 'depth'?")
    run(bumpy, "-o", png, *small, "--aov=depth", status=2, error="only EXR holds such channels")
    run(os.path.join(sys.argv[2], "faulty.scene.lua"), "-o", exr, *small, "--aov=faults", error="faulty.lua")
    check(max(Exr(exr).channels["faults"]) > 0, "the fault mask is empty")

    # A crop has the pixels of the whole, and EXR keeps its place.
    run(bumpy, "-o", exr, *small, "--crop=7,5,20,10")
    crop = Exr(exr)
    check(crop.window == (7, 5) and crop.full == (0, 0, 39, 29), f"windows {crop.window}, {crop.full}")
    for y in range(10):
        check(crop.channels["R"][y * 20:y * 20 + 20] == plain.channels["R"][(y + 5) * 40 + 7:(y + 5) * 40 + 27],
              f"row {y} of the crop")
    run(bumpy, "-o", png, *small, "--crop=7,5,20,10")
    check(png_size(png) == (20, 10), "size of a cropped PNG")

    # Metadata.
    run(bumpy, "-o", exr, *small, "--seed=7", "--clamp=5", "--exposure=1", "--tonemap=filmic")
    image = Exr(exr)
    for name, value in (("seed", "7"), ("samples", "4"), ("clamp", "5"), ("interrupted", "no"), ("scene", bumpy),
                        ("exposure", "1"), ("tonemap", "filmic"), ("integrator", "path")):
        check(image.fact(name) == value, f"{name}: {image.fact(name)}")
    check(float(image.fact("seconds")) > 0, "seconds")
    check(image.attributes["Software"].startswith(b"moonshade "), "Software")
    check(Exr(exr).fact("digest") is not None, "digest")

    # The digest follows the modules of shaders.
    module = write(os.path.join(folder, "tints.lua"), "return { red = rgb(1, 0, 0) }\n")
    write(os.path.join(folder, "tinted.lua"), 'local t = require "tints"\nfunction color(p) return t.red end\n')
    scene = write(os.path.join(folder, "s.lua"), 'sphere{ material = material{ shader = "tinted.lua" } }\n')
    digests = set()
    for text in ("", "-- another\n"):
        with open(module, "a") as file:
            file.write(text)
        run(scene, "-o", exr, *small)
        digests.add(Exr(exr).fact("digest"))
    check(len(digests) == 2, "a module is no part of the digest")

    # Tone mapping and exposure touch the encoded files alone.
    run(bumpy, "-o", exr, *small, "--exposure=2", "--tonemap=filmic")
    check(Exr(exr).pixels() == plain.pixels(), "exposure changes the EXR")
    run(bumpy, "-o", png, *small)
    before = png_pixels(png)
    run(bumpy, "-o", png, *small, "--exposure=1")
    check(png_pixels(png) != before, "exposure changes nothing")
    for name in os.listdir(folder):
        os.remove(os.path.join(folder, name))

    # Animation: the scene and its shaders see time and frame.
    write(os.path.join(folder, "glow.lua"),
          "function emission(p, time, frame)\n  return rgb(time, frame, 1)\nend\n")
    moving = write(os.path.join(folder, "moving.lua"), """
camera{ from = {0, 0, 4}, to = {0, 0, 0} }
assert(math.type(frame) == "integer")
sphere{ center = {time * 8, 0, 0}, radius = 0.5, material = material{ shader = "glow.lua", color = 0, ior = 1 } }
render{ width = 16, height = 8, samples = 1 }
""")
    frames = os.path.join(folder, "f.%03d.exr")
    run(moving, "-o", frames, "--frames=0-2", "--fps=10")
    check(files_in(folder) == ["f.000.exr", "f.001.exr", "f.002.exr", "glow.lua", "moving.lua"], files_in(folder))
    for frame in range(3):
        image = Exr(os.path.join(folder, f"f.{frame:03}.exr"))
        brightest = max(range(16 * 8), key=lambda k: image.channels["B"][k])
        check(image.fact("frame") == str(frame) and float(image.fact("time")) == frame / 10, "metadata of a frame")
        check(image.channels["B"][brightest] == 1, "the sphere is not seen")
        check(abs(image.channels["R"][brightest] - frame / 10) < 1e-6, "time in a shader")
        check(image.channels["G"][brightest] == frame, "frame in a shader")
    first, last = (Exr(os.path.join(folder, f"f.00{k}.exr")) for k in (0, 2))
    check(first.channels["B"] != last.channels["B"], "the sphere does not move")
    single = os.path.join(folder, "s.exr")
    run(moving, "-o", single, "--frames=2", "--fps=10")
    check(Exr(single).pixels() == last.pixels(), "a frame alone differs")

    # With --resume, frames that are done are not rendered again; others are.
    done = [bytes_of(os.path.join(folder, f"f.00{k}.exr")) for k in range(3)]
    os.remove(os.path.join(folder, "f.001.exr"))
    run(moving, "-o", frames, "--frames=0-2", "--fps=10", "--resume", error="frame 2 is done already")
    check(bytes_of(os.path.join(folder, "f.000.exr")) == done[0], "a frame that is done is rendered again")
    check(Exr(os.path.join(folder, "f.001.exr")).fact("frame") == "1", "a missing frame is not rendered")
    again = run(moving, "-o", frames, "--frames=0-2", "--fps=10", "--resume", "--seed=4")
    check("done already" not in again.stderr, "a frame of other options counts as done")

    run(moving, "-o", single, "--frames=0-2", status=2, error="the images need a place for their number")
    run(moving, "-o", frames, "--frames=5-2", status=2, error="the last frame comes before the first")
    for wrong in ("x", "1-", "1-2-3", "1.5", "99999999999"):
        run(moving, "-o", frames, f"--frames={wrong}", status=2, error="--frames: expected A or A-B")
    run(moving, "-o", frames, "--fps=10", status=2, error="--fps stands with --frames")
    run(moving, "-o", frames, "--frames=1", "--fps=0", status=2, error="--fps lies between")
    run(moving, "-o", os.path.join(folder, "n%d.png"), "--frames=-3--2")
    check({"n-3.png", "n-2.png"} <= set(os.listdir(folder)), "negative frames")
    run(moving, "-o", os.path.join(folder, "100%%-%2d.png"), "--frames=7")
    check("100%- 7.png" in os.listdir(folder), f"names: {files_in(folder)}")

harness.finish()
