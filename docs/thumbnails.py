"""Pictures of the shipped designs for the studio's gallery: `python docs/thumbnails.py [NAME …]`, without names the missing.

Written into src/plisse/gallery/thumbnails; run it again for a design whose TOML was changed.
"""

import io
import sys
from pathlib import Path

from PIL import Image

import plisse
from plisse.draw.thumbnail import thumbnail
from plisse.shipped import shipped_design, shipped_names

PLACE = Path(__file__).parents[1] / "src" / "plisse" / "gallery" / "thumbnails"
COLOURS = 48


def main(names: list[str]) -> None:
    """Draw the named designs, or those that have no picture yet."""
    PLACE.mkdir(exist_ok=True)
    for name in names or [name for name in shipped_names() if not (PLACE / f"{name}.png").exists()]:
        result = plisse.design(shipped_design(name))
        if result.structure is None:
            print(f"{name} has no structure")
            continue
        picture = Image.open(io.BytesIO(thumbnail(result.structure)))
        picture.quantize(COLOURS, method=Image.Quantize.FASTOCTREE).save(PLACE / f"{name}.png", optimize=True)
        print(name, (PLACE / f"{name}.png").stat().st_size, flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
