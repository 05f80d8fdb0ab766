# The libraries that we link, from Debian's source packages: GMP's mini-gmp, jansson, xxHash, zstd, and cmocka for unit tests. They are fetched into the build
# (tools/debian-sources); TARTAN_WASM_SOURCES names a folder that has them already, each in a folder of its package's name.
set(TARTAN_WASM_SOURCES ${PROJECT_BINARY_DIR}/sources CACHE PATH "Folder of the sources of gmp, jansson, xxhash and libzstd")
set(packages gmp jansson xxhash libzstd)
if(TARTAN_TESTS)
  list(APPEND packages cmocka)
endif()
execute_process(COMMAND ${PROJECT_SOURCE_DIR}/tools/debian-sources ${TARTAN_WASM_SOURCES} ${packages} COMMAND_ERROR_IS_FATAL ANY)

# tartan_outside(MODULE SOURCES... INCLUDES FOLDERS...): a library of others, under the name that pkg-config's has elsewhere. Its warnings are not ours.
function(tartan_outside module)
  cmake_parse_arguments(OUTSIDE "" "" "SOURCES;INCLUDES;DEFINES;OPTIONS" ${ARGN})
  string(TOLOWER outside-${module} target)
  add_library(${target} STATIC ${OUTSIDE_SOURCES})
  target_include_directories(${target} SYSTEM PUBLIC ${OUTSIDE_INCLUDES})
  target_compile_definitions(${target} PRIVATE ${OUTSIDE_DEFINES})
  target_compile_options(${target} PRIVATE -w ${OUTSIDE_OPTIONS})
  add_library(PkgConfig::${module} ALIAS ${target})
endfunction()

set(sources ${TARTAN_WASM_SOURCES})
tartan_outside(GMP SOURCES ${CMAKE_CURRENT_LIST_DIR}/gmp.c INCLUDES ${CMAKE_CURRENT_LIST_DIR} ${sources}/gmp/mini-gmp OPTIONS -O2)

# jansson's configuration, with what emscripten's C library has.
set(json_inline inline)
set(json_have_long_long 1)
set(json_have_localeconv 1)
set(json_have_atomic_builtins 1)
set(json_have_sync_builtins 1)
configure_file(${sources}/jansson/src/jansson_config.h.in ${PROJECT_BINARY_DIR}/jansson/jansson_config.h @ONLY)
file(WRITE ${PROJECT_BINARY_DIR}/jansson/jansson_private_config.h.new "#define INITIAL_HASHTABLE_ORDER 3\n")
file(COPY_FILE ${PROJECT_BINARY_DIR}/jansson/jansson_private_config.h.new ${PROJECT_BINARY_DIR}/jansson/jansson_private_config.h ONLY_IF_DIFFERENT)
file(GLOB jansson ${sources}/jansson/src/*.c)
tartan_outside(JANSSON SOURCES ${jansson} INCLUDES ${PROJECT_BINARY_DIR}/jansson ${sources}/jansson/src
  DEFINES HAVE_STDINT_H HAVE_SYS_TYPES_H HAVE_UNISTD_H HAVE_STRTOLL HAVE_CONFIG_H=1)

tartan_outside(XXHASH SOURCES ${sources}/xxhash/xxhash.c INCLUDES ${sources}/xxhash)

file(GLOB zstd ${sources}/libzstd/lib/common/*.c ${sources}/libzstd/lib/compress/*.c ${sources}/libzstd/lib/decompress/*.c)
tartan_outside(ZSTD SOURCES ${zstd} INCLUDES ${sources}/libzstd/lib DEFINES ZSTD_DISABLE_ASM)

if(TARTAN_TESTS)
  tartan_outside(CMOCKA SOURCES ${sources}/cmocka/src/cmocka.c INCLUDES ${sources}/cmocka/include
    DEFINES HAVE_INTTYPES_H HAVE_MALLOC_H HAVE_STRINGS_H HAVE_SIGNAL_H HAVE_STRUCT_TIMESPEC HAVE_CLOCK_REALTIME)
  target_compile_definitions(outside-cmocka PUBLIC _UINTPTR_T) # the C library's is another than its header's
endif()

add_library(Threads::Threads INTERFACE IMPORTED) # there are none, and the C library has their functions
