"""What a package holds: the command, the runner, the advisor, our own plugins, the stock objects and all licences.

The wrappers of C++ libraries are not shipped: they need the libraries of the machine that built them."""
import json, os, pathlib, re, subprocess, sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
SYSTEM = {"libc.so.6", "libm.so.6", "libgcc_s.so.1", "libstdc++.so.6", "ld-linux-x86-64.so.2", "libpthread.so.0", "libdl.so.2"}
NEWEST_GLIBC = (2, 36)  # Debian 12


def output(*command):
    return subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout


def metadata():
    target = "x86_64-unknown-linux-gnu"
    return json.loads(output("cargo", "metadata", "--format-version=1", "--locked", f"--filter-platform={target}"))


def version(data):
    return next(p["version"] for p in data["packages"] if p["name"] == "ocb-cli")


def epoch():
    """The time that every file of a package carries, so that the same files give the same package."""
    return int(os.environ.get("SOURCE_DATE_EPOCH") or output("git", "log", "-1", "--format=%ct"))


def plugins(data):
    """The file of each plugin of the workspace."""
    for package in data["packages"]:
        if package["source"] is None and pathlib.Path(package["manifest_path"]).is_relative_to(ROOT / "plugins"):
            for target in package["targets"]:
                if "cdylib" in target["kind"]:
                    yield f"lib{target['name'].replace('-', '_')}.so"


def files(data):
    """Each file of a package: its place in the folder, where it lies now, and whether it is a program."""
    names = ["ocb", "ocb-runner", "ocb-advisor", *sorted(plugins(data))]
    found = [(name, BUILD / "release" / name, True) for name in names]
    stock = [f"{name}.{end}" for name in ("bunny", "dragon") for end in ("obj", "terms")]
    found += [(f"stock/{name}", BUILD / "stock" / name, False) for name in stock]
    found += [(name, ROOT / name, False) for name in ("LICENSE-APACHE", "LICENSE-MIT")]
    # The recorders for Python; those of C++ libraries contain code of their headers.
    record = BUILD / "release/record/python"
    recorders = [record / "sitecustomize.py", *sorted((record / "opencollbench_recorders").glob("*.py"))]
    found += [(str(path.relative_to(BUILD / "release")), path, False) for path in recorders]
    missing = [str(path) for _, path, _ in found if not path.is_file()]
    if missing:
        sys.exit(f"dist: not built: {', '.join(missing)}; run make build first")
    return found


def glibc(path):
    """The newest version of glibc that a program asks for, once its other libraries are known to be everywhere."""
    dynamic = output("objdump", "-p", str(path))
    foreign = set(re.findall(r"NEEDED\s+(\S+)", dynamic)) - SYSTEM
    if foreign:
        sys.exit(f"dist: {path.name} needs {', '.join(sorted(foreign))}, which a package does not bring")
    newest = max(tuple(map(int, v)) for v in re.findall(r"\bGLIBC_(\d+)\.(\d+)", dynamic))
    if newest > NEWEST_GLIBC:
        sys.exit(f"dist: {path.name} needs glibc {newest[0]}.{newest[1]}; build on Debian 12 or older")
    return newest
