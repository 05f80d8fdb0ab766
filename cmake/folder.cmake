# One target a folder: tartan_folder(PATH USES FOLDERS... NEEDS LIBRARIES... PART PART) makes the static library of the folder's sources.
#
# USES names the folders whose headers it may include; docs/internals.md has the same table, and tests/structure.py holds both to the
# includes. The archives let a test link what it tests and nothing else; the libraries that are installed are made of their objects.
#
# A folder of an optional part (DRAW, MESH, STORE, SEARCH) has a file loaded.c, whose functions find the others in the part's shared library while the
# program runs. A target with the property TARTAN_LOADS_PARTS links that file in place of the others; every target does where TARTAN_WITH_<PART>
# is off, and then nothing is found and what is missing is said (runtime/base/part.h).
set_property(GLOBAL PROPERTY TARTAN_FOLDERS "")

# tartan_archive(TARGET SOURCES FOLDERS LIBRARIES): a static library that may include the folders' headers.
function(tartan_archive target sources uses needs)
  add_library(${target} STATIC ${sources})
  target_include_directories(${target} PUBLIC ${PROJECT_SOURCE_DIR})
  foreach(used ${uses})
    string(REPLACE "/" "-" used ${used})
    target_link_libraries(${target} PUBLIC ${used})
  endforeach()
  target_link_libraries(${target} PUBLIC ${needs})
  tartan_warnings(${target})
endfunction()

function(tartan_folder path)
  cmake_parse_arguments(FOLDER "" "PART" "USES;NEEDS;EXTRA" ${ARGN})
  string(REPLACE "/" "-" target ${path})
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${path}/*.c ${PROJECT_SOURCE_DIR}/${path}/*.cc)
  list(FILTER sources EXCLUDE REGEX "/loaded\\.c$")
  if(NOT FOLDER_PART)
    tartan_archive(${target} "${sources};${FOLDER_EXTRA}" "${FOLDER_USES}" "${FOLDER_NEEDS}")
  elseif(TARTAN_WITH_${FOLDER_PART})
    tartan_archive(${target}-linked "${sources}" "${FOLDER_USES}" "${FOLDER_NEEDS}")
    tartan_archive(${target}-loaded ${PROJECT_SOURCE_DIR}/${path}/loaded.c "${FOLDER_USES}" "")
    add_library(${target} INTERFACE)
    target_link_libraries(${target} INTERFACE $<IF:$<BOOL:$<TARGET_PROPERTY:TARTAN_LOADS_PARTS>>,${target}-loaded,${target}-linked>)
  else()
    tartan_archive(${target} ${PROJECT_SOURCE_DIR}/${path}/loaded.c "${FOLDER_USES}" "")
  endif()
  set_property(GLOBAL APPEND PROPERTY TARTAN_FOLDERS ${target})
  set_property(GLOBAL PROPERTY TARTAN_PART_${target} "${FOLDER_PART}")
endfunction()

# tartan_archive_of(FOLDER RESULT): the target that has the objects of a folder's own sources.
function(tartan_archive_of folder result)
  if(TARGET ${folder}-linked)
    string(APPEND folder -linked)
  endif()
  set(${result} ${folder} PARENT_SCOPE)
endfunction()
