# The two commands of a new user, and the habits of a developer. CMake does the work; `cmake --list-presets` shows more.
#
#   make demo       set up, build, and run the whole job on built-in levels; pictures go to build/demo
#   make test       set up, build, and pass the tests

CC ?= cc
BUILD ?= build/release
DEMO ?= build/demo
JOBS ?= $(shell nproc 2>/dev/null || echo 2)
CMAKE_FLAGS ?=
TEST_FLAGS ?=

CONFIGURE = cmake -S . -B $(BUILD) -G Ninja -DCMAKE_C_COMPILER=$(CC) -DTALUS_WERROR=ON $(CMAKE_FLAGS)

.PHONY: all demo test bench sanitize tsan fuzz format lint docs install clean

all:
	tools/setup tools
	$(CONFIGURE) -DCMAKE_BUILD_TYPE=Release -DTALUS_TESTS=OFF
	cmake --build $(BUILD) --parallel $(JOBS)

demo:
	tools/setup tools
	cmake -S . -B build/tools -G Ninja -DCMAKE_C_COMPILER=$(CC) -DCMAKE_BUILD_TYPE=Release -DTALUS_TESTS=OFF
	cmake --build build/tools --parallel $(JOBS) --target talus_command
	tools/demo build/tools/cli/talus $(DEMO)

test:
	tools/setup tools tests
	$(CONFIGURE) -DCMAKE_BUILD_TYPE=Release
	cmake --build $(BUILD) --parallel $(JOBS)
	ctest --test-dir $(BUILD) --parallel $(JOBS) --output-on-failure $(TEST_FLAGS)

bench:
	tools/setup tools tests bench
	$(CONFIGURE) -DCMAKE_BUILD_TYPE=Release -DTALUS_BENCH=ON
	cmake --build $(BUILD) --parallel $(JOBS)
	tools/bench $(BUILD)/bench

sanitize:
	$(MAKE) test CC=clang BUILD=build/sanitize \
	    CMAKE_FLAGS="-DTALUS_SANITIZE=address,undefined -DTALUS_VALIDATE=ON -DCMAKE_C_FLAGS=-O1"

tsan:
	$(MAKE) test CC=clang BUILD=build/tsan CMAKE_FLAGS="-DTALUS_SANITIZE=thread" TEST_FLAGS="-R thread"

fuzz:
	tools/setup tools tests lint
	cmake -S . -B build/fuzz -G Ninja -DCMAKE_C_COMPILER=clang -DTALUS_FUZZ=ON -DTALUS_TESTS=OFF -DCMAKE_BUILD_TYPE=RelWithDebInfo
	cmake --build build/fuzz --parallel $(JOBS)
	tools/fuzz build/fuzz/fuzz

format:
	git ls-files '*.c' '*.h' '*.cpp' | xargs clang-format -i

lint:
	tools/setup lint
	tools/lint

install: all
	cmake --install $(BUILD)

clean:
	rm -rf build
