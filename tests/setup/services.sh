# Sourced by test.sh: a PostgreSQL and an S3 server of our own on free loopback ports, for the store's contract tests.
# `start_services DIR` exports OCB_TEST_POSTGRES and OCB_TEST_S3, and in OCB_TEST_TLS the folder with the certificate of
# PostgreSQL (server.crt) and another one (other.crt); `stop_services` ends both by pid.

free_port() {
  python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])'
}

# PostgreSQL refuses to run as root: then its own user runs it.
as_postgres() {
  if [ "$(id -u)" = 0 ]; then runuser -u postgres -- "$@"; else "$@"; fi
}

start_services() {
  local bin port
  services_dir=$(mktemp -d "${TMPDIR:-/tmp}/ocb-services.XXXXXX")
  bin=$(ls -d /usr/lib/postgresql/*/bin | sort -V | tail -1)

  echo "services: starting PostgreSQL ($bin) and an S3 server (moto) in $services_dir"
  mkdir "$services_dir/pg"
  if [ "$(id -u)" = 0 ]; then chmod 755 "$services_dir" && chown postgres "$services_dir/pg"; fi
  for name in server other; do
    as_postgres openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:prime256v1 -nodes -days 2 -subj "/CN=$name" \
      -addext "subjectAltName=IP:127.0.0.1" -addext "basicConstraints=critical,CA:FALSE" \
      -keyout "$services_dir/pg/$name.key" -out "$services_dir/pg/$name.crt" 2>/dev/null
  done
  port=$(free_port)
  (cd "$services_dir/pg" \
    && as_postgres "$bin/initdb" -D "$services_dir/pg/data" -U ocb --auth=trust --encoding=UTF8 --locale=C -N >"$services_dir/initdb.log" 2>&1 \
    && as_postgres "$bin/pg_ctl" -D "$services_dir/pg/data" -w -t 60 -l "$services_dir/pg/log" \
      -o "-c listen_addresses=127.0.0.1 -c port=$port -c fsync=off -c ssl=on \
        -c ssl_cert_file=$services_dir/pg/server.crt -c ssl_key_file=$services_dir/pg/server.key -c unix_socket_directories=$services_dir/pg" start >/dev/null) \
    || { echo "services: PostgreSQL did not start:"; cat "$services_dir/initdb.log" "$services_dir/pg/log"; return 1; }
  postgres_ctl=$bin/pg_ctl
  export OCB_TEST_POSTGRES="postgres://ocb@127.0.0.1:$port/postgres" OCB_TEST_TLS=$services_dir/pg

  port=$(free_port)
  .tools/s3/bin/moto_server -H 127.0.0.1 -p "$port" >"$services_dir/s3.log" 2>&1 &
  s3_pid=$!
  export AWS_ACCESS_KEY_ID=test AWS_SECRET_ACCESS_KEY=test AWS_REGION=us-east-1 AWS_DEFAULT_REGION=us-east-1
  curl --fail --silent --output /dev/null --noproxy '*' --retry 60 --retry-delay 1 --retry-connrefused \
    -X PUT "http://127.0.0.1:$port/ocb-test" || { echo "services: the S3 server did not start:"; cat "$services_dir/s3.log"; return 1; }
  export OCB_TEST_S3="s3://ocb-test?endpoint=http://127.0.0.1:$port"
}

stop_services() {
  if [ -n "${postgres_ctl:-}" ]; then
    (cd / && as_postgres "$postgres_ctl" -D "$services_dir/pg/data" -m immediate stop >/dev/null 2>&1) || true
  fi
  if [ -n "${s3_pid:-}" ]; then kill "$s3_pid" 2>/dev/null || true; fi
  if [ -n "${services_dir:-}" ]; then rm -rf "$services_dir"; fi
}
