"""The wheel: the Python package of host/python with the files of a package beside its modules."""
import base64, hashlib, sys, time, tomllib, zipfile
from contents import ROOT

PYTHON = ROOT / "host/python"
MODULES = (".py", "py.typed")


def project():
    return tomllib.loads((PYTHON / "pyproject.toml").read_text())["project"]


def metadata(facts):
    """Name, version, extras and the README, as PyPI's tools read them (core metadata 2.1)."""
    lines = ["Metadata-Version: 2.1", f"Name: {facts['name']}", f"Version: {facts['version']}", f"Summary: {facts['description']}",
             f"License: {facts['license']}", f"Requires-Python: {facts['requires-python']}", "Description-Content-Type: text/markdown"]
    for extra, packages in facts["optional-dependencies"].items():
        lines.append(f"Provides-Extra: {extra}")
        lines += [requirement(package, extra) for package in packages]
    return "\n".join(lines) + "\n\n" + (PYTHON / "README.md").read_text()


def requirement(package, extra):
    name, _, condition = package.partition("; ")
    marker = f'extra == "{extra}"' + (f" and {condition}" if condition else "")
    return f"Requires-Dist: {name}; {marker}"


def modules():
    for path in sorted((PYTHON / "opencollbench").rglob("*")):
        if path.is_file() and path.name.endswith(MODULES):
            yield str(path.relative_to(PYTHON)), path.read_bytes(), False


def write(path, version, tag, files, stamp):
    facts = project()
    if facts["version"] != version:
        sys.exit(f"dist: host/python/pyproject.toml has version {facts['version']}, and Cargo.toml has {version}; make them equal")
    info = f"opencollbench-{version}.dist-info"
    inside = [(f"opencollbench/{name}", data, program) for name, data, program in files]
    inside += modules()
    inside += [(f"{info}/{name}", text.encode(), False) for name, text in [
        ("METADATA", metadata(facts)),
        ("WHEEL", f"Wheel-Version: 1.0\nGenerator: opencollbench\nRoot-Is-Purelib: false\nTag: {tag}\n"),
        ("entry_points.txt", "[console_scripts]\nocb = opencollbench.__main__:main\n")]]
    record = "".join(
        f"{name},sha256={base64.urlsafe_b64encode(hashlib.sha256(data).digest()).decode().rstrip('=')},{len(data)}\n"
        for name, data, _ in inside)
    inside.append((f"{info}/RECORD", f"{record}{info}/RECORD,,\n".encode(), False))
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as out:
        for name, data, program in inside:
            entry = zipfile.ZipInfo(name, time.gmtime(stamp)[:6])
            entry.compress_type, entry.create_system = zipfile.ZIP_DEFLATED, 3
            entry.external_attr = (0o100755 if program else 0o100644) << 16
            out.writestr(entry, data)
