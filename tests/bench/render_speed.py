#!/usr/bin/env python3
"""What rendering costs: rays and shaded points a second and each stage's share, on a scene of a million triangles and on the gallery;
compiled shaders against the interpreter, one thread against two, exact bump gradients against six differences, memory.

    python3 tests/bench/render_speed.py [--moonrender=build/bin/moonrender] [--spp=8] [--json=FILE] [--only=NAME]

Prints a Markdown table a part. Thread-seconds are those of the processor, so that shares hold on a busy machine; rates do not."""
import argparse
import glob
import json
import math
import os
import statistics
import subprocess
import sys
import tempfile
import time

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.join(HERE, '..', '..')

MILLION = '''camera {{ from = {{ 0, 1.5, 4 }}, to = {{ 0, 0.9, 0 }}, fov = 35 }}
render {{ width = {width}, height = {height}, samples = 8, depth = 6 }}
light {{ type = "sky" }}
light {{ type = "sun", direction = {{ 0.5, 1, 0.7 }}, color = 2 }}
plane {{ material = material {{ ior = 1, color = 0.5 }} }}
obj {{ file = "ball.obj", translate = {{ 0, 1, 0 }}, material = material {{ {material} }} }}
'''


def write_ball(path, triangles):
    """A displaced sphere as OBJ, of about so many triangles."""
    columns = int(math.sqrt(triangles))
    rows = columns // 2
    with open(path, 'w') as out:
        for j in range(rows + 1):
            theta = math.pi * j / rows
            y, r = math.cos(theta), math.sin(theta)
            out.writelines(
                'v %.6f %.6f %.6f\n' % ((r * math.cos(phi)) * h, y * h, (r * math.sin(phi)) * h)
                for phi, h in ((2 * math.pi * i / columns, 1 + 0.02 * math.sin(24 * math.pi * i / columns) * math.sin(12 * theta))
                               for i in range(columns)))
        for j in range(rows):
            for i in range(columns):
                a, b = j * columns + i + 1, j * columns + (i + 1) % columns + 1
                c, d = a + columns, b + columns
                out.write(f'f {a} {b} {d}\nf {a} {d} {c}\n')


class Bench:
    def __init__(self, options):
        self.options = options
        self.folder = tempfile.mkdtemp(prefix='moonshade-speed-')
        self.results = {}

    def write(self, name, text):
        path = os.path.join(self.folder, name)
        with open(path, 'w') as out:
            out.write(text)
        return path

    def run(self, scene, *more, threads=2, spp=None):
        stats = os.path.join(self.folder, 'stats.json')
        start = time.time()
        subprocess.run([self.options.moonrender, scene, f'--spp={spp or self.options.spp}', f'--threads={threads}', '-o',
                        os.path.join(self.folder, 'out.exr'), f'--stats={stats}', *more], check=True, stderr=subprocess.DEVNULL)
        with open(stats) as file:
            result = json.load(file)
        result['wall'] = time.time() - start
        return result

    def row(self, name, s):
        seconds = s['seconds']
        busy = seconds['trace'] + seconds['shade'] + seconds['film']
        shaders = seconds.get('shaders', 0)
        self.results[name] = s
        print(f'| {name} | {s["paths"] / seconds["render"] / 1e6:.2f} | {s["rays"] / seconds["render"] / 1e6:.2f} | '
              f'{s["shading_points"] / seconds["render"] / 1e6:.2f} | {100 * seconds["trace"] / busy:.0f} | '
              f'{100 * seconds["shade"] / busy:.0f} | {100 * seconds["film"] / busy:.0f} | {100 * shaders / busy:.0f} |', flush=True)

    def heading(self):
        print('\n| scene | paths, M/s | rays, M/s | points, M/s | trace, % | shade, % | film, % | within: shaders, % |\n|---|---|---|---|---|---|---|---|')

    def million(self):
        write_ball(os.path.join(self.folder, 'ball.obj'), 1_000_000)
        write_ball(os.path.join(self.folder, 'small.obj'), 2_000)
        scene = self.write('million.scene.lua', MILLION.format(width=1280, height=720, material='ior = 1, color = 0.6'))
        self.heading()
        s = self.run(scene)
        self.row('1 million triangles, 2 threads', s)
        one = self.run(scene, threads=1)
        self.row('the same, 1 thread', one)
        self.row('the same, default material', self.run(self.write(
            'coat.scene.lua', MILLION.format(width=1280, height=720, material='color = 0.6'))))
        small = self.run(self.write('small.scene.lua', MILLION.format(width=1280, height=720, material='ior = 1, color = 0.6')
                                    .replace('ball.obj', 'small.obj')))
        large = self.run(self.write('large.scene.lua', MILLION.format(width=2560, height=1440, material='ior = 1, color = 0.6')
                                    .replace('ball.obj', 'small.obj')), spp=1)
        memory = lambda a: a['peak_memory_bytes'] / 1e6
        print(f'\n2 threads : 1 thread {one["seconds"]["render"] / s["seconds"]["render"]:.2f}; '
              f'loading {s["seconds"]["load"]:.2f} s a million triangles; '
              f'memory: {memory(s) - memory(small):.0f} MB a million triangles, '
              f'{(memory(large) - memory(small)) / (2560 * 1440 - 1280 * 720) * 1e6:.0f} MB a megapixel')

    def gallery(self):
        self.heading()
        for scene in sorted(glob.glob(os.path.join(ROOT, 'shaders', '*.scene.lua'))):
            self.row(os.path.basename(scene)[:-len('.scene.lua')], self.run(scene, '--size=640x360'))
        glass = os.path.join(ROOT, 'shaders', 'glass.scene.lua')
        self.row('glass, by paths', self.run(glass, '--size=640x360', '--integrator=path'))

    def backends(self):
        print('\n| scene | jit, s | interp, s | ratio | of shaders alone |\n|---|---|---|---|---|')
        for name in ('copper', 'marble', 'planet'):
            scene = os.path.join(ROOT, 'shaders', name + '.scene.lua')
            jit, interp = (self.run(scene, '--size=320x180', f'--backend={b}', spp=4) for b in ('jit', 'interp'))
            self.results[name + ' jit'], self.results[name + ' interp'] = jit, interp
            a, b = jit['seconds'], interp['seconds']
            print(f'| {name} | {a["render"]:.2f} | {b["render"]:.2f} | {b["render"] / a["render"]:.1f} | '
                  f'{b["shaders"] / max(a["shaders"], 1e-9):.0f} |', flush=True)

    def bump(self):
        write_ball(os.path.join(self.folder, 'ball.obj'), 100_000)
        self.write('bump.lua', 'function height(p) return 0.01 * fbm(p * 8, 8) end\n')
        print('\n| bump of 8 octaves | shaders, thread-seconds | render, s |\n|---|---|---|')
        for mode in ('gradient', 'differences'):
            scene = self.write('bump.scene.lua', MILLION.format(
                width=1280, height=720, material=f'ior = 1, color = 0.6, shader = "bump.lua", bump = "{mode}"'))
            runs = [self.run(scene) for _ in range(3)]
            self.results['bump ' + mode] = runs
            print(f'| {mode} | {statistics.median(r["seconds"]["shaders"] for r in runs):.3f} | '
                  f'{statistics.median(r["seconds"]["render"] for r in runs):.2f} |', flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--moonrender', default=os.path.join(ROOT, 'build', 'bin', 'moonrender'))
    parser.add_argument('--spp', type=int, default=8)
    parser.add_argument('--json')
    parser.add_argument('--only', choices=('million', 'gallery', 'backends', 'bump'))
    options = parser.parse_args()
    bench = Bench(options)
    for part in ('million', 'gallery', 'backends', 'bump'):
        if options.only in (None, part):
            getattr(bench, part)()
    if options.json:
        with open(options.json, 'w') as file:
            json.dump(bench.results, file, indent=2)
    return 0


if __name__ == '__main__':
    sys.exit(main())
