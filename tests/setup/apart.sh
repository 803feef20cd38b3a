#!/bin/sh
# apart.sh COMMAND...: runs it as on hardware of its own, with a measuring lock that nothing else waits for. Only root can mount
# one: another user would be root in a namespace of its own, and some tests look at that. Without it, all wait for each other.
if [ "$(id -u)" = 0 ] && unshare -m mount -t tmpfs none /run/lock 2> /dev/null; then
  exec unshare -m sh -c 'mount -t tmpfs none /run/lock && exec "$@"' sh "$@"
fi
exec "$@"
