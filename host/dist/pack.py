#!/usr/bin/env python3
"""pack.py FOLDER: writes an archive, a wheel and a Debian package of what was built. The same files give the same bytes."""
import gzip, hashlib, io, os, pathlib, shutil, subprocess, sys, tarfile, tempfile
import contents, licences, wheel

HERE = pathlib.Path(__file__).parent
CONTROL = '''Package: opencollbench
Version: {version}
Architecture: amd64
Maintainer: The OpenCollBench developers <opencollbench@localhost>
Depends: libc6 (>= {glibc}), libgcc-s1, libstdc++6, systemd
Recommends: ca-certificates, libgomp1
Section: science
Priority: optional
Description: benchmarks of collision detection, mapped onto the object
 The service `ocb serve`, the command `ocb`, and the plugins built from its sources.
'''
POSTINST = '''#!/bin/sh
set -e
systemd-sysusers opencollbench.conf
if [ -d /run/systemd/system ]; then systemctl daemon-reload; fi
'''

PRERM = '''#!/bin/sh
set -e
if [ "$1" = remove ] && [ -d /run/systemd/system ]; then systemctl stop opencollbench opencollbench-work; fi
'''


def archive(path, folder, files, stamp):
    with open(path, "wb") as raw, gzip.GzipFile("", "wb", 6, raw, stamp) as packed, tarfile.open(fileobj=packed, mode="w") as tar:
        for name, data, program in files:
            entry = tarfile.TarInfo(f"{folder}/{name}")
            entry.size, entry.mtime, entry.mode = len(data), stamp, 0o755 if program else 0o644
            tar.addfile(entry, io.BytesIO(data))


def deb(path, version, glibc, files, stamp):
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder) / "root"
        units = ["opencollbench.service", "opencollbench-work.service"]
        user = b'u opencollbench - "OpenCollBench" /var/lib/opencollbench\n'
        control = CONTROL.format(version=version, glibc=".".join(map(str, glibc))).encode()
        copyright = next(data for name, data, _ in files if name == "LICENCES.txt")
        for name, data, program in [
            *((f"opt/opencollbench/{name}", data, program) for name, data, program in files),
            *((f"usr/lib/systemd/system/{unit}", (HERE.parent / unit).read_bytes(), False) for unit in units),
            ("usr/lib/sysusers.d/opencollbench.conf", user, False),
            ("usr/share/doc/opencollbench/copyright", copyright, False),
            ("DEBIAN/control", control, False), ("DEBIAN/postinst", POSTINST.encode(), True),
            ("DEBIAN/prerm", PRERM.encode(), True),
        ]:
            file = root / name
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_bytes(data)
            file.chmod(0o755 if program else 0o644)
        (root / "usr/bin").mkdir()
        (root / "usr/bin/ocb").symlink_to("/opt/opencollbench/ocb")
        for each in [root, *root.rglob("*")]:
            if each.is_dir():
                each.chmod(0o755)
        subprocess.run(["dpkg-deb", "--root-owner-group", "-Zgzip", "-z6", "--build", root, path], check=True,
                       stdout=subprocess.DEVNULL, env={**os.environ, "SOURCE_DATE_EPOCH": str(stamp)})


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: pack.py FOLDER")
    out = pathlib.Path(sys.argv[1])
    data = contents.metadata()
    found = contents.files(data)
    glibc = max(contents.glibc(path) for _, path, program in found if program)
    files = sorted([(name, path.read_bytes(), program) for name, path, program in found]
                   + [("LICENCES.txt", licences.everything(data).encode(), False)])
    version, stamp = contents.version(data), contents.epoch()
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir(parents=True)
    tag = f"py3-none-manylinux_{glibc[0]}_{glibc[1]}_x86_64"
    name = f"opencollbench-{version}-x86_64-linux"
    archive(out / f"{name}.tar.gz", name, files, stamp)
    wheel.write(out / f"opencollbench-{version}-{tag}.whl", version, tag, files, stamp)
    if shutil.which("dpkg-deb"):
        deb(out / f"opencollbench_{version}_amd64.deb", version, glibc, files, stamp)
    for file in sorted(out.iterdir()):
        print(f"{file} {file.stat().st_size / 1e6:.1f} MB, sha256 {hashlib.sha256(file.read_bytes()).hexdigest()}")


main()
