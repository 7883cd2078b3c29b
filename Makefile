# The two commands of a new user, and the habits of a developer. CMake does the work; `cmake --list-presets` shows more.
#
#   make demo       set up, build, and run the whole job on built-in levels; pictures go to build/demo
#   make test       set up, build, and pass the tests
#   make install    install command, library and headers under PREFIX (/usr/local unless told)
#   make python-test   set up, build and test the Python package, in a virtual environment of its own
#   make amalgamation   the library as two files, build/amalgamation/talus.c and talus.h
#   make package    the Debian packages, in build/package
#   make rust-test  test the Rust crates (cargo)
#   make bench-rust  their rates beside parry3d, rerecast and polyanya
#   make csharp-test  test the C# binding under Mono, and make the Unity package
#   make godot-test   build the extension for Godot 4, and test it in a stand-in for the engine
#   make docs       the documentation site, in build/docs/html
#   make viewer     set up, build the viewer's page, and serve it to the browser; talus view fills it with a level
#   make bench      set up, build, and run every benchmark; make bench-rays runs one

# make's own default for CC is cc; CXX is needed by the tests that compare with C++ peers.
CXX_OF_CC = $(if $(findstring clang,$(CC)),clang++,g++)
BUILD ?= build/release
DEMO ?= build/demo
JOBS ?= $(shell nproc 2>/dev/null || echo 2)
CMAKE_FLAGS ?=
# Warnings are errors where the project is checked (.ci/run), not at users', whose compilers may be newer.
WERROR ?= OFF
PREFIX ?= /usr/local
TEST_FLAGS ?=
TEST_TARGET ?= all
# Targets of make cross: CROSS="aarch64 wasm32" builds and runs these.
CROSS ?= all

CONFIGURE = cmake -S . -B $(BUILD) -G Ninja -DCMAKE_C_COMPILER=$(CC) -DCMAKE_CXX_COMPILER=$(CXX_OF_CC) -DTALUS_WERROR=$(WERROR) \
    -DCMAKE_BUILD_TYPE=Release $(CMAKE_FLAGS)

# For ctest under the sanitizers: SELECT="-LE long" leaves out what takes more than half a minute there.
SELECT ?=

# Optimised a little, asserts on.
CHECKED_FLAGS = -DCMAKE_C_FLAGS_RELEASE='-O1 -gline-tables-only' -DCMAKE_CXX_FLAGS_RELEASE='-O1 -gline-tables-only'

.PHONY: all demo test benchmarks bench bench-simd bench-python bench-rust bench-world sanitize tsan msan fuzz cross windows growth python-test docs amalgamation package rust-test csharp-test godot-test format wasm js-test bench-web viewer viewer-page viewer-test lint install clean

all:
	tools/setup tools
	$(CONFIGURE) -DTALUS_TESTS=OFF
	cmake --build $(BUILD) --parallel $(JOBS)

demo: all
	tools/demo $(BUILD)/cli/talus $(DEMO)

test:
	tools/setup tools tests
	$(CONFIGURE) -DTALUS_TESTS=ON
	cmake --build $(BUILD) --parallel $(JOBS) --target $(TEST_TARGET)
	ctest --test-dir $(BUILD) --parallel $(JOBS) --output-on-failure $(TEST_FLAGS)
	$(if $(TEST_FLAGS),,tools/test-viewer $(abspath $(BUILD))/cli/talus)

benchmarks:
	tools/setup tools tests bench
	$(CONFIGURE) -DTALUS_BENCH=ON
	cmake --build $(BUILD) --parallel $(JOBS)

bench: benchmarks
	tools/bench $(BUILD)/bench

# What SIMD saves on AArch64 (instructions, in qemu) and in WebAssembly (time, in node).
bench-simd:
	tools/setup tools tests cross
	tools/bench-simd

# The stages of talus world on sample worlds of 1 and 10 million triangles: triangles a second, and each process's peak;
# and a walk of 20 km over those that are baked.
# BENCH_WORLD="--millions 100 --bake-millions 100" bakes 100 million, in 20 GB and a quarter of an hour of processor time.
bench-world:
	tools/setup tools tests bench
	$(CONFIGURE) -DTALUS_BENCH=ON
	cmake --build $(BUILD) --parallel $(JOBS) --target talus_command bench_world_walk
	rm -rf $(BUILD)/bench-world
	bench/python/bench_world.py --talus $(BUILD)/cli/talus --walk $(BUILD)/bench/bench_world_walk --folder $(BUILD)/bench-world --json $(BUILD)/bench-world.json $(BENCH_WORLD)

bench-%:
	tools/setup tools tests bench
	$(CONFIGURE) -DTALUS_BENCH=ON
	cmake --build $(BUILD) --parallel $(JOBS) --target bench_$* bench_chart
	tools/bench $(BUILD)/bench $*

sanitize:
	$(MAKE) test CC=clang BUILD=build/sanitize TEST_FLAGS="$(SELECT)" \
	    CMAKE_FLAGS="-DTALUS_SANITIZE=address,undefined,float-cast-overflow -DTALUS_VALIDATE=ON $(CHECKED_FLAGS)"

# Without MPI, whose libraries are not instrumented: what they lock is not seen, and every message looks like a race.
tsan:
	$(MAKE) test CC=clang BUILD=build/tsan TEST_FLAGS="-L threads $(SELECT)" TEST_TARGET=thread_tests \
	    CMAKE_FLAGS="-DTALUS_SANITIZE=thread -DTALUS_MPI=OFF $(CHECKED_FLAGS)"

# Uninitialised memory. What is linked must be instrumented too, so the core and those of its tests that take no library.
MSAN_TESTS = contract arena base mesh_bake adjacency closed_parts halfedge hull_degenerate gjk convex_round convex_contacts \
    convex_penetration edge_contacts contour_trace detail_delaunay nav_tile nav_detour corridor nav_links nav_obstacles audit
msan:
	tools/setup tools tests lint
	cmake -S . -B build/msan -G Ninja -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ -DTALUS_SANITIZE=memory \
	    -DTALUS_TOOLS=OFF -DTALUS_EXAMPLES=OFF -DTALUS_TESTS=ON -DGMP_LIBRARY= -DQHULL_LIBRARY= -DXXHASH_LIBRARY= $(CHECKED_FLAGS)
	cmake --build build/msan --parallel $(JOBS) --target $(addprefix test_,$(MSAN_TESTS))
	ctest --test-dir build/msan --parallel $(JOBS) --output-on-failure \
	    -R '^($(shell echo $(MSAN_TESTS) | tr ' ' '|'))$$'

fuzz:
	tools/setup tools tests lint
	cmake -S . -B build/fuzz -G Ninja -DCMAKE_C_COMPILER=clang -DTALUS_FUZZ=ON -DTALUS_TESTS=OFF -DTALUS_EXAMPLES=OFF -DCMAKE_BUILD_TYPE=RelWithDebInfo
	cmake --build build/fuzz --parallel $(JOBS)
	tools/fuzz build/fuzz/fuzz

windows: all
	tools/setup tools windows
	JOBS=$(JOBS) tools/windows

cross:
	tools/setup tools cross
	JOBS=$(JOBS) tools/cross $(CROSS)

bench-python:
	tools/setup tools python
	tools/python-bench build/python

bench-rust:
	tools/setup tools rust
	tools/rust-bench build/rust-bench

growth:
	tools/setup tools growth
	tools/check-growth $(GROWTH)

python-test:
	tools/setup tools python
	tools/python-test build/python

docs:
	tools/setup docs
	tools/docs build/docs
# The viewer: one HTML page with all in it, build/viewer/viewer.html, which make install puts beside the command.
viewer-page: wasm
	cd web && npm install --no-save --no-audit --no-fund --ignore-scripts
	cd web && npm run --silent build

viewer: viewer-page
	cd web && PORT=$(or $(PORT),5173) npm run --silent serve

viewer-test: viewer-page
	tools/setup tools browser
	$(CONFIGURE) -DTALUS_TESTS=OFF
	cmake --build $(BUILD) --parallel $(JOBS) --target talus_command
	tools/test-viewer $(abspath $(BUILD))/cli/talus

amalgamation:
	tools/setup amalgamation
	tools/amalgamate build/amalgamation

package:
	tools/setup tools package
	tools/package build/package

rust-test:
	tools/setup tools rust
	tools/rust-test build/rust

csharp-test:
	tools/setup csharp
	tools/csharp-test build/csharp

godot-test:
	tools/setup godot
	tools/godot-test build/godot

format:
	git ls-files '*.c' '*.h' '*.inl' '*.cpp' '*.hpp' | xargs clang-format -i

lint:
	tools/setup lint
	tools/lint

# The modules of the npm package, built by Debian's Emscripten: js/dist/talus.wasm, talus-simd.wasm, talus-threads.wasm and
# talus-queries.wasm.
wasm:
	tools/setup web
	emcmake cmake -S wasm -B build/wasm -G Ninja -DTALUS_WERROR=$(WERROR) >/dev/null
	cmake --build build/wasm --parallel $(JOBS)
	mkdir -p js/dist
	cp build/wasm/talus*.wasm js/dist/

# The package's tests; bytes are compared with those of the command.
js-test: wasm all
	cd js && npm ci --no-audit --no-fund --silent && npx tsc -p .
	cd js && TALUS_COMMAND=$(abspath $(BUILD))/cli/talus npm test

# JavaScript peers, in node: rays, paths, bakes. BENCH_WEB="courtyard /tmp/level.obj" names levels.
bench-web: wasm
	cd js/bench && npm ci --no-audit --no-fund --silent && node bench.js $(BENCH_WEB)

install: all
	cmake --install $(BUILD) --prefix "$(PREFIX)"

clean:
	rm -rf build
