#!/usr/bin/env python3
"""moonrender beside Mitsuba 3, on the same scene: a diffuse bunny on a checkered floor under a square light and a constant sky, 1280x720,
depth 6, one light and one BSDF sample a vertex, roulette from the same depth. In a virtual environment: pip install mitsuba numpy; then

    python tests/bench/peer_mitsuba.py MODEL.obj [--variant=llvm_ad_rgb] [--json=FILE]

MODEL.obj is the Stanford bunny. Mitsuba's LLVM variants need LLVM's library: DRJIT_LIBLLVM_PATH names it where it is not found.
Renders of both alternate; a repetition's ratio is that of its two renders. Rendering alone counts: neither loading nor compiling. Mitsuba
is measured with its default filter and compared with a box (which leaves a pixel its own samples); moonrender draws from a tent."""
import argparse
import json
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

HERE = os.path.dirname(os.path.abspath(__file__))
WIDTH, HEIGHT, DEPTH = 1280, 720, 6


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('model')
    parser.add_argument('--moonrender', default=os.path.join(HERE, '..', '..', 'build', 'bin', 'moonrender'))
    parser.add_argument('--variant', default='llvm_ad_rgb')
    parser.add_argument('--spp', type=int, default=16)
    parser.add_argument('--repetitions', type=int, default=3)
    parser.add_argument('--threads', type=int, default=2)
    parser.add_argument('--json')
    return parser.parse_args()


class Mitsuba:
    def __init__(self, mi, model, box):
        self.mi = mi
        T = mi.ScalarTransform4f
        film = {'type': 'hdrfilm', 'width': WIDTH, 'height': HEIGHT}
        if box:
            film['rfilter'] = {'type': 'box'}
        self.scene = mi.load_dict({
            'type': 'scene',
            'integrator': {'type': 'path', 'max_depth': DEPTH, 'rr_depth': 5},
            'sensor': {'type': 'perspective', 'fov': 40, 'film': film, 'sampler': {'type': 'independent'},
                       'to_world': T().look_at(origin=[0, 1.2, 4], target=[0, 0.8, 0], up=[0, 1, 0])},
            'sky': {'type': 'constant', 'radiance': {'type': 'rgb', 'value': [0.6, 0.7, 0.9]}},
            'light': {'type': 'rectangle', 'to_world': T().translate([0, 4, 0]).rotate([1, 0, 0], 90),
                      'emitter': {'type': 'area', 'radiance': {'type': 'rgb', 'value': [6, 6, 6]}}},
            'floor': {'type': 'rectangle', 'to_world': T().rotate([1, 0, 0], -90).scale([10, 10, 1]),
                      'bsdf': {'type': 'diffuse', 'reflectance': {'type': 'checkerboard', 'to_uv': T().scale([20, 20, 1])}}},
            'bunny': {'type': 'obj', 'filename': model, 'to_world': T().translate([0.1, -0.33, 0]).scale([10, 10, 10]),
                      'bsdf': {'type': 'diffuse', 'reflectance': {'type': 'rgb', 'value': [0.7, 0.4, 0.2]}}}})
        self.render(1, 0)  # compiles

    def render(self, spp, seed):
        import drjit as dr
        import numpy
        start = time.time()
        image = self.mi.render(self.scene, spp=spp, seed=seed)
        dr.eval(image)
        dr.sync_thread()
        return time.time() - start, numpy.array(image)[:, :, :3]


class Moonrender:
    def __init__(self, mi, program, folder, threads):
        self.mi, self.program, self.folder, self.threads = mi, program, folder, threads

    def render(self, scene, spp, seed):
        import numpy
        image, stats = os.path.join(self.folder, 'out.exr'), os.path.join(self.folder, 'stats.json')
        subprocess.run([self.program, os.path.join(self.folder, scene), f'--spp={spp}', f'--seed={seed}', f'--threads={self.threads}',
                        '-o', image, f'--stats={stats}'], check=True, stderr=subprocess.DEVNULL)
        with open(stats) as file:
            seconds = json.load(file)['seconds']['render']
        bitmap = self.mi.Bitmap(image).convert(self.mi.Bitmap.PixelFormat.RGB, self.mi.Struct.Type.Float32, False)
        return seconds, numpy.array(bitmap)


def variance(a, b):
    """Of a pixel, from two independent pictures, mean over the picture and the channels."""
    return float(((a - b) ** 2).mean() / 2)


def main():
    options = arguments()
    try:
        import mitsuba as mi
        import numpy  # noqa: F401
        mi.set_variant(options.variant)
    except (ImportError, AttributeError) as error:
        print(f'skipped: this Python has no Mitsuba with {options.variant} ({error}); pip install mitsuba numpy')
        return 0
    try:
        mi.set_thread_count(options.threads)
    except AttributeError:
        pass
    with tempfile.TemporaryDirectory() as folder:
        for name in os.listdir(os.path.join(HERE, 'peer')):
            shutil.copy(os.path.join(HERE, 'peer', name), folder)
        shutil.copy(options.model, os.path.join(folder, 'bunny.obj'))
        peer, ours = Mitsuba(mi, options.model, False), Moonrender(mi, options.moonrender, folder, options.threads)
        paths = WIDTH * HEIGHT * options.spp / 1e6
        rates = {'mitsuba': [], 'moonrender': [], 'noise': []}
        pictures = []
        for repetition in range(options.repetitions):
            rates['mitsuba'].append(paths / peer.render(options.spp, 100 + repetition)[0])
            seconds, picture = ours.render('bunny.scene.lua', options.spp, repetition)
            pictures.append(picture)
            rates['moonrender'].append(paths / seconds)
            rates['noise'].append(paths / ours.render('noise.scene.lua', options.spp, repetition)[0])
        box = Mitsuba(mi, options.model, True)
        peers = [box.render(options.spp, 200 + k)[1] for k in range(2)]
        if len(pictures) < 2:
            pictures.append(ours.render('bunny.scene.lua', options.spp, 1000)[1])
    result = {name + '_mpaths': values for name, values in rates.items()}
    ratio = [a / b for a, b in zip(rates['moonrender'], rates['mitsuba'])]
    noise = [a / b for a, b in zip(rates['noise'], rates['mitsuba'])]
    mean, mean_peer = (float(sum(p.mean() for p in group) / len(group)) for group in (pictures, peers))
    result.update(variant=options.variant, spp=options.spp, threads=options.threads, ratio=statistics.median(ratio),
                  noise_ratio=statistics.median(noise), mean_difference=mean / mean_peer - 1,
                  variance_ratio=variance(*pictures[:2]) / variance(*peers))
    for name, values in rates.items():
        print(f'{name:12} {statistics.median(values):6.2f} million paths/s  ({", ".join(f"{v:.2f}" for v in values)})')
    print(f'moonrender : {options.variant} {result["ratio"]:.2f}; with noise {result["noise_ratio"]:.2f}; '
          f'mean radiance {100 * result["mean_difference"]:+.2f} %; variance of a pixel {result["variance_ratio"]:.2f} times')
    if options.json:
        with open(options.json, 'w') as file:
            json.dump(result, file, indent=2)
    return 0


if __name__ == '__main__':
    sys.exit(main())
