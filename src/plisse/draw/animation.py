"""The motion of a structure as an animated picture that goes to and fro."""

from pathlib import Path

import numpy as np

from plisse.draw import colours
from plisse.draw.camera import Camera
from plisse.draw.motion import designed_runs, motion_camera
from plisse.draw.render import Rendering, render
from plisse.draw.runs import Run
from plisse.draw.table import table
from plisse.structure.pleated import PleatedStructure
from plisse.transform.flex import Motion

__all__ = ["paletted", "write_gif"]

LARGEST = (720, 540)
MARGIN, RIM = 36, 4
SECONDS_ONE_WAY, BRIEFEST = 4.0, 0.03
PALETTE = 160
LINE_COLOURS = {"B": colours.EDGE, "M": colours.MOUNTAIN, "V": colours.VALLEY}


def write_gif(motion: Motion, path: str | Path) -> None:
    """Write the states as frames of an endless .gif, forwards and then back, all at one scale and from one side."""
    camera, runs = motion_camera(motion), designed_runs(motion)
    seen = camera.project(motion.vertices)[..., :2].reshape(-1, 2)
    low, extent = seen.min(axis=0), np.ptp(seen, axis=0)
    scale = float(((np.array(LARGEST) - 2 * MARGIN) / extent).min())
    width, height = np.ceil(extent * scale + 2 * MARGIN).astype(int).tolist()
    size = width, height
    states = motion.structures
    frames = paletted([_frame(state, camera, scale, low, size, runs) for state in states])
    frames = frames + frames[-2:0:-1]
    pause = max(BRIEFEST, SECONDS_ONE_WAY / max(1, len(states) - 1))
    frames[0].save(path, format="GIF", save_all=True, append_images=frames[1:], duration=round(1000 * pause), loop=0)


def _frame(structure: PleatedStructure, camera: Camera, scale: float, low: np.ndarray, size: tuple[int, int],
           runs: list[Run]):
    """One picture (PIL) of the structure; `low` is the corner of all states in the camera's plane."""
    from PIL import Image

    picture = render(structure, camera, scale, RIM)
    corner = np.round((picture.origin[:2] - low) * scale).astype(int) + MARGIN
    page = np.zeros((size[1], size[0], 4), np.float32)
    height, width = picture.image.shape[:2]
    part = page[corner[1]:corner[1] + height, corner[0]:corner[0] + width]
    part[:] = picture.image[:part.shape[0], :part.shape[1]]
    ground = table(size, page[..., 3], np.zeros(2), [])
    ground = np.asarray(Image.fromarray((255 * ground).astype(np.uint8)).resize(size, Image.Resampling.BICUBIC)) / 255
    blended = ground * (1 - page[..., 3:]) + page[..., :3] * page[..., 3:]
    image = Image.fromarray((255 * np.clip(blended[::-1], 0, 1)).astype(np.uint8))
    image.paste(*_inked(picture, structure, corner, size, runs))
    return image


def _inked(picture: Rendering, structure: PleatedStructure, corner: np.ndarray, size: tuple[int, int], runs: list[Run]):
    """The visible lines as an image, its place on the page, and its coverage: what PIL pastes."""
    from PIL import Image, ImageDraw

    fine = Image.new("RGBA", (2 * size[0], 2 * size[1]))
    pen = ImageDraw.Draw(fine)
    for run in runs:
        if run.letter in LINE_COLOURS:
            line = structure.vertices[np.append(run.vertices, run.vertices[0]) if run.closed else run.vertices]
            for stroke in picture.visible(line):
                x, y = 2 * (stroke + corner).T
                places = list(zip(x.tolist(), (2 * size[1] - y).tolist(), strict=True))
                pen.line(places, fill=LINE_COLOURS[run.letter], width=2)
    ink = fine.resize(size, Image.Resampling.BOX)
    return ink.convert("RGB"), (0, 0), ink.getchannel("A")


def paletted(images: list) -> list:
    """The pictures in one common palette, taken from some of them, so that colours do not flicker."""
    from PIL import Image

    some = images[::max(1, len(images) // 5)]
    wide = Image.new("RGB", (sum(image.width for image in some), some[0].height))
    left = 0
    for image in some:
        wide.paste(image, (left, 0))
        left += image.width
    palette = wide.quantize(PALETTE, method=Image.Quantize.MEDIANCUT)
    return [image.quantize(palette=palette, dither=Image.Dither.FLOYDSTEINBERG) for image in images]
