"""What seconds were measured on, in words."""
import os
import platform


def describe():
    name, memory = platform.machine(), 0
    try:
        with open("/proc/cpuinfo") as file:
            name = next((line.split(":", 1)[1].strip() for line in file
                         if line.startswith("model name")), name)
        memory = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") / 2**30
    except OSError:
        pass
    return f"{name}, {len(os.sched_getaffinity(0))} cores, {memory:.0f} GiB"
