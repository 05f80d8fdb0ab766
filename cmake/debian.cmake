# Makes of the installed files what Debian wants to have, before cpack packs them: a copyright file, compressed manual pages and changes, a
# changelog of its own form, which names those, archives without debugging symbols, and zsh's completion where Debian's zsh looks. A folder for
# each package, called by its component.
string(TIMESTAMP now "%a, %d %b %Y %H:%M:%S +0000" UTC) # SOURCE_DATE_EPOCH, if that is given
set(cadical /usr/share/doc/libcadical-dev/copyright)
function(finish root name)
  set(share ${root}/usr/share)
  set(doc ${share}/doc/${name})
  file(READ ${doc}/LICENSE license)
  file(WRITE ${doc}/copyright "This is Tartan, a rule-authoring language toolchain, packaged by its authors.\n\n${license}")
  if(EXISTS ${cadical}) # which is linked statically
    file(READ ${cadical} notice)
    file(APPEND ${doc}/copyright "\nIt holds CaDiCaL:\n\n${notice}")
  endif()
  file(REMOVE ${doc}/LICENSE)
  file(WRITE ${doc}/changelog "tartan (${CPACK_PACKAGE_VERSION}) unstable; urgency=medium

  * What changed is told in CHANGELOG.md.gz, beside this file.

 -- ${CPACK_PACKAGE_CONTACT}  ${now}
")
  file(GLOB pages ${share}/man/man*/*.[1-9])
  execute_process(COMMAND gzip -9 -n ${pages} ${doc}/changelog ${doc}/CHANGELOG.md COMMAND_ERROR_IS_FATAL ANY)
endfunction()

set(root ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/tartan)
finish(${root} tartan)
if(EXISTS ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/mpi)
  finish(${CPACK_TEMPORARY_INSTALL_DIRECTORY}/mpi tartan-mpi)
endif()
if(EXISTS ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/studio)
  finish(${CPACK_TEMPORARY_INSTALL_DIRECTORY}/studio tartan-studio)
endif()
if(EXISTS ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/python)
  finish(${CPACK_TEMPORARY_INSTALL_DIRECTORY}/python python3-tartan)
endif()
file(GLOB_RECURSE archives ${root}/usr/lib/*.a)
execute_process(COMMAND strip --strip-debug --enable-deterministic-archives ${archives} COMMAND_ERROR_IS_FATAL ANY)
file(RENAME ${root}/usr/share/zsh/site-functions ${root}/usr/share/zsh/vendor-completions)
