"""`plisse studio`: designing in the browser."""

from __future__ import annotations

from pathlib import Path

from plisse.cli.limits import Threads, bound

__all__ = ["studio"]

FIRST = "fig01d"


def studio(
    design: str = FIRST,
    /,
    *,
    host: str = "127.0.0.1",
    port: int = 8080,
    browser: bool = True,
    threads: Threads = None,
) -> int:
    """Design exact pleats in the browser: pull a curve, move a slider, see the folded sheet follow.

    Works without network. Every browser tab has a design of its own.

    Parameters
    ----------
    design
        A design file (TOML) or a name that `plisse gallery` lists, to start with.
    host
        The interface to serve on. By default only this machine reaches the studio; for any other a token is needed, which
        is part of the address that is printed.
    port
        The port to serve on, or the next free one.
    browser
        Open the browser.
    """
    bound(threads)
    import secrets
    import webbrowser

    from plisse.errors import PlisseError
    from plisse.extras import optional
    from plisse.io.designs import read_design
    from plisse.shipped import find_design
    from plisse.studio.gate import Gate, is_loopback

    if not 0 <= port <= 65535:
        raise PlisseError(f"--port {port} is no port; give a number from 1 to 65535, or 0 for any free one")
    optional("viser", extra="studio", purpose="designs in a browser")
    path = find_design(design)
    recipe = read_design(path)
    from plisse.studio.server import Studio

    gate = Gate(host, None if is_loopback(host) else secrets.token_urlsafe(24))
    running = Studio(recipe, Path(path).stem, gate, port)
    shown = "localhost" if host in ("127.0.0.1", "::1", "0.0.0.0", "::") else host
    address = f"http://{shown}:{running.port}/" + (f"?token={gate.token}" if gate.token else "")
    if gate.token:
        print(f"plisse studio is reachable from other machines on {host}; whoever has this address can use it:")
    print(f"{address}\nCtrl-C ends it", flush=True)
    if browser:
        webbrowser.open(address)
    try:
        running.wait()
    except KeyboardInterrupt:
        print()
    finally:
        running.close()
    return 0
