"""heatmap.py KIND STARTED PID: waits until the service shows a heatmap with numbers; says after how many seconds it did."""
import json, os, sys, time, urllib.parse, urllib.request

kind, started, service = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
ADDRESS = "http://127.0.0.1:8080"


def ask(path):
    with urllib.request.urlopen(f"{ADDRESS}{path}", timeout=10) as answer:
        return answer.read()


def wait(what, get):
    while time.time_ns() - started < 60e9:
        os.kill(service, 0)
        try:
            if (got := get()):
                return got
        except OSError:
            pass
        time.sleep(0.1)
    sys.exit(f"dist: {kind}: no {what} within a minute")


def measured_run():
    run = json.loads(ask("/api/v1/featured"))
    # The first picture is there before the run has ended.
    return run and any(result["n"] > 0 for result in run["results"]) and run


run = wait("heatmap", measured_run)
measured = [result for result in run["results"] if result["n"] > 0]
for result in measured:
    asked = urllib.parse.urlencode({"algorithm": result["algorithm"], "measure": "time", "statistic": "median"})
    values = json.loads(ask(f"/api/v1/runs/{run['id']}/heatmap?{asked}"))["values"]
    numbers = [value for value in values if isinstance(value, (int, float))]
    assert len(numbers) >= 10 and min(numbers) > 0, f"{result['algorithm']}: {len(numbers)} numbers"
assert b"<div id=\"app\">" in ask("/"), "the pages are missing"
print(f"dist: {kind}: {len(measured)} algorithms, {len(numbers)} vertices with a time, {(time.time_ns() - started) / 1e9:.1f} s from nothing to a heatmap")
