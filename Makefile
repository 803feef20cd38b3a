# OpenCollBench: `make serve` to use it, `make test` to prove it. Longer steps live in tests/setup/.
SHELL := /bin/bash
.SHELLFLAGS := -eu -o pipefail -c
.DEFAULT_GOAL := help
.PHONY: help serve build dist beside runner wrappers pages stock plugins-cpp recorders plugins-native check check-oracle test aarch64 systemd bench soak clean tools

PORT ?= 8080
DATA ?= data
COMPILE := cargo build --release
# Tools that tests/setup/tools.sh had to install for this folder alone come first.
export PATH := $(CURDIR)/.tools/node_modules/.bin:$(HOME)/.cargo/bin:$(PATH)
CARGO_FLAGS := --release --workspace
TARGET := $(or $(CARGO_TARGET_DIR),target)
PAGES := $(shell find web/app -type f -not -path '*/node_modules/*' -not -path '*/dist/*' -not -name schema.d.ts 2>/dev/null)

help: ## print this list
	@awk -F ':.*## ' '/^[a-z0-9-]+:.*## / { printf "  make %-14s %s\n", $$1, $$2 }' $(MAKEFILE_LIST)

serve: COMPILE += --no-default-features
serve: tools beside ## build what serves one machine, then serve on 127.0.0.1:8080 (PORT=, DATA=)
	$(COMPILE)
	exec $(TARGET)/release/ocb serve --data $(DATA) --listen 127.0.0.1:$(PORT) --stock-dir target/stock

build: tools beside ## build all of it: also PostgreSQL, S3, mail, pictures as PNG, the client for services elsewhere, recorders
	$(COMPILE)
	@$(MAKE) --silent --keep-going recorders || echo "make: going on without the recorders that were not built"

dist: build ## pack an archive, a wheel and a Debian package into target/dist
	host/dist/pack.py $(TARGET)/dist

plugins-cpp: ## build the wrappers of the C++ libraries that are installed, and say how to get the others
	@$(MAKE) --no-print-directory $(if $(findstring -j,$(MAKEFLAGS)),,--jobs=$(shell nproc)) -C plugins/cpp

recorders: ## build what `ocb record` loads into programs, and say how to get the libraries that are missing
	@$(MAKE) --no-print-directory -C host/record

plugins-native: ## build parry, FCL, ODE, Bullet and Coal from their sources for this CPU, beside the usual builds
	@$(MAKE) --no-print-directory -C plugins/cpp native

# Against your own copy: make plugin-pqp PQP_DIR=/path/to/it, likewise rapid, v-collide, solid (see plugins/cpp/README.md).
plugin-%:
	@$(MAKE) --no-print-directory -C plugins/cpp $*

tools:
	@tests/setup/tools.sh build

# Building the pages keeps one CPU busy; the wrappers, and the runner, which holds no pages, are compiled meanwhile.
beside:
	@$(MAKE) --silent --jobs=3 pages stock wrappers runner COMPILE="$(COMPILE)"
runner: tools
	$(COMPILE) --bin ocb-runner
wrappers: tools
	@$(MAKE) --keep-going plugins-cpp || echo "make: going on without the wrappers that were not built"

pages: tools web/app/dist/index.html
web/app/node_modules/.package-lock.json: web/app/package.json web/app/package-lock.json
	cd web/app && npm ci --no-audit --no-fund
web/app/dist/index.html: web/app/node_modules/.package-lock.json $(PAGES)
	cd web/app && npm run build && touch dist/index.html

stock: tools target/stock/dragon.obj
target/stock/dragon.obj: web/stock/package.json web/stock/package-lock.json web/stock/write.mjs
	cd web/stock && npm ci --no-audit --no-fund && node write.mjs ../../target/stock

check: pages ## rustfmt, clippy, rustdoc, dependencies, tidy tests, TypeScript and its linter: warnings are errors
	cargo fmt --all --check
	cargo clippy $(CARGO_FLAGS) --all-targets -- -D warnings
	cargo clippy --release --no-default-features -- -D warnings
	RUSTDOCFLAGS="-D warnings" cargo doc $(CARGO_FLAGS) --no-deps --document-private-items
	tests/setup/deny.sh
	cargo test $(CARGO_FLAGS) --test tidy
	cd web/app && npm run check

test: ## everything: check, Rust, TypeScript, PostgreSQL, S3, a real browser on the built service
	@tests/setup/test.sh

check-oracle: ## the oracle against CGAL, integers and planted faults (some 20 minutes)
	@tests/setup/tools.sh test
	cargo test $(CARGO_FLAGS) --test oracle -- --nocapture
	tests/oracle-check/faults.py all

aarch64: ## build what is portable for aarch64 and run its tests under qemu (some 20 minutes)
	tests/setup/aarch64.sh

systemd: build ## the Debian package under systemd, in a virtual machine with Debian 13 (some 7 minutes)
	host/dist/systemd.sh

bench: build ## every algorithm side by side (OBJECTS=files), the clock, finding positions against peers, first pictures and selections on pages, machines for a day's runs
	cargo bench --workspace --bench algorithms -- $(abspath $(OBJECTS))
	cargo bench --workspace --bench timing
	cargo bench --workspace --bench positions -- $(firstword $(abspath $(OBJECTS)) $(abspath target/stock/dragon.obj))
	cargo bench --workspace --bench overhead -- $(firstword $(abspath $(OBJECTS)) $(abspath target/stock/dragon.obj))
	tests/benches/machines.py
	npm --prefix tests/e2e ci --no-audit --no-fund && node tests/e2e/first-picture.mjs && node tests/e2e/fluent.mjs

soak: build ## fuzz the jail's readers and those of objects, try ten million pairs, then kill and restart the service for MINUTES (10)
	tests/setup/soak.sh $(or $(MINUTES),10)

clean: ## remove what was built; keeps data/ and .tools/
	rm -rf target web/app/dist web/app/node_modules web/stock/node_modules
