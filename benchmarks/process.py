"""Seconds and peak memory of a command as one line of JSON: `python benchmarks/process.py COMMAND [ARGUMENT …]`.

A process of its own, because a child's peak memory counts from that of the process which starts it.
"""

import json
import os
import subprocess
import sys
import time

KILOBYTE = 1 if sys.platform == "darwin" else 1024  # what ru_maxrss is given in


def main(command: list[str]) -> None:
    """Run the command with its output thrown away and print the line."""
    begun = time.perf_counter()
    child = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(child.pid, 0)
    print(json.dumps({"cpu": usage.ru_utime + usage.ru_stime, "wall": time.perf_counter() - begun,
                      "peak_mb": usage.ru_maxrss * KILOBYTE / 2**20, "code": os.waitstatus_to_exitcode(status)}))


if __name__ == "__main__":
    main(sys.argv[1:])
