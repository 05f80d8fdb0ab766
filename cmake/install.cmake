# What others build on: the libraries (shared and static), the header, pkg-config files and the CMake package, the stdlib; manual.cmake adds what is to be read.
#
# libtartan-runtime loads and runs modules; libtartan can compile too and holds the runtime whole: a program links the one or the other.
include(CMakePackageConfigHelpers)

get_property(folders GLOBAL PROPERTY TARTAN_FOLDERS)
set(TARTAN_OBJECTS "")
set(TARTAN_RUNTIME_OBJECTS "")
foreach(folder ${folders})
  if(folder MATCHES "^(runtime|api)" AND NOT folder STREQUAL "api-compiler")
    list(APPEND TARTAN_RUNTIME_OBJECTS $<TARGET_OBJECTS:${folder}>)
  endif()
  if(NOT folder STREQUAL "lsp")
    list(APPEND TARTAN_OBJECTS $<TARGET_OBJECTS:${folder}>)
  endif()
endforeach()
set(TARTAN_LIBRARY_NEEDS ${TARTAN_OPENMESH} PkgConfig::GMP PkgConfig::SQLITE PkgConfig::CAIRO PkgConfig::JANSSON PkgConfig::XXHASH OpenMP::OpenMP_C
    Threads::Threads m)
set(TARTAN_PC_REQUIRES "gmp sqlite3 cairo cairo-svg cairo-pdf jansson libxxhash")
file(RELATIVE_PATH TARTAN_PC_UP ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
if(CMAKE_C_COMPILER_ID STREQUAL GNU)
  set(TARTAN_PC_LIBS "-lgomp -pthread -lm")
else()
  list(JOIN OpenMP_C_LIBRARIES " " TARTAN_PC_LIBS)
  string(APPEND TARTAN_PC_LIBS " -pthread -lm")
endif()
list(JOIN TARTAN_OPENMESH " " TARTAN_PC_OPENMESH)
string(PREPEND TARTAN_PC_LIBS "${TARTAN_PC_OPENMESH} ")

# Before 1.0 the soname holds major and minor: every minor version may break the ABI.
set(TARTAN_SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})

function(tartan_library name objects)
  foreach(kind shared static)
    set(target lib${name}-${kind})
    string(TOUPPER ${kind} type)
    add_library(${target} ${type} ${objects})
    set_target_properties(${target} PROPERTIES OUTPUT_NAME ${name} EXPORT_NAME ${name}-${kind} LINKER_LANGUAGE C)
    target_include_directories(${target} INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
    target_link_libraries(${target} PRIVATE ${TARTAN_LIBRARY_NEEDS})
    install(TARGETS ${target} EXPORT tartan-targets
      LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  endforeach()
  set_target_properties(lib${name}-shared PROPERTIES EXPORT_NAME ${name} VERSION ${PROJECT_VERSION} SOVERSION ${TARTAN_SOVERSION})
  target_link_options(lib${name}-shared PRIVATE -Wl,--version-script=${PROJECT_SOURCE_DIR}/cmake/exports.map)
  # clang leaves the sanitizers' names in a shared library to the program
  if(NOT CMAKE_C_FLAGS MATCHES "-fsanitize=")
    target_link_options(lib${name}-shared PRIVATE -Wl,--no-undefined)
  endif()
  set(TARTAN_PC_NAME ${name})
  configure_file(${PROJECT_SOURCE_DIR}/cmake/tartan.pc.in ${PROJECT_BINARY_DIR}/${name}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endfunction()

tartan_library(tartan-runtime "${TARTAN_RUNTIME_OBJECTS}")
tartan_library(tartan "${TARTAN_OBJECTS}")

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
