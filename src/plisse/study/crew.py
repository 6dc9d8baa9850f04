"""Who makes the designs: Dask workers started on this machine, or those of a scheduler that runs already."""

import asyncio
import logging
import re
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager, suppress
from time import monotonic

from plisse.errors import PlisseError
from plisse.extras import optional
from plisse.study.isolated import last_words, process_options

__all__ = ["Crew", "crew", "require_address"]

PURPOSE = "studies"
PATIENCE = 10.0  # seconds within which a worker that ends has not worked at all
FAILURES = 5
CONNECT_SECONDS, ANSWER_SECONDS, CLOSE_SECONDS = 5.0, 20.0, 2.0  # as long as a scheduler may take
SILENT_SECONDS = 5.0  # without workers, before it is said
COUNT_EVERY = 0.5  # seconds between looks at how many workers there are
LAST_PORT = 65535
ADDRESS = re.compile(r"((tcp|tls|ws|wss|ucx)://)?(\[[\da-fA-F:.]+\]|[\w.-]+):(?P<port>\d{1,5})")
NOISY = ("distributed", "distributed.client", "distributed.gc")  # each has a level of its own
# Dask looks at itself a hundred times a second, which costs a twentieth of a core per worker
UNWATCHED = {"distributed.worker.profile.enabled": False, "distributed.admin.tick.interval": "1s",
             "distributed.admin.system-monitor.interval": "5s"}


class Crew:
    """A Dask client; workers of our own are started again when they end."""

    def __init__(self, client, local_address: str | None = None, count: int = 0):
        self.client, self._address = client, local_address
        self._processes: list[subprocess.Popen] = []
        self._started: list[float] = []
        self._failures = [0] * count  # in a row, of each worker
        self._staffed = monotonic()  # when there were workers last
        self._counted, self._capacity = float("-inf"), 0
        self._errors = tempfile.TemporaryFile()  # noqa: SIM115  lives as long as the crew
        for _ in range(count):
            self._processes.append(self._worker())
            self._started.append(monotonic())

    @property
    def capacity(self) -> int:
        """How many designs can be made at the same time, as it was counted less than half a second ago."""
        if monotonic() - self._counted > COUNT_EVERY or not self._capacity:
            self._counted, self._capacity = monotonic(), sum(self.client.nthreads().values())
        return self._capacity

    def missing(self) -> str | None:
        """What to do where a scheduler has had no workers for some seconds, None where it has."""
        if self._processes or self.capacity:
            self._staffed = monotonic()
        if monotonic() - self._staffed < SILENT_SECONDS:
            return None
        return f"the scheduler has no workers yet: start `dask worker {self.client.scheduler.address}`"

    def tend(self) -> None:
        """Start workers again that have ended; raises PlisseError where they cannot even start."""
        for k, process in enumerate(self._processes):
            if process.poll() is None:
                continue
            self._failures[k] = self._failures[k] + 1 if monotonic() - self._started[k] < PATIENCE else 0
            if self._failures[k] >= FAILURES:
                said = last_words(self._errors)
                raise PlisseError(f"workers do not start on this machine{f' ({said})' if said else ''}; "
                                  "see whether `python -c 'import distributed'` works")
            _end(process)
            self._processes[k], self._started[k] = self._worker(), monotonic()

    def end(self) -> None:
        """End our own workers, and with them the processes in which they make designs."""
        for process in self._processes:
            _end(process)
        self._errors.close()

    def _worker(self) -> subprocess.Popen:
        command = [sys.executable, "-m", "plisse.study.worker", str(self._address)]
        return subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=self._errors,
                                **process_options())

    @contextmanager
    def reached(self, kept: str) -> Iterator[None]:
        """Raises PlisseError, with `kept` in it, where the scheduler goes away meanwhile."""
        address = self.client.scheduler.address
        try:
            yield
        except PlisseError:
            raise
        except Exception as error:  # a client that is closing raises whatever it stumbles over
            from distributed.comm import CommClosedError

            if self.client.status == "running" and not isinstance(error, CommClosedError):
                raise
            raise PlisseError(f"the scheduler at {address} is gone; {kept}, the same command goes on") from None


def _end(process: subprocess.Popen) -> None:
    process.kill()
    process.wait()
    assert process.stdin is not None
    process.stdin.close()


def require_address(scheduler: str) -> None:
    """Nothing; raises PlisseError where this is no address of a scheduler."""
    found = ADDRESS.fullmatch(scheduler)
    if found is None or int(found["port"]) > LAST_PORT:
        raise PlisseError(f"--scheduler is {scheduler!r}; give an address of the form tcp://host:port, for example "
                          "tcp://10.0.0.1:8786")


@contextmanager
def crew(scheduler: str | None = None, workers: int | None = None, *, designs: int = sys.maxsize) -> Iterator[Crew]:
    """Workers for a study: `workers` on this machine, one per core if not said, or those of a `scheduler` address.

    No more are started than there are `designs`.

    Raises MissingExtra without Dask, PlisseError where the scheduler does not answer or has no address.
    """
    if scheduler is not None:
        require_address(scheduler)
    distributed = optional("distributed", extra="sweep", purpose=PURPOSE)
    for name in NOISY:  # what matters is a row of the study
        logging.getLogger(name).setLevel(logging.CRITICAL + 1)
    if scheduler is None:
        with _local(distributed, workers, designs) as found:
            yield found
        return
    try:
        with ThreadPoolExecutor(1) as aside:  # a notebook has a loop of its own here
            aside.submit(asyncio.run, _asked(distributed, scheduler)).result()
        client = distributed.Client(scheduler, timeout=ANSWER_SECONDS, set_as_default=False)
    except (OSError, ValueError, TimeoutError) as error:
        met: BaseException = error
        while isinstance(met.__cause__, OSError):  # down to what the last attempt to connect has met
            met = met.__cause__
        reason = f"{type(met).__name__}: {met}".splitlines()[0].rstrip(": ")
        raise PlisseError(f"no Dask scheduler answers at {scheduler} ({reason}); start one with `dask scheduler`, or leave "
                          "--scheduler out to work on this machine") from None
    found = Crew(client)
    try:
        yield found
    finally:
        found.end()
        with suppress(OSError, TimeoutError):  # a scheduler that is gone need not be left
            client.close(timeout=CLOSE_SECONDS)


async def _asked(distributed, address: str) -> None:
    """Wait for a scheduler to say who it is; a client would wait forever for other servers."""
    async with asyncio.timeout(ANSWER_SECONDS), distributed.core.rpc(address, timeout=CONNECT_SECONDS) as server:
        await server.identity()


@contextmanager
def _local(distributed, workers: int | None, designs: int) -> Iterator[Crew]:
    import dask
    from dask.system import CPU_COUNT

    with dask.config.set(UNWATCHED):
        # designs whose worker dies come back to us at once, so that their attempts are counted
        cluster = distributed.LocalCluster(n_workers=0, threads_per_worker=1, dashboard_address=":0", protocol="tcp",
                                           silence_logs=logging.CRITICAL, scheduler_kwargs={"allowed_failures": 0})
    with cluster, distributed.Client(cluster, set_as_default=False) as client:
        found = Crew(client, cluster.scheduler_address, min(workers or CPU_COUNT, designs))
        try:
            yield found
        finally:
            found.end()
