# SPDX-License-Identifier: GPL-2.0-or-later
"""Who waits for whom, of the timeline that `--trace` writes (trace.json, Chrome's trace events)."""
import json

MOST_SHOWN = 400  # tasks of the piece of the timeline that the page draws


def read_events(folder):
    try:
        return json.loads((folder / "trace.json").read_text())
    except (OSError, ValueError):
        return []


def of_trace(folder):
    """Of each rank: seconds of its tasks, of them waiting for the partner, the tasks that wait
    most, and a few steps from the middle of the run; None without a trace."""
    events = read_events(folder)
    if not events:
        return None
    sides = {e["pid"]: e["args"]["name"] for e in events if e["name"] == "process_name"}
    lanes = {}
    for event in events:
        if event["ph"] == "X":
            lanes.setdefault((event["pid"], event["tid"]), []).append(event)
    if not lanes:
        return None
    begin = min(e["ts"] for lane in lanes.values() for e in lane)
    end = max(e["ts"] + e["dur"] for lane in lanes.values() for e in lane)
    return {"seconds": (end - begin) / 1e6,
            "ranks": [rank(sides[pid], tid, lane) for (pid, tid), lane in sorted(lanes.items())],
            "piece": piece(sides, lanes)}


def rank(side, number, lane):
    waited, worked = {}, 0.0
    task = None
    for event in lane:  # a wait follows the task that it is part of
        if event["cat"] == "waiting":
            waited[task] = waited.get(task, 0.0) + event["dur"] / 1e6
        else:
            task = event["name"]
            worked += event["dur"] / 1e6
    most = sorted(waited.items(), key=lambda item: -item[1])[:3]
    return {"side": side, "rank": number, "tasks_s": worked, "waiting_s": sum(waited.values()),
            "most": most}


def piece(sides, lanes):
    """Lanes of [name, start, length (us), waits] from the middle of the run, over one span of
    time."""
    first = max(lane[len(lane) // 2]["ts"] for lane in lanes.values())
    longest = max(len(lane) for lane in lanes.values())
    whole = max(lane[-1]["ts"] for lane in lanes.values()) - min(
        lane[0]["ts"] for lane in lanes.values())
    span = whole * min(1.0, MOST_SHOWN / (2 * max(1, longest)))
    found = []
    for (pid, tid), lane in sorted(lanes.items()):
        shown = [[e["name"], round(e["ts"] - first, 1), round(e["dur"], 1),
                  e["cat"] == "waiting"] for e in lane
                 if e["ts"] + e["dur"] > first and e["ts"] < first + span]
        found.append({"lane": f"{sides[pid]} {tid}", "events": shown[:2 * MOST_SHOWN]})
    return {"span": span, "lanes": found}
