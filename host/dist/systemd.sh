#!/usr/bin/env bash
# systemd.sh [PACKAGE]: starts a virtual machine with Debian 13, in which systemd runs the units of this Debian package, or of what
# was built, and systemd.py says what has to hold there. Like tools.sh it installs what it can and says what. Its last line counts.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
package=${1:+$(realpath "$1")}
cd "$here/../.."
. tests/setup/count.sh
say() { printf 'systemd: %s\n' "$*" >&2; }
die() { say "$*"; exit 1; }

work=$(mktemp -d)
machine=
trap '[ -z "$machine" ] || kill "$machine"; rm -rf "$work"' EXIT
if [ -z "$package" ]; then
  host/dist/pack.py "$work/packages" >/dev/null
  package=$(echo "$work"/packages/*.deb)
fi
# What is left needs root. Packing does not, and may have its compiler in the home of who calls this.
if [ "$(id -u)" != 0 ]; then
  sudo -n "$here/systemd.sh" "$package"
  exit
fi

missing=()
command -v qemu-system-x86_64 >/dev/null || missing+=(qemu-system-x86)
command -v mmdebstrap >/dev/null || missing+=(mmdebstrap)
if [ ${#missing[@]} -gt 0 ]; then
  command -v apt-get >/dev/null || die "please install these (Debian's names) and run it again: ${missing[*]}"
  say "installing with apt-get: ${missing[*]}"
  apt-get update -qq
  DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
fi

# Debian from where this machine has its packages.
system=.tools/systemd.tar
if [ ! -e "$system" ]; then
  . /etc/os-release
  [ "$ID" = debian ] || die "this machine is not Debian, whose packages the virtual machine is made of"
  mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' | head -1)
  say "fetching Debian 13 (260 MB unpacked) into $system"
  mkdir -p .tools
  mmdebstrap --quiet --mode=root --variant=minbase --include=systemd-sysv,linux-image-cloud-amd64,python3,libstdc++6,libbpf1 \
    trixie "$work/system.tar" "$mirror"
  mv "$work/system.tar" "$system"
fi
mkdir "$work/debian"
tar xf "$system" -C "$work/debian"
cp "$package" "$work/debian/srv/opencollbench.deb"
cp host/dist/systemd.py "$work/debian/srv/"
# What it says goes through the second serial port; systemd's own words and the kernel's through the first.
cat > "$work/debian/etc/systemd/system/proof.service" <<'UNIT'
[Unit]
After=multi-user.target
SuccessAction=poweroff-force
FailureAction=poweroff-force
[Service]
Type=oneshot
Environment=LC_ALL=C.UTF-8 PYTHONUNBUFFERED=1
ExecStart=/usr/bin/python3 /srv/systemd.py
StandardOutput=file:/dev/ttyS1
StandardError=inherit
UNIT
mkdir -p "$work/debian/etc/systemd/system/multi-user.target.wants"
ln -s /etc/systemd/system/proof.service "$work/debian/etc/systemd/system/multi-user.target.wants/"
truncate -s 3G "$work/disk"
mkfs.ext4 -q -d "$work/debian" "$work/disk"

touch "$work/said"
# Every instruction is translated: it takes some ten times as long, and needs no help of the processor.
timeout 3600 qemu-system-x86_64 -accel tcg,thread=multi -cpu max -smp 2 -m 4G -nodefaults -display none -no-reboot \
  -kernel "$(echo "$work"/debian/boot/vmlinuz-*)" -initrd "$(echo "$work"/debian/boot/initrd.img-*)" \
  -append "root=/dev/vda rw console=ttyS0 systemd.show_status=no" -drive "file=$work/disk,if=virtio,format=raw,cache=unsafe" \
  -chardev "file,id=console,path=$work/console" -serial chardev:console -chardev "file,id=said,path=$work/said" -serial chardev:said &
machine=$!
tail --pid="$machine" -n +1 -s 0.2 -f "$work/said" | sed -u 's/\r$//'
code=0
wait "$machine" || code=$?
machine=
sed 's/\r$//' "$work/said" > "$work/log"
read -r passed failed < <(counts "$work/log")
if [ "$code" != 0 ] || ! grep -qx 'systemd: all checks were made' "$work/log"; then
  tail -40 "$work/console"
  die "the machine ended in the middle (exit code $code); above is the last of its console"
fi
echo "systemd: $passed passed, $failed failed"
[ "$failed" = 0 ]
