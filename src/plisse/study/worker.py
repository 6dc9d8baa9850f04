"""A Dask worker with one thread: `python -m plisse.study.worker ADDRESS`; it ends with the process that started it."""

import os
import sys
import threading

__all__: list[str] = []


def main(address: str) -> None:
    """Serve a scheduler until it is gone, or whoever started this is."""
    threading.Thread(target=_end_with_parent, daemon=True).start()
    from plisse.study.isolated import prepare

    prepare()
    import asyncio
    import logging

    import dask
    from distributed import Worker

    from plisse.study.crew import UNWATCHED

    dask.config.set(UNWATCHED)

    logging.getLogger("distributed").setLevel(logging.CRITICAL)

    async def serve() -> None:
        async with Worker(address, nthreads=1, memory_limit=0, dashboard=False, host="127.0.0.1") as worker:
            await worker.finished()

    asyncio.run(serve())
    os._exit(0)


def _end_with_parent() -> None:
    while os.read(0, 1):
        pass
    os._exit(0)


if __name__ == "__main__":
    main(sys.argv[1])
