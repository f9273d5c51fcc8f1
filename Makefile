# Short names for the scripts, which do the work and need no make.
.PHONY: setup demo test test-slow bench stubs format clean

setup:
	scripts/setup

demo:
	scripts/demo

test:
	scripts/test

test-slow:
	scripts/test -m "slow or not slow"

bench: setup
	.venv/bin/mcplan bench

stubs: setup
	scripts/stubs

format: setup
	find cpp tests examples benchmarks -name '*.[ch]pp' 2>/dev/null | xargs .venv/bin/clang-format -i
	.venv/bin/ruff format .
	.venv/bin/ruff check --fix .

clean:
	rm -rf build out
