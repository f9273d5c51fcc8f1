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

# watch LOG: the newest line of LOG that tells how far a build is ("[12/50] Building ..."), whenever there is a new one;
# on a terminal in place, else not more often than every ten seconds.
watch() {
  local last='' line
  while kill -0 $$ 2>/dev/null; do
    sleep "$([[ -t 1 ]] && echo 1 || echo 10)" >/dev/null 2>&1
    line=$(grep -aoE '\[[0-9]+/[0-9]+\] [A-Z].*' "$1" | tail -n 1) || continue
    [[ $line == "$last" ]] && continue
    last=$line
    line="[$(printf "%4d" "$(elapsed)") s]   $line"
    if [[ -t 1 ]]; then printf '\r\e[K%.100s' "$line"; else printf '%.120s\n' "$line"; fi
  done
}

# step TITLE COMMAND...: what is done, how long it took; the output goes to a log, whose end is shown on failure.
step() {
  local title=$1 begin=$SECONDS watcher status=0
  shift
  local log=$logs/${title//[^A-Za-z0-9+]/_}.log
  log=${log:0:200}
  : >"$log"
  say "$title (log: ${log#"$root"/})"
  watch "$log" &
  watcher=$!
  "$@" >"$log" 2>&1 || status=$?
  kill "$watcher" 2>/dev/null || true
  wait "$watcher" 2>/dev/null || true
  if [[ -t 1 ]]; then printf '\r\e[K'; fi
  if ((status)); then
    tail -n 60 "$log" >&2
    fail "$title failed; the whole output is in ${log#"$root"/}"
  fi
  say "  done in $((SECONDS - begin)) s"
}

# build_requirements PYTHON: what the package is built with, from pyproject.toml.
build_requirements() {
  "$1" - <<'PY'
try:
    import tomllib
except ModuleNotFoundError:  # Python 3.10
    from pip._vendor import tomli as tomllib
with open("pyproject.toml", "rb") as file:
    print(*tomllib.load(file)["build-system"]["requires"], sep="\n")
PY
}

# Compiler warnings are errors in continuous integration, and nowhere else.
if [[ ${CI:-} == true ]]; then werror=ON; else werror=OFF; fi
jobs=$(nproc)
