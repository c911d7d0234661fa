# Debian packages: `cpack` in a build folder makes one of every install component that the build has.
# Configure with -DCMAKE_INSTALL_PREFIX=/usr, so that the files go where Debian has them, and with
# -DCPACK_PACKAGE_CONTACT="Name <address>" of who gives the packages to others.
set(CPACK_PACKAGE_NAME libhrad)
set(CPACK_PACKAGE_VENDOR "The libhrad authors")
if(NOT CPACK_PACKAGE_CONTACT)
  set(CPACK_PACKAGE_CONTACT "The libhrad authors <libhrad@example.org>")  # a name that is nobody's
endif()
if(NOT CPACK_GENERATOR)
  set(CPACK_GENERATOR DEB)
endif()
set(CPACK_STRIP_FILES ON)
set(CPACK_PROJECT_CONFIG_FILE ${PROJECT_SOURCE_DIR}/pkgconfig/debian/date.cmake)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/pkgconfig/debian/finish.cmake)
set(CPACK_POST_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/pkgconfig/debian/repack.cmake)
set(CPACK_HRAD_SOURCE_DIR ${PROJECT_SOURCE_DIR})

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_SOURCE libhrad)
if(NOT CPACK_DEBIAN_PACKAGE_RELEASE)
  set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
endif()
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
# What the binaries are linked with; the shared libraries of this build are in no package yet, and are
# named below.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/lib)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)

set(same "(= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})")
set(abi ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})  # that of the SONAME
set(about "libhrad computes how light, or heat, spreads between diffuse surfaces
that reflect it to one another, by hierarchical radiosity to a stated
accuracy, on the threads of one machine or on several with MPI.
.
")
set(what "radiosity of diffuse surfaces")

# What a program links besides libhrad: with an archive all that is in it, with a shared library nothing.
set(linked)
set(tool_needs)
if(BUILD_SHARED_LIBS)
  set(linked "libhrad${abi} ${same}")
  set(linked_mpi "libhrad-dev ${same}, libhrad-mpi${abi} ${same}")
  set(tool_needs "libhrad${abi} ${same}")
  if(HRAD_MPI)
    string(APPEND tool_needs ", libhrad-mpi${abi} ${same}")
  endif()
else()
  set(linked "libhwloc-dev, zlib1g-dev, libstdc++-dev")
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    string(REGEX MATCH "^[0-9]+" gcc "${CMAKE_CXX_COMPILER_VERSION}")
    set(linked "libhwloc-dev, zlib1g-dev, libstdc++-${gcc}-dev | libstdc++-dev")
  endif()
  if(HRAD_NEEDED_FLAGS MATCHES "-lembree")
    string(APPEND linked ", libembree-dev")
  endif()
  set(linked_mpi "libhrad-dev ${same}")
endif()
set(mpi libopenmpi-dev)
if(MPI_C_INCLUDE_DIRS MATCHES "mpich")
  set(mpi libmpich-dev)
endif()
# Module files are for compilers of one format, which Debian's compilers provide by name.
set(fortran gfortran)
if(CMAKE_Fortran_COMPILER_ID STREQUAL "GNU")
  string(REGEX MATCH "^[0-9]+" gcc "${CMAKE_Fortran_COMPILER_VERSION}")
  string(REGEX MATCH "[^/]*$" format "${HRAD_FORTRAN_MODULE_DIR}")
  set(fortran "gfortran, gfortran-${gcc} | ${format}")
endif()

# add_package(COMPONENT PACKAGE SECTION DEPENDS SYNOPSIS TEXT): nothing where the build has no such
# component.
get_cmake_property(components COMPONENTS)
set(CPACK_COMPONENTS_ALL)
macro(add_package component package section depends synopsis text)
  if("${component}" IN_LIST components)
    string(TOUPPER ${component} key)
    list(APPEND CPACK_COMPONENTS_ALL ${component})
    set(CPACK_DEBIAN_${key}_PACKAGE_NAME ${package})
    set(CPACK_DEBIAN_${key}_PACKAGE_SECTION ${section})
    set(CPACK_DEBIAN_${key}_PACKAGE_DEPENDS "${depends}")
    set(CPACK_DEBIAN_${key}_DESCRIPTION "${synopsis}\n${about}${text}")
  endif()
endmacro()

add_package(runtime hrad science "${tool_needs}" "${what}, command-line tool"
  "This package has the tool hrad, which solves scenes, draws them and answers
questions about them, with its manual pages.")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SUGGESTS "libhrad-dev, openmpi-bin")
add_package(library libhrad${abi} libs "" "${what}, shared library"
  "This package has the library, which needs no MPI.")
add_package(library_mpi libhrad-mpi${abi} libs "libhrad${abi} ${same}" "${what}, shared library for MPI"
  "This package has the library for solvers over several MPI processes.")
foreach(key LIBRARY LIBRARY_MPI)  # the loader's cache is to be renewed
  set(CPACK_DEBIAN_${key}_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/pkgconfig/debian/triggers)
endforeach()
add_package(development libhrad-dev libdevel "${linked}" "${what}, development files"
  "This package has the header, the library to link with, what pkg-config and
CMake find it by, and the manual pages of its functions.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS "hrad, hrad-doc")
add_package(development_mpi libhrad-mpi-dev libdevel "${linked_mpi}, ${mpi}"
  "${what}, development files for MPI"
  "This package has the header and the library to link with for programs whose
solvers are over several MPI processes.")
add_package(fortran libhrad-fortran-dev libdevel "libhrad-dev ${same}, ${fortran}"
  "${what}, Fortran module"
  "This package has the module hrad for programs in Fortran 2008, and its sources
for compilers other than gfortran.")
set(CPACK_DEBIAN_FORTRAN_PACKAGE_SUGGESTS libhrad-mpi-dev)
add_package(python python3-hrad python "python3, python3-numpy, ${linked}" "${what}, Python module"
  "This package has the module hrad for Python 3.")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS python3-mpi4py)
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/pkgconfig/debian/python/postinst
    ${PROJECT_SOURCE_DIR}/pkgconfig/debian/python/prerm)
add_package(documentation hrad-doc doc "" "${what}, documents and examples"
  "This package has the README and programs in C, C++, Fortran and Python.")
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_ARCHITECTURE all)

include(CPack)
