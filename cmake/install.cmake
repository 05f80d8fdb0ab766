# What others build on: the libraries (shared and static), the header, pkg-config files and the CMake package, the stdlib; manual.cmake adds what is to be read.
#
#   libtartan-runtime  loads modules; plans, genomes, fields, placing. Needs GMP and xxHash only.
#   libtartan-growth   grows surfaces
#   libtartan-mesh     mesh files and algorithms, by OpenMesh
#   libtartan-draw     pictures: SVG by itself, PNG and PDF by cairo
#   libtartan-store    plan libraries and runs in databases, by SQLite
#   libtartan-search   the solver that plans are searched with, CaDiCaL
#   libtartan          compiles, and links all of those
#
# What they call of one another is theirs alone: the symbols are of version TARTAN_PRIVATE and change without notice.
include(CMakePackageConfigHelpers)

file(RELATIVE_PATH TARTAN_PC_UP ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})

# What links a program with threads, without CMake.
set(TARTAN_PC_THREADS "-pthread -lm")

set(TARTAN_LIBRARIES "")

# tartan_library(NAME FOLDERS TARGETS... USES LIBRARIES... NEEDS LIBRARIES... MODULES PKG-CONFIG-MODULES... FLAGS FLAGS...): the objects of the
# folders, on top of other libraries of ours (USES) and of others: NEEDS for CMake, MODULES and FLAGS for pkg-config.
function(tartan_library name)
  cmake_parse_arguments(LIBRARY "" "" "FOLDERS;USES;NEEDS;MODULES;FLAGS" ${ARGN})
  set(objects "")
  foreach(folder ${LIBRARY_FOLDERS})
    tartan_archive_of(${folder} archive)
    list(APPEND objects $<TARGET_OBJECTS:${archive}>)
  endforeach()
  foreach(kind shared static)
    set(target lib${name}-${kind})
    string(TOUPPER ${kind} type)
    add_library(${target} ${type} ${objects})
    set_target_properties(${target} PROPERTIES OUTPUT_NAME ${name} EXPORT_NAME ${name}-${kind} LINKER_LANGUAGE C)
    target_include_directories(${target} INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
    foreach(used ${LIBRARY_USES})
      target_link_libraries(${target} PUBLIC lib${used}-${kind})
    endforeach()
    target_link_libraries(${target} PRIVATE ${LIBRARY_NEEDS})
    install(TARGETS ${target} EXPORT tartan-targets
      LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  endforeach()
  # One shared library of ours need not be linked again when another one changes.
  set_target_properties(lib${name}-shared PROPERTIES EXPORT_NAME ${name} VERSION ${TARTAN_SOVERSION}.0 SOVERSION ${TARTAN_SOVERSION}
    LINK_DEPENDS_NO_SHARED ON)
  target_link_options(lib${name}-shared PRIVATE -Wl,--version-script=${PROJECT_SOURCE_DIR}/cmake/exports.map)
  # clang leaves the sanitizers' names in a shared library to the program
  if(NOT CMAKE_C_FLAGS MATCHES "-fsanitize=")
    target_link_options(lib${name}-shared PRIVATE -Wl,--no-undefined)
  endif()
  set(TARTAN_PC_NAME ${name})
  set(TARTAN_PC_USES "")
  foreach(used ${LIBRARY_USES})
    string(APPEND TARTAN_PC_USES " ${used} = ${PROJECT_VERSION}")
  endforeach()
  list(JOIN LIBRARY_MODULES " " TARTAN_PC_MODULES)
  list(JOIN LIBRARY_FLAGS " " TARTAN_PC_FLAGS)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/tartan.pc.in ${PROJECT_BINARY_DIR}/${name}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endfunction()

# Each folder is in one library. Those of a part that is left out hold nothing but its refusals, which go where they are called.
get_property(folders GLOBAL PROPERTY TARTAN_FOLDERS)
foreach(folder ${folders})
  get_property(part GLOBAL PROPERTY TARTAN_PART_${folder})
  if(folder STREQUAL "api-mesh")
    set(part MESH)
  elseif(folder STREQUAL "api-run")
    set(part STORE)
  endif()
  if(folder MATCHES "^(lsp|studio-.*)$") # of programs alone
    continue()
  elseif(folder STREQUAL "runtime-plan-search") # asked by what libtartan has alone
    list(APPEND TARTAN_COMPILER_FOLDERS ${folder})
  elseif(folder MATCHES "^(runtime-(draw|chart|scene)|api-draw$)|-picture$") # an SVG needs no part
    list(APPEND TARTAN_DRAW_FOLDERS ${folder})
  elseif(part AND TARTAN_WITH_${part})
    list(APPEND TARTAN_${part}_FOLDERS ${folder})
  elseif(part)
    list(APPEND TARTAN_COMPILER_FOLDERS ${folder})
  elseif(folder MATCHES "^(runtime|api)-growth" AND NOT folder STREQUAL "runtime-growth-model") # modules hold growth's tables
    list(APPEND TARTAN_GROWTH_FOLDERS ${folder})
  elseif(folder MATCHES "^(runtime|api-(base|plan|genome|geometry|field|place)$)")
    list(APPEND TARTAN_RUNTIME_FOLDERS ${folder})
  else()
    list(APPEND TARTAN_COMPILER_FOLDERS ${folder})
  endif()
endforeach()

set(threads Threads::Threads m)
tartan_library(tartan-runtime FOLDERS ${TARTAN_RUNTIME_FOLDERS} NEEDS PkgConfig::GMP PkgConfig::XXHASH ${threads} MODULES gmp libxxhash)
tartan_library(tartan-growth FOLDERS ${TARTAN_GROWTH_FOLDERS} USES tartan-runtime NEEDS PkgConfig::XXHASH ${threads} MODULES libxxhash)
set(parts "")
if(TARTAN_WITH_MESH)
  tartan_library(tartan-mesh FOLDERS ${TARTAN_MESH_FOLDERS} USES tartan-runtime NEEDS ${TARTAN_OPENMESH} FLAGS ${TARTAN_OPENMESH})
  list(APPEND parts tartan-mesh)
endif()
set(drawing "")
set(drawing_modules "")
if(TARTAN_WITH_DRAW)
  set(drawing PkgConfig::CAIRO PkgConfig::ZLIB)
  set(drawing_modules cairo cairo-pdf zlib)
endif()
tartan_library(tartan-draw FOLDERS ${TARTAN_DRAW_FOLDERS} USES tartan-growth tartan-runtime NEEDS ${drawing} PkgConfig::GMP ${threads}
  MODULES ${drawing_modules})
list(APPEND parts tartan-draw)
if(TARTAN_WITH_STORE)
  tartan_library(tartan-store FOLDERS ${TARTAN_STORE_FOLDERS} USES tartan-runtime NEEDS PkgConfig::SQLITE PkgConfig::GMP PkgConfig::XXHASH
    MODULES sqlite3)
  list(APPEND parts tartan-store)
endif()
if(TARTAN_WITH_SEARCH)
  tartan_library(tartan-search FOLDERS ${TARTAN_SEARCH_FOLDERS} USES tartan-runtime NEEDS ${TARTAN_CADICAL} FLAGS ${TARTAN_CADICAL})
  list(APPEND parts tartan-search)
endif()
tartan_library(tartan FOLDERS ${TARTAN_COMPILER_FOLDERS} USES ${parts} tartan-growth tartan-runtime
  NEEDS PkgConfig::JANSSON PkgConfig::GMP PkgConfig::XXHASH PkgConfig::ZSTD ${threads} MODULES jansson libzstd)

# The command loads the parts from the libraries beside it. Where the system looks anyway, nothing is said of where they are.
if(TARTAN_LOAD_PARTS)
  foreach(part ${parts})
    add_dependencies(tartan lib${part}-shared)
  endforeach()
  if(CMAKE_INSTALL_PREFIX STREQUAL "/usr")
    set_target_properties(tartan PROPERTIES BUILD_RPATH "$ORIGIN")
  else()
    set_target_properties(tartan PROPERTIES INSTALL_RPATH "$ORIGIN;$ORIGIN/../${CMAKE_INSTALL_LIBDIR}" BUILD_WITH_INSTALL_RPATH ON)
  endif()
endif()
install(TARGETS tartan RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY include/tartan DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
install(DIRECTORY stdlib DESTINATION ${CMAKE_INSTALL_DATADIR}/tartan)
install(FILES README.md CHANGELOG.md LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

set(TARTAN_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/tartan)
install(EXPORT tartan-targets NAMESPACE tartan:: DESTINATION ${TARTAN_PACKAGE_DIR})
configure_package_config_file(cmake/tartanConfig.cmake.in ${PROJECT_BINARY_DIR}/tartanConfig.cmake INSTALL_DESTINATION ${TARTAN_PACKAGE_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/tartanConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/tartanConfig.cmake ${PROJECT_BINARY_DIR}/tartanConfigVersion.cmake DESTINATION ${TARTAN_PACKAGE_DIR})

include(cmake/manual.cmake)
