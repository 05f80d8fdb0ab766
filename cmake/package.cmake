# cpack: a Debian package. Configure with -DCMAKE_INSTALL_PREFIX=/usr for it, as `make package` does, so that libraries go where Debian has them.
# Who packages it: DEBFULLNAME and DEBEMAIL, as for Debian's own tools, or -DTARTAN_MAINTAINER. A name in .invalid is nobody's (RFC 2606).
set(maintainer "The Tartan authors <authors@tartan.invalid>")
if(DEFINED ENV{DEBFULLNAME} AND DEFINED ENV{DEBEMAIL})
  set(maintainer "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
endif()
set(TARTAN_MAINTAINER "${maintainer}" CACHE STRING "Maintainer that the Debian package names")
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME tartan)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL tartan)
set(CPACK_DEBIAN_TARTAN_PACKAGE_NAME tartan)
# Debian's synopsis begins without an article, and lines of a description have 80 characters.
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Rule-authoring language toolchain for rule-based design")
set(CPACK_PACKAGE_CONTACT "${TARTAN_MAINTAINER}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_SECTION devel)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_COMPONENT_TARTAN_DESCRIPTION "Rules that say what makes a plan good are compiled, checked against plans,
and turned into every plan that they allow: counted exactly, ranked, sampled,
listed and drawn. With the libraries and headers to do so in C.")
# What the binary and the libraries need, by the libraries that they are linked to; and ldconfig once they are there.
file(WRITE ${PROJECT_BINARY_DIR}/debian/triggers "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_TARTAN_PACKAGE_CONTROL_EXTRA ${PROJECT_BINARY_DIR}/debian/triggers)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
# Programs that are linked to the archives, or by pkg-config --static, need more.
set(CPACK_DEBIAN_TARTAN_PACKAGE_SUGGESTS "tartan-studio, bash-completion, libcairo2-dev, libgmp-dev, libjansson-dev, libsqlite3-dev, libxxhash-dev, libzstd-dev, pkg-config")
# tartan-mpi, where it was built (mpi/): it runs with the standard library and the pages of the other.
if(TARGET tartan-mpi)
  list(APPEND CPACK_COMPONENTS_ALL mpi)
  set(CPACK_DEBIAN_MPI_PACKAGE_NAME tartan-mpi)
  set(CPACK_DEBIAN_MPI_PACKAGE_DEPENDS "tartan (= ${PROJECT_VERSION})")
  set(CPACK_DEBIAN_MPI_PACKAGE_GENERATE_SHLIBS OFF)
  set(CPACK_COMPONENT_MPI_DESCRIPTION "tartan-mpi does commands of Tartan by MPI: it writes the shards of a plan
library and breeds runs of evolution by many processes, on one machine or on
many, with the same bytes as tartan alone.")
endif()
# tartan-studio, where it was built (studio/): the command `tartan studio` runs it, with libwebsockets, which nothing else needs.
if(TARGET tartan-studio)
  list(APPEND CPACK_COMPONENTS_ALL studio)
  set(CPACK_DEBIAN_STUDIO_PACKAGE_NAME tartan-studio)
  set(CPACK_DEBIAN_STUDIO_PACKAGE_DEPENDS "tartan (= ${PROJECT_VERSION})")
  set(CPACK_DEBIAN_STUDIO_PACKAGE_RECOMMENDS "xdg-utils")
  set(CPACK_DEBIAN_STUDIO_PACKAGE_GENERATE_SHLIBS OFF)
  set(CPACK_COMPONENT_STUDIO_DESCRIPTION "The server of `tartan studio`: a page in the browser on which rules are
written and what they keep is seen at once. It serves one folder, to this
machine alone.")
endif()
# python3-tartan, where it was built (python/): for the system's Python and later ones, by the libraries of tartan.
if(TARGET python-tartan)
  list(APPEND CPACK_COMPONENTS_ALL python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-tartan)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  # The extension module links libtartan, which comes with tartan, and the C library.
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS OFF)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "tartan (= ${PROJECT_VERSION}), python3 (>= 3.9), python3-cffi-backend, libc6")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-numpy, python3-pandas")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_GENERATE_SHLIBS OFF)
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION "The Python package tartan: rule files compiled, libraries of plans and
houses counted, ranked, sampled and measured, surfaces grown and meshed, in
scripts and notebooks.")
endif()
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/debian.cmake)
include(CPack)
