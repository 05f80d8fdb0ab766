# One target a folder: tartan_folder(PATH USES FOLDERS... NEEDS LIBRARIES... PART PART) makes the static library of the folder's sources.
#
# USES names the folders whose headers it may include; docs/internals.md has the same table, and tests/structure.py holds both to the
# includes. The archives let a test link what it tests and nothing else; the libraries that are installed are made of their objects.
#
# A folder of an optional part (DRAW, MESH, STORE) has a file absent.c. It is built in place of all others where TARTAN_WITH_<PART> is
# off, needs no library, and says what is missing.
set_property(GLOBAL PROPERTY TARTAN_FOLDERS "")

function(tartan_folder path)
  cmake_parse_arguments(FOLDER "" "PART" "USES;NEEDS;EXTRA" ${ARGN})
  string(REPLACE "/" "-" target ${path})
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${path}/*.c ${PROJECT_SOURCE_DIR}/${path}/*.cc)
  if(FOLDER_PART AND NOT TARTAN_WITH_${FOLDER_PART})
    set(sources ${PROJECT_SOURCE_DIR}/${path}/absent.c)
    set(FOLDER_NEEDS "")
  else()
    list(FILTER sources EXCLUDE REGEX "/absent\\.c$")
  endif()
  add_library(${target} STATIC ${sources} ${FOLDER_EXTRA})
  target_include_directories(${target} PUBLIC ${PROJECT_SOURCE_DIR})
  foreach(used ${FOLDER_USES})
    string(REPLACE "/" "-" used ${used})
    target_link_libraries(${target} PUBLIC ${used})
  endforeach()
  target_link_libraries(${target} PUBLIC ${FOLDER_NEEDS})
  tartan_warnings(${target})
  set_property(GLOBAL APPEND PROPERTY TARTAN_FOLDERS ${target})
  set_property(GLOBAL PROPERTY TARTAN_PART_${target} "${FOLDER_PART}")
endfunction()
