"""What has to hold of the Debian package where systemd runs its units. As root, in the virtual machine of systemd.sh."""
import contextlib, json, pathlib, pwd, subprocess, time, traceback, urllib.request
from http.cookiejar import CookieJar

SERVICE, WORK = "opencollbench.service", "opencollbench-work.service"
UNITS = pathlib.Path("/usr/lib/systemd/system")
GROUPS = pathlib.Path("/sys/fs/cgroup/system.slice")
DATA = "/var/lib/opencollbench"
ADDRESS = "http://127.0.0.1:8080/api/v1"
SPEC = {
    "object_a": "stock:torus-knot@2000", "query": "proximity", "passes": 1, "budget_seconds": 2.0,
    "method": {"kind": "sphere", "sampling": {"kind": "count", "count": 300}}, "algorithms": ["brute-force", "box-tree"],
}
visitor = urllib.request.build_opener(urllib.request.HTTPCookieProcessor(CookieJar()))


def said(*command):
    """What a command prints that has to succeed."""
    done = subprocess.run(command, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    assert done.returncode == 0, f"{' '.join(command)}: exit code {done.returncode}: {done.stdout}"
    return done.stdout.strip()


def wait(what, get, seconds=300):
    """Until `get` gives something; a service that does not answer yet gives nothing."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        with contextlib.suppress(OSError):
            if found := get():
                return found
        time.sleep(0.1)
    journal = said("journalctl", "--no-pager", "--lines=40", "--output=cat", "--unit=opencollbench*")
    raise AssertionError(f"waited in vain until {what}: {journal}")


def api(path, body=None):
    """An answer of the service to a visitor, who sends this."""
    data = body and json.dumps(body).encode()
    request = urllib.request.Request(f"{ADDRESS}{path}", data, {"Content-Type": "application/json"} if data else {})
    with visitor.open(request, timeout=10) as answer:
        return json.loads(answer.read())


def property_of(unit, name):
    return said("systemctl", "show", "--value", f"--property={name}", unit)


def runners(unit=SERVICE):
    """The groups of its jails in which something runs."""
    groups = (GROUPS / unit).glob("**/ocb-jail-*")
    return [group for group in groups if (group / "cgroup.procs").read_text()]


def submit():
    return wait("a run is accepted", lambda: api("/runs", SPEC))["id"]


def measured(run, unit=SERVICE):
    wait("it is measured", lambda: api(f"/runs/{run}")["state"] == "running" and runners(unit))


def ended(run):
    """The run at its end, which has to be a good one."""
    run = wait(f"the run {run} has ended", lambda: (it := api(f"/runs/{run}"))["state"] not in ("queued", "running") and it)
    wrong = [(result["algorithm"], result["n"], result["wrong"]) for result in run["results"]]
    assert run["state"] == "done" and len(wrong) == 2 and all(n > 0 and not bad for _, n, bad in wrong), (run["state"], wrong)
    return run


def left():
    """Command lines of processes of the service's user."""
    user, found = pwd.getpwnam("opencollbench").pw_uid, []
    for process in pathlib.Path("/proc").glob("[0-9]*"):
        with contextlib.suppress(OSError):
            if process.stat().st_uid == user:
                found.append((process / "cmdline").read_bytes())
    return found


def once(command, changes=""):
    """Runs a command with all settings of the service's unit but for these; its exit code and what it printed."""
    unit = (UNITS / SERVICE).read_text()
    start = next(line for line in unit.splitlines() if line.startswith("ExecStart="))
    own = f"Type=oneshot\nRestart=no\nStandardOutput=file:/run/once\nStandardError=inherit\n{changes}\n[Install]"
    unit = unit.replace(start, f"ExecStart={command}").replace("[Install]", own)
    pathlib.Path("/run/systemd/system/once.service").write_text(unit)
    pathlib.Path("/run/once").write_text("")
    said("systemctl", "daemon-reload")
    subprocess.run(["systemctl", "start", "once"], stderr=subprocess.DEVNULL)
    return int(property_of("once", "ExecMainStatus")), pathlib.Path("/run/once").read_text()


def the_package_is_installed_and_its_units_have_no_mistake():
    said("dpkg", "--install", "/srv/opencollbench.deb")
    for unit in (SERVICE, WORK):
        # It names settings that it does not know.
        assert said("systemd-analyze", "verify", str(UNITS / unit)) == ""


def the_service_starts_as_an_ordinary_user_without_rights():
    said("systemctl", "start", SERVICE)
    wait("it serves", lambda: api("/status"))
    status = pathlib.Path("/proc", property_of(SERVICE, "MainPID"), "status").read_text()
    about = dict(line.split(":\t", 1) for line in status.splitlines() if ":\t" in line)
    user = str(pwd.getpwnam("opencollbench").pw_uid)
    assert about["Uid"].split() == [user] * 4 and user != "0", about["Uid"]
    assert about["NoNewPrivs"] == "1" and int(about["CapBnd"], 16) == int(about["CapEff"], 16) == 0, about


def the_first_picture_comes_and_a_run_is_measured_in_groups_of_the_unit():
    wait("an example is measured", lambda: any(it["n"] for it in (api("/featured") or {"results": []})["results"]), 600)
    run = submit()
    measured(run)
    group = wait("a jail is there", runners)[0]
    limits = [(group / name).read_text().strip() for name in ("memory.max", "pids.max")]
    assert all(limit.isdigit() for limit in limits), limits
    run = ended(run)
    jail = run["environment"]["jail"]
    assert any("(v2), its processes counted" in layer for layer in jail), jail
    assert not [layer for layer in jail if "NO " in layer] and run["environment"]["profile"] == "production", run["environment"]
    print(f"systemd: {', '.join(jail)}; limits {limits}")


def a_killed_service_is_started_again_and_loses_no_run():
    run = submit()
    measured(run)
    before = property_of(SERVICE, "MainPID")
    said("systemctl", "kill", "--kill-whom=main", "--signal=KILL", SERVICE)
    wait("it is started again", lambda: property_of(SERVICE, "MainPID") not in (before, "0"))
    assert ended(run)["attempts"] == 2, "the lost attempt counts"


def stopped_in_the_middle_it_leaves_nothing_and_goes_on_later():
    run = submit()
    measured(run)
    started = time.monotonic()
    said("systemctl", "stop", SERVICE)
    took = time.monotonic() - started
    assert property_of(SERVICE, "Result") == "success" and took < 30, (property_of(SERVICE, "Result"), took)
    assert not left() and not (GROUPS / SERVICE).exists(), left()
    said("systemctl", "start", SERVICE)
    assert ended(run)["attempts"] == 1
    said("systemctl", "stop", SERVICE)
    print(f"systemd: it stops in {took:.1f} s in the middle of a run")


def every_layer_of_the_jail_is_there_and_what_a_worse_unit_lacks_is_said():
    yes = "third-party plugins with --profile production: yes"
    code, report = once("/opt/opencollbench/ocb doctor")
    assert code == 0 and yes in report and "MISSING" not in report, report
    for changes, lacks in [("Delegate=no", "memory group"), ("RestrictNamespaces=yes", "user namespaces")]:
        code, report = once("/opt/opencollbench/ocb doctor", changes)
        told = next((line for line in report.splitlines() if line.startswith(f"MISSING  {lacks}: ")), "")
        assert code != 0 and yes not in report and "; to get it: " in told, report
        assert changes != "Delegate=no" or "a unit with Delegate=yes" in told, told


PROBE = """
import ctypes, json, os, socket
def error(call, *given):
    try:
        call(*given)
    except OSError as problem:
        return problem.errno
here = "/sys/fs/cgroup" + open("/proc/self/cgroup").read().split(":")[2].strip()
def personality(which):
    library = ctypes.CDLL(None, use_errno=True)
    if library.personality(which) < 0:
        raise OSError(ctypes.get_errno(), "personality")
open("/var/lib/opencollbench/probe", "w").close()
found = {
    "system": [error(open, f"{folder}/probe", "w") for folder in ("/usr", "/etc", "/opt/opencollbench", "/srv", "/var/log")],
    "home": error(os.listdir, "/root"),
    "devices": [name for name in ("vda", "kmsg", "mem") if os.path.exists(f"/dev/{name}")],
    "tmp": os.listdir("/tmp"),
    "lock": error(open, "/run/lock/probe", "w"),
    "packet": error(socket.socket, socket.AF_PACKET, socket.SOCK_RAW),
    "personality": error(personality, 8),
    "set-user-id": error(os.chmod, "/var/lib/opencollbench/probe", 0o4700),
    "mode": oct(os.stat("/var/lib/opencollbench/probe").st_mode & 0o777),
    "tunables": error(open, "/proc/sys/kernel/hostname", "w"),
    "group": error(os.mkdir, here + "/probe"),
}
print(json.dumps(found))
"""


def the_settings_of_the_unit_hold():
    pathlib.Path("/srv/probe.py").write_text(PROBE)
    pathlib.Path("/tmp/of-somebody-else").write_text("")
    code, found = once("/usr/bin/python3 /srv/probe.py")
    read_only, refused, no_access, no_family = 30, 1, 13, 97
    wanted = {
        "system": [read_only] * 5, "home": no_access, "devices": [], "tmp": [], "lock": None, "packet": no_family,
        "personality": refused, "set-user-id": refused, "mode": "0o600", "tunables": read_only, "group": None,
    }
    assert code == 0, found
    found = json.loads(found)
    assert found == wanted, {name: (found[name], wanted[name]) for name in wanted if found[name] != wanted[name]}


def a_measuring_machine_measures_and_puts_back_what_it_has_when_it_is_stopped():
    ocb = ["runuser", "-u", "opencollbench", "--", "/opt/opencollbench/ocb"]
    token = subprocess.run([*ocb, "admin", "machine", "alpha", "--data", DATA], text=True, check=True, stdout=subprocess.PIPE).stdout
    folder = pathlib.Path("/etc/opencollbench")
    folder.mkdir()
    (folder / "work").write_text("OCB_INTERNAL_SERVER=http://127.0.0.1:9091\n")
    (folder / "token").touch(0o600)
    (folder / "token").write_text(token)
    drop_in = pathlib.Path(f"/etc/systemd/system/{SERVICE}.d/internal.conf")
    drop_in.parent.mkdir()
    start = next(line for line in (UNITS / SERVICE).read_text().splitlines() if line.startswith("ExecStart="))
    drop_in.write_text(f"[Service]\nExecStart=\n{start} --internal 127.0.0.1:9091\n")
    said("systemctl", "daemon-reload")
    said("systemctl", "start", SERVICE, WORK)
    run = submit()
    measured(run, WORK)
    assert not runners(SERVICE)
    said("systemctl", "stop", WORK)
    assert not (GROUPS / WORK).exists()
    wait("it waits again", lambda: api(f"/runs/{run}")["state"] == "queued", 5)
    said("systemctl", "start", WORK)
    assert ended(run)["attempts"] == 1


def removing_the_package_stops_both_and_leaves_the_data():
    assert property_of(SERVICE, "ActiveState") == property_of(WORK, "ActiveState") == "active"
    said("dpkg", "--remove", "opencollbench")
    assert not left() and not pathlib.Path("/opt/opencollbench").exists()
    assert (pathlib.Path(DATA) / "opencollbench.sqlite").exists()


for check in [
    the_package_is_installed_and_its_units_have_no_mistake,
    the_service_starts_as_an_ordinary_user_without_rights,
    the_first_picture_comes_and_a_run_is_measured_in_groups_of_the_unit,
    a_killed_service_is_started_again_and_loses_no_run,
    stopped_in_the_middle_it_leaves_nothing_and_goes_on_later,
    every_layer_of_the_jail_is_there_and_what_a_worse_unit_lacks_is_said,
    the_settings_of_the_unit_hold,
    a_measuring_machine_measures_and_puts_back_what_it_has_when_it_is_stopped,
    removing_the_package_stops_both_and_leaves_the_data,
]:
    try:
        check()
        print(f"{check.__name__}: ok\ntest result: ok. 1 passed; 0 failed")
    except Exception:
        print(f"{traceback.format_exc()}{check.__name__}: FAILED\ntest result: FAILED. 0 passed; 1 failed")
print("systemd: all checks were made")
