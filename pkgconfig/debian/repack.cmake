# Run by cpack on the packages it has made: by Debian's own tool they are the same bytes whatever the
# umask, which cpack writes into them.
if(NOT CPACK_GENERATOR STREQUAL "DEB")
  return()
endif()

include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)

foreach(package IN LISTS CPACK_PACKAGE_FILES)
  file(REMOVE_RECURSE ${package}.content)
  run(dpkg-deb --raw-extract ${package} ${package}.content)
  run(dpkg-deb --root-owner-group -Z${CPACK_DEBIAN_COMPRESSION_TYPE} --build ${package}.content ${package})
  file(REMOVE_RECURSE ${package}.content)
endforeach()
