"""The licence texts of everything that is linked or bundled, as one text; a dependency without a text ends it."""
import json, pathlib, re, sys
from contents import ROOT

TEXT = re.compile(r"(?i)^(licen[cs]e|copying|unlicense|notice|copyright|ofl|ufl)|license\.txt$")
BY_HAND = pathlib.Path(__file__).parent / "licences"


def linked(data):
    """The packages that what we ship depends on; macros and build scripts of theirs included where they are ordinary."""
    nodes = {node["id"]: node for node in data["resolve"]["nodes"]}
    shipped = [p["id"] for p in data["packages"] if p["source"] is None and "/tests/" not in p["manifest_path"]]
    seen, waiting = set(), shipped
    while waiting:
        one = waiting.pop()
        if one not in seen:
            seen.add(one)
            waiting += [d["pkg"] for d in nodes[one]["deps"] if any(k["kind"] is None for k in d["dep_kinds"])]
    return sorted((p for p in data["packages"] if p["id"] in seen and p["source"]), key=lambda p: (p["name"], p["version"]))


def found_in(folder):
    return [path for path in sorted(folder.rglob("*")) if path.is_file() and TEXT.search(path.name) and path.suffix != ".rs"]


def texts_of(name, licence, folder):
    """The files in the package; else the one kept here; else ours, where Apache-2.0 may be chosen."""
    by_hand = BY_HAND / f"{name}.txt"
    files = found_in(folder) or ([by_hand] if by_hand.is_file() else [])
    if not files and "Apache-2.0" in re.split(r" OR |/", licence or ""):
        files = [ROOT / "LICENSE-APACHE"]
    if not files:
        sys.exit(f"dist: {name} ({licence}) has no licence text; add it as host/dist/licences/{name}.txt")
    return [path.read_text(errors="replace").strip() for path in files]


def packages(data):
    for p in linked(data):
        yield f"{p['name']} {p['version']}", p["license"], texts_of(p["name"], p["license"], pathlib.Path(p["manifest_path"]).parent)
    pages = ROOT / "web/app"
    for place, p in sorted(json.loads((pages / "package-lock.json").read_text())["packages"].items()):
        if place and not p.get("dev") and not p.get("optional"):
            name = place.removeprefix("node_modules/")
            yield f"{name} {p['version']}", p.get("license"), texts_of(name, p.get("license"), pages / place)
    yield "The Rust standard library", "MIT OR Apache-2.0", [(ROOT / "LICENSE-APACHE").read_text().strip()]


def everything(data):
    """Each text once, below the packages that it belongs to."""
    belongs = {}
    for name, licence, texts in packages(data):
        for text in texts:
            belongs.setdefault(text, []).append(f"{name} ({licence})")
    parts = ["OpenCollBench is MIT OR Apache-2.0. It contains the following; the stock objects have their terms in stock/."]
    parts += ["\n".join(names) + "\n\n" + text for text, names in belongs.items()]
    return f"\n\n{'=' * 78}\n\n".join(parts) + "\n"
