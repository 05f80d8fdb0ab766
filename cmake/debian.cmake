# Makes of the installed files what Debian wants to have, before cpack packs them: a copyright file, compressed manual pages and changes, archives
# without debugging symbols, and zsh's completion where Debian's zsh looks.
set(share ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/usr/share)
set(doc ${share}/doc/tartan)

file(READ ${doc}/LICENSE license)
file(WRITE ${doc}/copyright "This is Tartan, a rule-authoring language toolchain, packaged by its authors.\n\n${license}")
file(REMOVE ${doc}/LICENSE)
file(RENAME ${doc}/CHANGELOG.md ${doc}/changelog)

file(GLOB pages ${share}/man/man*/*.[1-9])
execute_process(COMMAND gzip -9 -n ${pages} ${doc}/changelog COMMAND_ERROR_IS_FATAL ANY)

file(GLOB_RECURSE archives ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/usr/lib/*.a)
execute_process(COMMAND strip --strip-debug --enable-deterministic-archives ${archives} COMMAND_ERROR_IS_FATAL ANY)

file(RENAME ${share}/zsh/site-functions ${share}/zsh/vendor-completions)
