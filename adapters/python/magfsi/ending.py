# SPDX-License-Identifier: GPL-2.0-or-later
"""How commands that make many runs end: errors are one line and an exit code."""
import signal
import sys

EXIT_DONE, EXIT_ERROR, EXIT_INPUT = 0, 1, 2


def _end(*_):
    raise KeyboardInterrupt  # which ends the run under way, too


def ended_well(main, name, refusals):
    """Runs main; refusals: exceptions whose text is for who wrote the input."""
    signal.signal(signal.SIGTERM, _end)
    try:
        main()
    except refusals as error:
        print(error, file=sys.stderr)
        sys.exit(EXIT_INPUT)
    except KeyboardInterrupt:
        print(f"{name}: interrupted; the same command goes on", file=sys.stderr)
        sys.exit(EXIT_ERROR)
    except OSError as error:
        print(f"{name}: {error}", file=sys.stderr)
        sys.exit(EXIT_ERROR)
