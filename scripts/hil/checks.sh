# Shared by the parts of `./test hil` (inside the machine). Sourced, not run.
OMMA=build/release/bin/omma
failed=0
check() { # STATUS WHAT
  if [ "$1" = 0 ]; then echo "PASS  $2"; else
    echo "FAIL  $2 (status $1)"
    tail -2 /tmp/said 2> /dev/null
    failed=1
  fi
}
says() { grep -q -- "$1" /tmp/said; }  # what the last command said
refused() { # WHAT SENTENCE ARGUMENTS...
  local what=$1 sentence=$2
  shift 2
  timeout 60 $OMMA capture "$@" --frames 1 > /tmp/said 2>&1
  [ $? = 2 ] && says "$sentence"
  check $? "refused, $what: $(tail -1 /tmp/said | cut -c1-150)"
}
