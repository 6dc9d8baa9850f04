"""What the studio adds to viser's page: `page.css` for its looks, `page.js` for names of controls, keys and typing."""

import gzip
from importlib.resources import files

from plisse.draw.colours import BACKGROUND

__all__ = ["with_additions"]

STYLE = (files("plisse") / "studio" / "page.css").read_text(encoding="utf-8").replace("GROUND", BACKGROUND)
SCRIPT = (files("plisse") / "studio" / "page.js").read_text(encoding="utf-8")


def with_additions(body: bytes, encoding: str) -> bytes:
    """The bytes of a page, packed as `encoding` says (gzip or identity), with the studio's additions in its head."""
    page = gzip.decompress(body) if encoding == "gzip" else body
    head, end, rest = page.partition(b"</head>")
    page = head + f"<style>\n{STYLE}</style><script>\n{SCRIPT}</script>".encode() + end + rest if end else page
    return gzip.compress(page) if encoding == "gzip" else page
