#!/usr/bin/env bash
# empty.sh archive|wheel|deb PACKAGE: in new namespaces (as root, from test.sh), installs the package into a root that has the
# system and nothing else: no checkout, no compiler of ours, no home, no network but loopback. Then an ordinary user starts the
# service, and the first heatmap has to come. All changes to the system's folders go to memory and end with the namespace.
set -euo pipefail
kind=$1 package=$2
root=$(mktemp -d)
mount --make-rprivate /
mount -t tmpfs -o mode=755 empty "$root"
for folder in usr etc var; do
  mkdir -p "$root/$folder" "$root/changes/$folder/new" "$root/changes/$folder/work"
  mount -t overlay -o "lowerdir=/$folder,upperdir=$root/changes/$folder/new,workdir=$root/changes/$folder/work" overlay "$root/$folder"
done
for link in bin sbin lib lib64; do ln -s "usr/$link" "$root/$link"; done
mkdir -p "$root"/{proc,sys,dev/shm,opt,run,srv/visitor,old}
mkdir -m 1777 "$root/tmp"
mount -t proc proc "$root/proc"
mount --rbind /sys "$root/sys"
for device in null zero random urandom full; do touch "$root/dev/$device"; mount --bind "/dev/$device" "$root/dev/$device"; done
cp "$package" "$(dirname "$0")"/{heatmap,measure}.py "$root/srv/"
chown 1000:1000 "$root/srv/visitor"
package=/srv/$(basename "$package")
cd "$root"
pivot_root . old
umount -l /old
rmdir /old "$root" 2>/dev/null || true
export PATH=/usr/sbin:/usr/bin HOME=/srv/visitor
# Loopback, without a tool for it.
/usr/bin/python3 -c 'import fcntl, socket, struct
fcntl.ioctl(socket.socket(), 0x8914, struct.pack("16sh14x", b"lo", 1))'
as() { # as USER GROUP COMMAND...: as the unit does, without a way to more rights; replaces the shell that it runs in
  local user=$1 group=$2
  shift 2
  exec setpriv --reuid "$user" --regid "$group" --clear-groups --no-new-privs --bounding-set=-all env -i "PATH=$PATH" "HOME=$HOME" "$@"
}
cd "$HOME"
started=$(date +%s%N)
case $kind in
  archive)
    (as 1000 1000 tar xzf "$package")
    as 1000 1000 sh -c 'exec ./opencollbench-*/ocb serve' &
    ;;
  wheel)
    (as 1000 1000 /usr/bin/python3 -m venv env)
    (as 1000 1000 env/bin/pip install --quiet --disable-pip-version-check --no-index "$package")
    as 1000 1000 env/bin/ocb serve &
    ;;
  deb)
    dpkg -i "$package"
    unit=/usr/lib/systemd/system/opencollbench.service
    user=$(sed -n 's/^User=//p' "$unit")
    install -d -o "$user" "/var/lib/$(sed -n 's/^StateDirectory=//p' "$unit")"
    # What is read-only for the unit is so here: its measuring lock is not in a folder that it may not write to.
    install -d /run/lock
    mount -t tmpfs -o mode=1777 lock /run/lock
    grep -qx 'ReadWritePaths=/run/lock' "$unit" || mount -o remount,ro /run/lock
    read -ra command <<< "$(sed -n 's/^ExecStart=//p' "$unit")"
    as "$user" "$user" "${command[@]}" &
    ;;
esac
service=$!
/usr/bin/python3 /srv/heatmap.py "$kind" "$started" "$service"
kill "$service"
wait "$service"
if [ "$kind" = wheel ]; then
  (as 1000 1000 env/bin/python /srv/measure.py)
fi
if [ "$kind" = deb ]; then
  dpkg -r opencollbench
  [ ! -e /opt/opencollbench ] && [ ! -e /usr/bin/ocb ]
fi
