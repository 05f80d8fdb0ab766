# Manual pages and completion for shells. The binary writes tartan(1), a page a command and the completion from its own tables;
# tools/manual-page makes a page a notation of that notation's page of docs.
set(TARTAN_WRITTEN ${PROJECT_BINARY_DIR}/written)
file(MAKE_DIRECTORY ${TARTAN_WRITTEN})
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS cli/commands.def compiler/notations.def)
set(TARTAN_WRITTEN_FILES "")
set(TARTAN_PRINTED "") # by the binary, all in one step
set(TARTAN_PRINTING "")

# The binary prints it: tartan help WORDS...
macro(tartan_writes name folder)
  list(APPEND TARTAN_PRINTED ${TARTAN_WRITTEN}/${name})
  list(APPEND TARTAN_PRINTING COMMAND tartan help ${ARGN} > ${TARTAN_WRITTEN}/${name})
  install(FILES ${TARTAN_WRITTEN}/${name} DESTINATION ${folder} COMPONENT ${TARTAN_COMPONENT})
endmacro()

set(TARTAN_COMPONENT tartan)
tartan_writes(tartan.1 ${CMAKE_INSTALL_MANDIR}/man1 --man)
file(STRINGS cli/commands.def rows REGEX "^COMMAND")
foreach(row ${rows})
  string(REGEX REPLACE "COMMAND\\((.*)\\).*" "\\1" command ${row})
  string(REPLACE "_" "-" command ${command})
  set(TARTAN_COMPONENT tartan)
  if(command STREQUAL "studio" AND TARTAN_WITH_STUDIO)
    set(TARTAN_COMPONENT studio) # the page of the server, too, which takes the same options
  endif()
  tartan_writes(tartan-${command}.1 ${CMAKE_INSTALL_MANDIR}/man1 --man ${command})
endforeach()

# A page of docs as a page of section 5. Its words are a notation's row, or those of what no notation has for itself: houses, and files that are no rules.
function(tartan_page name page summary)
  set(file ${TARTAN_WRITTEN}/tartan-${name}.5)
  set(source ${PROJECT_SOURCE_DIR}/docs/${page})
  add_custom_command(OUTPUT ${file} DEPENDS ${source} ${PROJECT_SOURCE_DIR}/tools/manual-page compiler/notations.def
    COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/tools/manual-page ${source} ${name} ${summary} ${PROJECT_VERSION} ${TARTAN_DATE} > ${file} VERBATIM)
  install(FILES ${file} DESTINATION ${CMAKE_INSTALL_MANDIR}/man5)
  set(TARTAN_WRITTEN_FILES ${TARTAN_WRITTEN_FILES} ${file} PARENT_SCOPE)
endfunction()

file(STRINGS compiler/notations.def rows REGEX "^[A-Z_]+\\(")
foreach(row ${rows})
  string(REGEX MATCH "\"([^\"]*)\", \"([^\"]*)\", \"([^\"]*)\"\\)$" row "${row}")
  if(CMAKE_MATCH_2)
    tartan_page(${CMAKE_MATCH_2} ${CMAKE_MATCH_1} ${CMAKE_MATCH_3})
  endif()
endforeach()
tartan_page(house house-language.md "forms of houses, and rules and measures about houses")
tartan_page(plans plan-files.md "the formats of files of plans")

set(TARTAN_COMPONENT tartan)

# Each shell looks in a folder of its own, and under a name of its own.
tartan_writes(bash/tartan ${CMAKE_INSTALL_DATADIR}/bash-completion/completions --completion bash)
tartan_writes(zsh/_tartan ${CMAKE_INSTALL_DATADIR}/zsh/site-functions --completion zsh)
tartan_writes(fish/tartan.fish ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d --completion fish)
# The questions, for programs that ask them.
tartan_writes(requests.schema.json ${CMAKE_INSTALL_DATADIR}/tartan --requests schema)
tartan_writes(requests.d.ts ${CMAKE_INSTALL_DATADIR}/tartan --requests types)
file(MAKE_DIRECTORY ${TARTAN_WRITTEN}/bash ${TARTAN_WRITTEN}/zsh ${TARTAN_WRITTEN}/fish)

add_custom_command(OUTPUT ${TARTAN_PRINTED} DEPENDS tartan ${TARTAN_PRINTING} COMMENT "Writing manual pages and completions" VERBATIM)

add_custom_target(manual ALL DEPENDS ${TARTAN_WRITTEN_FILES} ${TARTAN_PRINTED})
