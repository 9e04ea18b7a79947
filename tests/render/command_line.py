"""The command line of moonrender: exit statuses, messages, files. command_line.py MOONRENDER SCENES"""
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile

moonrender, scenes = sys.argv[1], sys.argv[2]
failures = 0


def check(condition, what):
    global failures
    if not condition:
        failures += 1
        print(f"FAILED: {what}")


def run(*args, status=0, error="", output=None):
    done = subprocess.run([moonrender, *args], capture_output=True, text=True, timeout=600)
    call = " ".join(args)
    check(done.returncode == status, f"{call}: exit {done.returncode}, expected {status}\n{done.stderr}")
    check(error in done.stderr, f"{call}: no '{error}' in: {done.stderr}")
    if output is None:
        check(done.stdout == "", f"{call}: standard output is not empty: {done.stdout[:200]}")
    else:
        check(output in done.stdout, f"{call}: no '{output}' on standard output: {done.stdout[:200]}")
    return done


def bytes_of(path):
    with open(path, "rb") as file:
        return file.read()


with tempfile.TemporaryDirectory() as folder:
    image = os.path.join(folder, "a.png")
    exr = os.path.join(folder, "a.exr")
    bumpy = os.path.join(scenes, "bumpy.scene.lua")
    small = ["--size=40x30", "--spp=2"]

    # Help and version are what was asked for: standard output, status 0.
    help_text = run("--help", output="Examples:").stdout
    for group in ("Output", "Rendering", "Shaders"):
        check(group in help_text, f"--help has no group {group}")
    run("--version", output="moonshade 0.1.0")

    # The reference of scenes is what the program says, and nothing else.
    reference = os.path.join(scenes, "..", "..", "..", "docs", "scene-reference.md")
    check(run("--help-scene", output="## camera").stdout == open(reference).read(),
          "docs/scene-reference.md is not what `moonrender --help-scene` prints")

    with open("/dev/full", "w") as full:
        for option in ("--help", "--version", "--help-scene"):
            done = subprocess.run([moonrender, option], stdout=full, stderr=subprocess.PIPE, text=True)
            check(done.returncode == 3 and "cannot write to standard output" in done.stderr, f"{option} to a full disk")

    # Calls at fault.
    run(status=2, error="no scene")
    run(bumpy, status=2, error="no output")
    run(bumpy, "-o", os.path.join(folder, "a.bmp"), status=2, error="the ending is none of")
    run(bumpy, "-o", image, "--sise=1x1", status=2, error="sise")
    run(bumpy, "-o", image, "--size=12", status=2, error="--size: expected WxH")
    run(bumpy, "-o", image, "--size=0x5", status=2, error="--size lies between")
    run(bumpy, "-o", image, "--size=99999999999x5", status=2, error="--size")
    run(bumpy, "-o", image, "--size=65536x65536", status=3, error="not enough memory")
    run(bumpy, "-o", image, "--clamp=-1", status=2, error="--clamp lies between 0 and 1e+30")
    run(bumpy, "-o", image, "--spp=0", status=2, error="--spp lies between")
    run(bumpy, "-o", image, "--spp=many", status=2, error="spp")
    run(bumpy, "-o", image, "--integrator=pth", status=2, error="did you mean 'path'?")
    run(bumpy, "-o", image, "--width=3", status=2, error="--width: expected")
    run(bumpy, "-o", image, "-D", "scale=2", status=2, error="expected MATERIAL.NAME=VALUE")
    run(bumpy, "-o", image, "--crop=0,0,4000,4000", status=2, error="--crop lies outside the image")
    run(bumpy, "-o", os.path.join(folder, "none/a.png"), status=3, error="No such file")
    run(bumpy, "-o", image, f"--stats={folder}/none/s.json", status=3, error="none/s.json: No such file")
    check(os.listdir(folder) == [], f"files are left: {os.listdir(folder)}")

    # Scenes at fault.
    run(os.path.join(scenes, "none.lua"), "-o", image, status=1, error="none.lua: error: No such file")
    run(os.path.join(scenes, "broken.scene.lua"), "-o", image, status=1, error="broken.lua:2:")
    run(bumpy, "-o", image, "-D", "bumpy.scale=100", status=1, error="scale")
    control = os.path.join(folder, "control.lua")
    with open(control, "w") as file:
        file.write("print('a', '\\27]0;title\\7') error('first\\nsecond\\27[31m' .. ('x'):rep(100000))\n")
    said = run(control, "-o", image, status=1, error="control.lua:1: error: first\\x0Asecond\\x1B[31mxxx").stderr
    check(f"{control}: warning: print: a\t\\x1B]0;title\\x07\n" in said, f"printed: {said[:200]}")
    check(len(said) < 10000, "an error of 100,000 characters is shown in whole")
    os.remove(control)
    far = os.path.join(folder, "far.lua")
    with open(far, "w") as file:
        file.write("sphere{ radius = 1e8, scale = 1e9 }\n")
    run(far, "-o", image, status=1, error="far.lua: error: the object 'sphere' lies too far out")
    os.remove(far)
    wrong = os.path.join(folder, "wrong.lua")
    with open(wrong, "w") as file:
        file.write("sphere{}\nlight{ type = 'sun', colour = 1 }\n")
    run(wrong, "-o", image, status=1, error="wrong.lua:2: error: light: unknown field 'colour'; did you mean 'color'?")
    os.remove(wrong)
    check(os.listdir(folder) == [], f"files are left: {os.listdir(folder)}")

    # Pictures: the same bits for any number of threads; another seed, another picture.
    run(bumpy, "-o", exr, *small, "--threads=1")
    first = bytes_of(exr)
    stats = os.path.join(folder, "stats.json")
    run(bumpy, "-o", image, *small, f"--stats={stats}")
    numbers = json.load(open(stats))
    for key in ("load", "compile", "render", "shade", "trace", "film"):
        check(numbers["seconds"][key] >= 0, f"stats: seconds.{key}")
    check(numbers["paths"] == 40 * 30 * 2, "stats: paths")
    for key in ("rays", "shading_points", "peak_memory_bytes", "threads", "width"):
        check(numbers[key] > 0, f"stats: {key}")
    check(numbers["faults"] == 0, "stats: faults")
    shot = bytes_of(image)
    run(bumpy, "-o", image, *small, "--threads=3", "--width=4")
    strip = lambda data: data[data.index(b"IDAT"):]  # the metadata hold the time
    check(strip(bytes_of(image)) == strip(shot), "threads and width change the picture")
    # Compiled code may be kept, quick at first, or have its parameters baked in: the picture is the same.
    cache = os.path.join(folder, "cache")
    for how in ([f"--cache-dir={cache}"], [f"--cache-dir={cache}"], ["--no-cache"], ["--bake", "--no-cache"],
                ["--cache-dir=/dev/null/none"]):
        run(bumpy, "-o", image, *small, *how)
        check(strip(bytes_of(image)) == strip(shot), f"{how} changes the picture")
    check(len(os.listdir(cache)) > 0, "nothing is in the cache")
    baked = ["-D", "bumpy.scale=5"]
    run(bumpy, "-o", image, *small, *baked)
    with_parameter = bytes_of(image)
    run(bumpy, "-o", image, *small, "--bake", *baked)
    check(strip(bytes_of(image)) == strip(with_parameter), "a baked parameter is another value")
    check(strip(with_parameter) != strip(shot), "the parameter changes nothing")
    shutil.rmtree(cache)
    run(bumpy, "-o", image, *small, "--seed=5")
    check(strip(bytes_of(image)) != strip(shot), "the seed changes nothing")
    link, pipe = os.path.join(folder, "link.png"), os.path.join(folder, "pipe")
    os.symlink(image, link)
    run(bumpy, "-o", link, *small)
    check(os.path.islink(link), "a link is replaced by the image")
    os.remove(link)
    os.mkfifo(pipe)
    reader = os.open(pipe, os.O_RDONLY | os.O_NONBLOCK)
    run(bumpy, "-o", image, *small, f"--stats={pipe}")
    check(b'"seconds"' in os.read(reader, 10000), "stats do not arrive in a pipe")
    os.close(reader)
    os.remove(pipe)
    if os.path.exists("/dev/full"):
        os.symlink("/dev/full", link)
        run(bumpy, "-o", image, *small, f"--stats={link}", status=3, error="No space left")
        run(bumpy, "-o", link, *small, status=3, error="is no regular file")
        os.remove(link)
    run(bumpy, "-o", image, *small, "--stats=-", output='"seconds"')
    run(os.path.join(scenes, "strange.obj"), "-o", os.path.join(folder, "a.jpg"), *small)
    # A parameter belongs to whichever of a material's shaders has it.
    model = os.path.join(scenes, "several.obj")
    run(model, "-o", os.path.join(folder, "a.jpg"), *small, "-D", "several.depth=0.1", "-D", "several.tint=1,0,0")
    run(model, "-o", image, *small, "-D", "several.dept=0.1", status=1, error="no parameter 'dept'")
    run(model, "-o", image, *small, "-D", "plain.depth=1", status=1, error="the material 'plain' has no shader")
    run(os.path.join(scenes, "faulty.scene.lua"), "-o", image, *small, error="faulty.lua:")
    run(bumpy, "-o", image, *small, "--time=0.001", "--spp=100000")
    check(sorted(os.listdir(folder)) == ["a.exr", "a.jpg", "a.png", "stats.json"], f"files: {os.listdir(folder)}")
    check(len(first) > 1000, "the EXR is empty")

    # Ctrl-C: a whole image of the passes done, status 130, nothing left over.
    os.remove(image)
    # The first line of progress says that passes are done, however busy the machine is.
    process = subprocess.Popen([moonrender, bumpy, "-o", image, "--spp=16000000"], stderr=subprocess.PIPE, text=True)
    message = process.stderr.readline()
    while " 0/16000000 samples" in message:
        message = process.stderr.readline()
    check("/16000000 samples" in message, f"progress: {message}")
    process.send_signal(signal.SIGINT)
    message = process.communicate(timeout=600)[1]
    check(process.returncode == 130, f"interrupted: exit {process.returncode}")
    check("interrupted; the image has" in message, f"interrupted: {message}")
    check(b"interrupted yes" in bytes_of(image), "the metadata do not say interrupted")
    check(sorted(os.listdir(folder)) == ["a.exr", "a.jpg", "a.png", "stats.json"], f"files: {os.listdir(folder)}")

    # While the scene is read there is nothing to save: the first signal ends the program.
    pipe = os.path.join(folder, "pipe.lua")
    os.mkfifo(pipe)
    for number in (signal.SIGINT, signal.SIGTERM):
        process = subprocess.Popen([moonrender, pipe, "-o", image], stderr=subprocess.PIPE, text=True)
        with open(pipe, "w") as writer:  # opened when it is being read
            writer.write("sphere{}\n")
            writer.flush()
            process.send_signal(number)
            message = process.communicate(timeout=60)[1]
        check(process.returncode == 130, f"signal {number} while reading: exit {process.returncode}: {message}")
    os.remove(pipe)
    check(sorted(os.listdir(folder)) == ["a.exr", "a.jpg", "a.png", "stats.json"], f"files: {os.listdir(folder)}")

print("ok" if failures == 0 else f"{failures} failures")
sys.exit(failures != 0)
