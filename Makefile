# The front door. Everything else is CMake: see CMakePresets.json.
PREFIX ?= /usr/local
DESTDIR ?=
CMAKE_FLAGS ?=
JOBS ?= $(shell nproc)
TEST_JOBS ?= $(JOBS)
FUZZ_SECONDS ?= 600
SECONDS ?= 600
FIRST ?= $(shell date +%s)
TEST = ctest --test-dir build --output-on-failure --timeout 1200 -j $(TEST_JOBS)

.PHONY: help packages build demo check check-long check-parts check-editor check-ifc check-models check-report check-studio check-studio-quick check-scale check-sanitizers check-arm check-arm-syntax wasm check-wasm python check-python site check-site lint package check-package bench bench-threads bench-place bench-scale bench-studio bench-python fuzz search install uninstall clean

help:
	@echo 'make demo        build tartan, count a plan library, draw a sheet of it (into demo/)'
	@echo 'make check       build everything and run every test'
	@echo 'make check-long  run the tests that take long, which make check leaves out'
	@echo 'make check-parts build without pictures, OpenMesh, SQLite and CaDiCaL, and test that'
	@echo 'make package     make a Debian package (into build-package/)'
	@echo 'make check-package  try that on a clean root (as root, with debootstrap)'
	@echo 'make check-editor  test the language server, the VS Code extension (needs node and npm) and the grammar for tree-sitter (needs tree-sitter)'
	@echo 'make check-ifc   hold building models to the rules of IFC4 and to web-ifc and IfcOpenShell (node and npm)'
	@echo 'make check-models  hold models of houses to the Khronos validator and to Blender, where these are installed (npm)'
	@echo 'make check-report  test the report page in a browser without a screen (chromium)'
	@echo 'make check-studio  test the studio in a browser, and the playground if it is made (chromium, node and npm)'
	@echo 'make check-scale  write a library by MPI, GNU parallel and Slurm, where these are installed'
	@echo 'make check-sanitizers  run every test under AddressSanitizer and UndefinedBehaviorSanitizer (into build-asan/)'
	@echo 'make check-arm-syntax  pass every C file through a compiler for 64-bit ARM'
	@echo 'make check-arm   build for 64-bit ARM, test that in an emulator and compare its results with those here (into build-arm/)'
	@echo 'make wasm        make the engines as WebAssembly, for pages and workers (into build-wasm/site)'
	@echo 'make check-wasm  test these under Node, and compare their results with those here'
	@echo 'make python      build the Python package: two wheels (into build-python/), and python3-tartan with make package'
	@echo 'make check-python  test that: its calls against the command, its wheels, its notebooks'
	@echo 'make site        make the documentation as static pages, with the playground if make wasm made it (into build-site/)'
	@echo 'make check-site  test that its links lead somewhere, and that the files to try pass, in the playground too, if that is made'
	@echo 'make lint        look over the sources with clang-tidy'
	@echo 'make bench       print how fast it is here'
	@echo 'make bench-threads print how the time of works falls with threads here'
	@echo 'make bench-place print how fast parts are placed, counted and drawn here'
	@echo 'make bench-scale print how fast shard sets are here (an idle machine with two processors or more)'
	@echo 'make bench-studio print how fast the studio answers here'
	@echo 'make bench-python print how fast the Python package is, beside C'
	@echo 'make fuzz        run each fuzz target for FUZZ_SECONDS (600)'
	@echo 'make search      ask random files every question against every other for SECONDS (600), from the seed FIRST (the time)'
	@echo 'make install     install below PREFIX (/usr/local), staged into DESTDIR where that is set'
	@echo 'make uninstall   remove what make install put there'
	@echo 'make clean       remove what was built'

packages:
	@tools/install-packages packages.txt

build: packages
	@mkdir -p build
	@cmake --preset release -DCMAKE_INSTALL_PREFIX='$(PREFIX)' $(CMAKE_FLAGS) >build/configure.log 2>&1 || { cat build/configure.log; exit 1; }
	@cmake --build build -j $(JOBS)

demo: build
	@tools/demo build/tartan demo

check: build
	@$(TEST) -LE LONG

# An issue's full numbers; make check has a fixed share of them.
check-long: build
	@$(TEST) -L LONG --no-tests=error

check-parts: packages
	@tools/check-parts

package: packages
	@tools/make-package

check-package: packages
	@tools/check-package

check-editor: build
	@cd editors/vscode && npm ci --ignore-scripts --loglevel=error && TARTAN='$(CURDIR)/build/tartan' npm test
	@TARTAN='$(CURDIR)/build/tartan' NO_COLOR=1 bash tests/cli/tree_sitter.sh || [ $$? -eq 77 ]

check-models: build
	@tools/check-models build/tartan

# IFC_TABLES: a folder with buildingSMART's tables of sets of properties and quantities.
check-ifc: build
	@tools/check-ifc build/tartan $(IFC_TABLES)

check-report: build
	@tools/check-report build/tartan

check-studio: build
	@tools/check-studio build/tartan all

# Three scenarios of it, for continuous integration.
check-studio-quick: build
	@tools/check-studio build/tartan quick

check-scale: build
	@tools/check-scale build/tartan "$(RANKS)"

check-sanitizers: packages
	@cmake --preset asan $(CMAKE_FLAGS) >/dev/null
	@cmake --build --preset asan -j $(JOBS)
	@ctest --test-dir build-asan --output-on-failure --timeout 3600 -j $(TEST_JOBS) -LE LONG

check-arm-syntax: build
	@tools/check-arm-syntax build

check-arm: build
	@tools/check-arm build

# The engines as WebAssembly: build-wasm/site is a folder that any server of files can serve.
wasm: packages
	@tools/install-packages tools/wasm-packages.txt
	@mkdir -p build-wasm
	@cmake --preset wasm $(CMAKE_FLAGS) >build-wasm/configure.log 2>&1 || { cat build-wasm/configure.log; exit 1; }
	@cmake --build build-wasm -j $(JOBS)
	@tools/build-playground build-wasm/site

check-wasm: build wasm
	@tools/check-wasm build build-wasm

# The packages first: the build has the Python package only where these are.
python: python-packages build
	@tools/build-python build build-python

check-python: python-packages build
	@tools/check-python build $(SHARE)

.PHONY: python-packages
python-packages: packages
	@tools/install-packages tools/python-packages.txt

site: build
	@tools/install-packages tools/site-packages.txt
	@tools/build-site build build-site build-wasm/site

check-site: build
	@tools/check-site build build-wasm/site $(SHARE)

lint: build
	@tools/lint build

bench: build
	@bench/run build

bench-threads: build
	@bench/threads build

bench-place: build
	@bench/place build

bench-studio: build
	@bench/studio build build-wasm

bench-python: python-packages build
	@bench/python build

bench-scale: build
	@bench/scale build/tartan

fuzz: packages
	@tools/fuzz $(FUZZ_SECONDS)

# Small cases come into build/search.
search: build
	@kinds=$$(python3 -B tests/differential/kinds.py) && set -- $$kinds; for kind in $$kinds; do \
	    TARTAN=build/tartan python3 -B tests/differential/search.py $$kind --first $(FIRST) --seeds 1000000000 \
	        --seconds $$(($(SECONDS) / $$#)) --jobs $(JOBS) --out build/search || wrong=1; \
	done; test -z "$$wrong"

install: build
	@DESTDIR='$(DESTDIR)' cmake --install build

uninstall:
	@DESTDIR='$(DESTDIR)' cmake -DMANIFEST=build/install_manifest.txt -P cmake/uninstall.cmake

clean:
	@rm -rf build build-python build-site build-wasm build-arm build-asan build-asan-quick build-fuzz build-package build-parts demo
