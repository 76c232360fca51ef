# The front door. Every target installs what it misses (scripts/deps.sh names it first) and builds what it needs.
# Everything made here is in build/, build-*/ and out/.

# The system's python3, whatever comes first on PATH; the fallback is where it will be once installed.
PYTHON := $(shell command -pv python3 || echo /usr/bin/python3)
BUILD := build
CMAKE := cmake -S . -G Ninja -DCMAKE_EXPORT_COMPILE_COMMANDS=ON

.PHONY: all run viewer bench-viewer test physics bench bench-lcp bench-scenes fuzz sanitize install clean help deps-build deps-python configure

all: configure ## build the library, the program and the Python package
	@cmake --build $(BUILD)
	@echo "built $(BUILD)/bin/tumble and the Python package in $(BUILD)/python"

help: ## this list
	@grep -hE '^[a-z-]+:.*##' $(MAKEFILE_LIST) | sed 's/:.*## /\t/' | expand -t 12

deps-build:
	@scripts/deps.sh build

deps-python: deps-build
	@scripts/deps.sh python

# Python and tests are optional in CMake; once switched on here they stay on in build/.
configure: deps-python
	@test -f $(BUILD)/build.ninja && grep -q '^TUMBLE_BUILD_PYTHON:BOOL=ON' $(BUILD)/CMakeCache.txt || \
	  $(CMAKE) -B $(BUILD) -DTUMBLE_BUILD_PYTHON=ON >/dev/null

run: deps-build ## simulate the course's start; writes out/drop.csv, out/drop.gif, out/drop.png
	@test -f $(BUILD)/build.ninja || $(CMAKE) -B $(BUILD) -DTUMBLE_BUILD_PYTHON=OFF >/dev/null
	@cmake --build $(BUILD) --target tumble_cli
	@mkdir -p out
	@$(BUILD)/bin/tumble drop --force -o out/drop.csv -o out/drop.gif -o out/drop.png
	@echo
	@echo "Look at out/drop.gif and out/drop.png. Then try:"
	@echo "  $(BUILD)/bin/tumble drop --q0 0,1,45deg --v0 2,0,-3 --friction 0.6 -o out/mine.gif"
	@echo "  $(BUILD)/bin/tumble run scenes/wall_and_ball.toml -o out/wall_and_ball.gif"
	@echo "  $(BUILD)/bin/tumble run scenes/dominoes.toml -o out/dominoes.gif"
	@echo "  $(BUILD)/bin/tumble run scenes/galton_board.toml -o out/galton_board.gif"
	@if test -f out/tumble.html; then echo "  out/tumble.html: the same engine in the browser"; \
	  else echo "  make viewer: the same engine in the browser, as one file, out/tumble.html"; fi
	@echo "  $(BUILD)/bin/tumble --help"
	@echo "  make && PYTHONPATH=$(BUILD)/python $(PYTHON) -c 'from tumble.drop import simulate; print(simulate([0, 1.5, 0.5], [0, -0.2, 0]))'"

WASM := build-wasm
# emscripten runs a script of node-acorn, which a Node.js that is not Debian's does not find by itself.
ACORN = $(shell dpkg -L node-acorn 2>/dev/null | sed -n 's,/acorn/package.json$$,,p')
EMSCRIPTEN := /usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake

viewer: ## the browser page with the engine inside: out/tumble.html, one file
	@scripts/deps.sh build viewer
	@NODE_PATH=$(ACORN) $(CMAKE) -B $(WASM) -DCMAKE_TOOLCHAIN_FILE=$(EMSCRIPTEN) -DTUMBLE_BUILD_WASM=ON -DTUMBLE_BUILD_HASH=ON \
	  -DTUMBLE_BUILD_OUTPUT=OFF -DTUMBLE_BUILD_CLI=OFF -DTUMBLE_BUILD_PYTHON=OFF >/dev/null
	@NODE_PATH=$(ACORN) cmake --build $(WASM)
	@cd viewer && { test node_modules/.package-lock.json -nt package-lock.json || npm ci --ignore-scripts --no-progress; }
	@cd viewer && npm run --silent build
	@mkdir -p out $(BUILD)/share/tumble $(BUILD)/python/tumble
	@for place in out $(BUILD)/share/tumble $(BUILD)/python/tumble; do cp viewer/dist/index.html $$place/tumble.html; done
	@echo "wrote out/tumble.html ($$(gzip -9c out/tumble.html | wc -c) bytes compressed): open it in a browser"

bench-viewer: viewer ## frame times, start and memory of the page in headless Chromium; writes out/bench-viewer.md
	@scripts/deps.sh viewer-test
	@cd viewer && node bench/bench.mjs ../out/tumble.html ../out/bench-viewer.md

test: viewer ## all tests; the last line is "N passed, N failed"
	@scripts/deps.sh build python test viewer-test
	@$(CMAKE) -B $(BUILD) -DTUMBLE_BUILD_PYTHON=ON -DTUMBLE_BUILD_TESTS=ON -DTUMBLE_WERROR=ON >/dev/null
	@cmake --build $(BUILD)
	@$(PYTHON) scripts/run_tests.py --build $(BUILD)

physics: ## errors of scenes against closed forms, at several step sizes; writes out/physics.md
	@scripts/deps.sh build test
	@$(CMAKE) -B $(BUILD) -DTUMBLE_BUILD_TESTS=ON >/dev/null
	@cmake --build $(BUILD) --target tumble_physics
	@mkdir -p out
	@$(BUILD)/bin/tumble_physics | tee out/physics.md

bench: ## benchmarks; writes out/bench.md, out/bench-batch.md, and what bench-scenes writes
	@scripts/deps.sh build python bench
	@$(CMAKE) -B $(BUILD) -DTUMBLE_BUILD_PYTHON=ON -DTUMBLE_BUILD_BENCHMARKS=ON >/dev/null
	@cmake --build $(BUILD)
	@mkdir -p out
	@$(PYTHON) benchmarks/run.py --build $(BUILD) --output out/bench.md
	@$(PYTHON) benchmarks/batch/run.py --build $(BUILD) --output out/bench-batch.md
	@$(MAKE) --no-print-directory bench-scenes

LCP_ARGS ?=
bench-lcp: ## every LCP solver on the same problems; LONG=1 adds millions; writes out/bench-lcp.md, .csv, -*.png
	@scripts/deps.sh build python bench-lcp
	@$(CMAKE) -B $(BUILD) -DTUMBLE_BUILD_LCP_BENCHMARKS=ON >/dev/null
	@cmake --build $(BUILD) --target tumble_bench_lcp
	@mkdir -p out
	@$(BUILD)/bin/tumble_bench_lcp $(if $(LONG),--long) $(LCP_ARGS)
	@$(PYTHON) benchmarks/lcp/plot.py out/bench-lcp.csv

SCENES_ARGS ?=
bench-scenes: ## engines on the same scenes; LONG=1 takes more rounds; writes out/bench-scenes.md, .csv
	@scripts/deps.sh build bench-scenes
	@$(CMAKE) -B $(BUILD) -DTUMBLE_BUILD_SCENE_BENCHMARKS=ON >/dev/null
	@cmake --build $(BUILD) --target tumble_bench_scenes
	@$(BUILD)/bin/tumble_bench_scenes $(if $(LONG),--rounds 15) $(SCENES_ARGS)

TIME ?= 60
fuzz: ## libFuzzer on every loader, TIME seconds each (default 60)
	@scripts/deps.sh build fuzz
	@$(CMAKE) -B build-fuzz -DCMAKE_CXX_COMPILER=clang++-14 -DTUMBLE_BUILD_FUZZERS=ON -DTUMBLE_BUILD_CLI=OFF \
	  -DTUMBLE_BUILD_PYTHON=OFF >/dev/null
	@cmake --build build-fuzz
	@scripts/fuzz.sh build-fuzz $(TIME)

sanitize: ## the C++ tests under AddressSanitizer and UndefinedBehaviorSanitizer
	@scripts/deps.sh build test
	@$(CMAKE) -B build-sanitize -DTUMBLE_SANITIZE=ON -DTUMBLE_BUILD_TESTS=ON -DTUMBLE_BUILD_PYTHON=OFF >/dev/null
	@cmake --build build-sanitize
	@ctest --test-dir build-sanitize --output-on-failure -j 2

PREFIX ?= /usr/local
install: configure ## install to PREFIX (default /usr/local)
	@cmake --build $(BUILD)
	@cmake --install $(BUILD) --prefix $(PREFIX)

clean: ## remove everything that was made
	rm -rf build build-* out
