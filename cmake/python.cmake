# The Python of tools and tests: the system's, which has the system's packages. In PATH there may be a version manager's wrapper instead, which
# takes ten times as long to start.
if(NOT Python3_EXECUTABLE AND EXISTS /usr/bin/python3)
  set(Python3_EXECUTABLE /usr/bin/python3)
endif()
find_package(Python3 REQUIRED COMPONENTS Interpreter)

# tartan_tests_use_python(TEST...): `python3` in a test's commands is that one, too.
function(tartan_tests_use_python)
  get_filename_component(folder ${Python3_EXECUTABLE} DIRECTORY)
  set_property(TEST ${ARGN} APPEND PROPERTY ENVIRONMENT_MODIFICATION PATH=path_list_prepend:${folder})
endfunction()
