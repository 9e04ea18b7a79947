"""Long renders lose nothing: checkpoints, kill -9, Ctrl-C, time budgets, full disks. long_renders.py MOONRENDER SCENES"""
import os
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time

from harness import Exr, Harness, bytes_of, files_in, write

harness = Harness(sys.argv[1])
check, run = harness.check, harness.run
scenes = sys.argv[2]


def limited(size):
    """In the child: no file may grow beyond this. Writing then fails as it does on a full disk."""
    return lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))


with tempfile.TemporaryDirectory() as folder:
    for name in ("bumpy.scene.lua", "bumpy.lua"):
        shutil.copy(os.path.join(scenes, name), folder)
    bumpy = os.path.join(folder, "bumpy.scene.lua")
    given = files_in(folder)
    whole, image = os.path.join(folder, "whole.exr"), os.path.join(folder, "a.exr")
    checkpoint = image + ".checkpoint"
    options = ["--size=160x120", "--spp=192", "--aov=all", "--noise=0.03"]

    # Killed at random moments, gone on with by other numbers of threads: the bits of an undisturbed render.
    start = time.monotonic()
    run(bumpy, "-o", whole, *options)
    seconds = time.monotonic() - start
    reference = Exr(whole)
    check(len(set(reference.channels["sampleCount"])) > 1, "adaptive sampling takes the same samples everywhere")
    rng = random.Random(1)
    kills = 0
    for attempt in range(60):
        process = subprocess.Popen([sys.argv[1], bumpy, "-o", image, *options, "--checkpoint=0", "--resume",
                                    f"--threads={attempt % 3 + 1}"], stderr=subprocess.DEVNULL)
        try:
            process.wait(timeout=seconds * rng.uniform(0.1, 0.6))
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
            kills += 1
            check(not os.path.exists(image), "a killed render leaves an image")
            continue
        check(process.returncode == 0, f"resumed: exit {process.returncode}")
        break
    check(kills >= 2 and os.path.exists(image), f"{kills} kills, {files_in(folder)}")
    check(Exr(image).pixels() == reference.pixels(), "the resumed render differs")
    # One killed within the milliseconds of writing its image leaves the temporary file, which nothing could remove.
    left = [name for name in files_in(folder) if not (name.startswith("a.exr.") and name.endswith(".exr"))]
    check(sorted(given + ["a.exr", "whole.exr"]) == left, f"files are left: {left}")

    # A checkpoint by Ctrl-C, and who may go on from it.
    def interrupt():
        process = subprocess.Popen([sys.argv[1], bumpy, "-o", image, "--size=64x48", "--spp=200000", "--checkpoint=0"],
                                   stderr=subprocess.PIPE, text=True)
        deadline = time.monotonic() + 300
        while not os.path.exists(checkpoint) and time.monotonic() < deadline:
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=600)
        check(process.returncode == 130, f"interrupted: exit {process.returncode}")

    os.remove(image)
    interrupt()
    check(Exr(image).fact("interrupted") == "yes", "an interrupted image does not say so")
    samples = int(Exr(image).fact("samples"))
    check(os.path.exists(checkpoint), "no checkpoint after Ctrl-C")
    go_on = [bumpy, "-o", image, "--size=64x48", "--spp=200000", "--resume"]
    run(*go_on, "--seed=5", status=1, error="the options (then seed=0; now seed=5)")
    run(*go_on, "--depth=3", status=1, error="the options (then depth=5; now depth=3)")
    run(*go_on, "-D", "bumpy.scale=3", status=1, error="now -D bumpy.scale=3")
    for name, part in (("bumpy.scene.lua", "scene"), ("bumpy.lua", "shaders")):
        path = os.path.join(folder, name)
        before = bytes_of(path)
        with open(path, "ab") as file:
            file.write(b"\n-- changed\n")
        run(*go_on, status=1, error=f"the checkpoint is another render's: the {part};")
        with open(path, "wb") as file:
            file.write(before)
    saved = bytes_of(checkpoint)
    with open(checkpoint, "r+b") as file:
        file.seek(len(saved) // 2)
        file.write(bytes([saved[len(saved) // 2] ^ 1]))
    run(*go_on, status=1, error="the checkpoint is damaged")
    with open(checkpoint, "wb") as file:
        file.write(saved)
    # A budget of time for what is left; the checkpoint stays, for the next time. Some is done however little there is.
    for budget in ("1e-9", "0.3"):
        run(*go_on, f"--time={budget}")
        before, samples = samples, int(Exr(image).fact("samples"))
        check(samples > before, f"--resume has not gone on in {budget} s")
    check(Exr(image).fact("interrupted") == "no", "a budget of time is no interruption")
    check(os.path.exists(checkpoint), "the checkpoint is gone though the render is not done")
    os.remove(checkpoint)

    # Ctrl-C ends an animation with the frame in hand; --resume goes on with that frame, then with the others.
    frames = ["-o", os.path.join(folder, "f%d.exr"), "--size=64x48", "--spp=300", "--frames=1-2"]
    process = subprocess.Popen([sys.argv[1], bumpy, *frames, "--checkpoint=0"], stderr=subprocess.DEVNULL)
    while not os.path.exists(os.path.join(folder, "f1.exr.checkpoint")):
        time.sleep(0.005)
    process.send_signal(signal.SIGINT)
    process.wait(timeout=600)
    names = [name for name in files_in(folder) if name.startswith("f")]
    check(process.returncode == 130 and names == ["f1.exr", "f1.exr.checkpoint"], f"{process.returncode}: {names}")
    run(bumpy, *frames, "--resume")
    resumed = [Exr(os.path.join(folder, f"f{k}.exr")) for k in (1, 2)]
    check([f.fact("interrupted") for f in resumed] == ["no", "no"], "frames are not finished")
    run(bumpy, *frames)
    check(all(Exr(os.path.join(folder, f"f{k + 1}.exr")).pixels() == resumed[k].pixels() for k in (0, 1)),
          "a resumed animation differs")

    # --time ends a render after whole passes: the picture is that of so many samples.
    run(bumpy, "-o", image, "--size=64x48", "--spp=1000000", "--time=0.2")
    samples = Exr(image).fact("samples")
    run(bumpy, "-o", whole, "--size=64x48", f"--spp={samples}")
    check(Exr(image).pixels() == Exr(whole).pixels(), "the picture of a time budget is not that of its samples")

    # Disks that are full, at once or later.
    os.remove(image)
    run(bumpy, "-o", image, "--size=40x30", "--spp=1", status=3, error="File too large", preexec_fn=limited(1024))
    check(not os.path.exists(image), "a full disk leaves an image")
    large = ["--size=200x150", "--spp=2", "--aov=all"]
    elsewhere = os.path.join(folder, "elsewhere")
    os.mkdir(elsewhere)
    environment = dict(os.environ, TMPDIR=elsewhere)
    done = run(bumpy, "-o", image, *large, status=3, error="a.exr: File too large", preexec_fn=limited(100000),
               env=environment)
    check(files_in(elsewhere) == [], f"a rescue that failed leaves {files_in(elsewhere)}")
    # While the image cannot be put in its place, the work is kept elsewhere.
    process = subprocess.Popen([sys.argv[1], bumpy, "-o", image, "--size=64x48", "--spp=200000", "--aov=depth",
                                "--checkpoint=0"], stderr=subprocess.PIPE, text=True, env=environment)
    while not os.path.exists(checkpoint):
        time.sleep(0.01)
    os.mkdir(image)
    process.send_signal(signal.SIGINT)
    message = process.communicate(timeout=600)[1]
    check(process.returncode == 3 and "the picture is kept as" in message, f"no rescue: {message}")
    check("the checkpoint is kept; --resume goes on from it" in message, f"no word of the checkpoint: {message}")
    kept = [name for name in files_in(elsewhere)]
    check(len(kept) == 1 and "Z" in Exr(os.path.join(elsewhere, kept[0])).kinds, f"kept: {kept}")
    os.rmdir(image)
    # A checkpoint that cannot be written is a warning: the render goes on.
    done = run(bumpy, "-o", image, "--size=160x120", "--spp=200", "--checkpoint=0", error="checkpoint: ",
               preexec_fn=limited(400000))
    check("the render goes on" in done.stderr and done.stderr.count("warning") == 1, done.stderr)
    check(os.path.exists(image), "no image")
    if os.path.exists(checkpoint):
        os.remove(checkpoint)
    # A real full disk, where one can be had.
    disk = os.path.join(folder, "disk")
    os.mkdir(disk)
    script = (f"mount -t tmpfs -o size=64k none {disk} && dd if=/dev/zero of={disk}/fill bs=1k 2>/dev/null; "
              f"'{sys.argv[1]}' '{bumpy}' -o {disk}/a.png --size=40x30 --spp=1")
    done = subprocess.run(["unshare", "-rm", "sh", "-c", script], capture_output=True, text=True)
    if "unshare" not in done.stderr and "mount" not in done.stderr:
        check(done.returncode == 3 and "No space left on device" in done.stderr, f"full disk: {done}")

    # What is out of range, or lies nowhere.
    for wrong in ("--noise=-1", "--noise=2", "--checkpoint=-1", "--time=-1"):
        run(bumpy, "-o", image, wrong, status=2, error=wrong.split("=")[0] + " lies between")
    run(bumpy, "-o", image, "--noise=some", status=2, error="--noise")
    run(bumpy, "-o", os.path.join(folder, "none/a.exr"), "--checkpoint=1", status=3, error="No such file")

harness.finish()
