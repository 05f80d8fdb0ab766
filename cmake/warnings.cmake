# The warnings that our own code is held to; generated parsers get none.
set(TARTAN_WARNINGS -Wall -Wextra -Wpedantic -Wshadow -Wstrict-prototypes -Wmissing-prototypes -Wvla -Wundef
    -Wpointer-arith -Wwrite-strings -Wcast-qual -Wformat=2)
if(CMAKE_C_COMPILER_ID STREQUAL GNU)
  list(APPEND TARTAN_WARNINGS -Wno-format-truncation) # messages are cut to their buffers on purpose
endif()
if(CMAKE_SYSTEM_PROCESSOR STREQUAL wasm32) # what 64 bits count is not cut to sizes of 32 unseen
  list(APPEND TARTAN_WARNINGS -Wshorten-64-to-32)
endif()
if(TARTAN_WERROR)
  list(APPEND TARTAN_WARNINGS -Werror)
endif()

function(tartan_warnings target)
  target_compile_options(${target} PRIVATE $<$<COMPILE_LANGUAGE:C>:${TARTAN_WARNINGS}>)
endfunction()
