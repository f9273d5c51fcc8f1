# What the scripts beside this file share; sourced by them, not run.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
venv=$root/.venv
logs=$root/build/logs
mkdir -p "$logs"
export MCPLAN_STARTED=${MCPLAN_STARTED:-$(date +%s)}  # one clock for a script and those it calls

elapsed() { echo $(($(date +%s) - MCPLAN_STARTED)); }

say() { printf '[%4d s] %s\n' "$(elapsed)" "$*"; }

fail() {
  printf 'error: %s\n' "$*" >&2
  exit 1
}

# step TITLE COMMAND...: one line with the time it took; the output goes to a log, whose end is shown on failure.
step() {
  local title=$1 begin=$SECONDS
  shift
  local log=$logs/${title//[^A-Za-z0-9+]/_}.log
  printf '[%4d s] %s ... ' "$(elapsed)" "$title"
  if "$@" >"$log" 2>&1; then
    printf '%d s\n' $((SECONDS - begin))
  else
    printf 'failed\n'
    tail -n 60 "$log" >&2
    fail "$title failed; the whole output is in ${log#"$root"/}"
  fi
}

# Compiler warnings are errors in continuous integration, and nowhere else.
if [[ ${CI:-} == true ]]; then werror=ON; else werror=OFF; fi
jobs=$(nproc)
