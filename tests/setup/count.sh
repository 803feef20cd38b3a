# Sourced by test.sh: what the logs of its steps say; `tidy::counting` tests it.

plain() { sed 's/\x1b\[[0-9;]*m//g' "$@"; }

# A test that lacks something on this machine fails with "not run: REASON": one "N not run: REASON" a line.
not_run() { # not_run RUST_LOG
  plain "$1" | awk '
    /^ *Running /           { program = $0 }
    /^---- .* stdout ----$/ { name = program " " $2 }
    /^not run: / && name    { sub(/^not run: /, ""); reason[name] = $0 }
    /^failures:$/           { name = "" }
    END                     { for (name in reason) n[reason[name]]++; for (why in n) print n[why] " not run: " why }' | sort
}

# "PASSED FAILED" of all that says its own counts.
counts() { # counts LOG...
  plain "$@" | awk '
    /^test result:/       { p += $4; f += $6 }
    /^deny: /             { p += $2; f += $4 }
    /^ *Tests  /          { for (i = 2; i <= NF; i++) { if ($i ~ /^passed/) p += $(i - 1); if ($i ~ /^failed/) f += $(i - 1) } }
    /^(#|ℹ) (pass|fail) / { if ($2 == "pass") p += $3; else f += $3 }
    END                   { print p + 0, f + 0 }'
}

# Programs without a harness, and those that a signal ended, fail without a count of their own.
uncounted() { # uncounted RUST_LOG
  plain "$1" | awk '
    /^test result: FAILED/                     { counted = 1 }
    /^ *Running /                              { counted = 0 }
    /^error: (doc)?test failed, to rerun pass/ { n += !counted; counted = 0 }
    END                                        { print n + 0 }'
}

# Is nothing wrong but tests that were not run, and does the log have its end?
only_not_run() { # only_not_run RUST_LOG
  local passed failed not_run
  read -r passed failed < <(counts "$1")
  not_run=$(not_run "$1" | awk '{ n += $1 } END { print n + 0 }')
  grep -q '^rust: [0-9]* programs in ' "$1" && [ "$not_run" -gt 0 ] && [ "$failed" -eq "$not_run" ] && [ "$(uncounted "$1")" -eq 0 ]
}

# What failing tests said, apart from those that were not run: at most 40 lines of each log.
why() { # why LOG...
  local log
  for log; do
    plain "$log" 2>/dev/null | awk '
      function tell() { if (!skipped) printf "%s", said; said = ""; skipped = 0 }
      /^---- .* stdout ----$/ || /^✖ failing tests:/ { tell(); inside = 1 }
      /^failures:$/ || /failed; to repeat it: /      { tell(); inside = 0 }
      inside && /^not run: /                         { skipped = 1 }
      inside && NF                                   { said = said substr($0, 1, 400) "\n" }
      END                                            { tell() }' | head -n 40
  done
}

# Reasons, steps that failed, and the last line, "N passed, N failed"; fails when a test or a step did.
summary() { # summary LOGS STEP_THAT_FAILED...
  local logs=$1 passed failed reasons
  shift
  reasons=$(not_run "$logs/rust.log" 2>/dev/null)
  # A check of the dependencies or of a package, or a test in Python, that lacks something only says so, and fails nothing.
  printf '%s\n' "$reasons" | sed '/^$/d'
  sed -n 's/^not run: /1 not run: /p' "$logs"/{check,dist,python}.log 2>/dev/null
  read -r passed failed < <({ cat "$logs"/{rust,vitest,browser,dist,python}.log; grep '^deny: ' "$logs/check.log"; } 2>/dev/null | counts)
  failed=$((failed - $(awk '{ n += $1 } END { print n + 0 }' <<< "$reasons") + $(uncounted "$logs/rust.log" 2>/dev/null)))
  if [ $# -gt 0 ]; then
    echo "test: these steps failed: $* (output in $logs)"
    # A step that broke without a counted failure counts as one.
    [ "$failed" -gt 0 ] || failed=$#
  fi
  echo "$passed passed, $failed failed"
  [ "$passed" -gt 0 ] && [ "$failed" -eq 0 ]
}
