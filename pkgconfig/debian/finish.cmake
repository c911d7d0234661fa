# Run by cpack on the installed files before they are packed: what every Debian package has besides.
# Manual pages are compressed, names of functions become links to pages, archives lose what only
# debuggers read, and /usr/share/doc/PACKAGE gets the copyright and the changes.
if(NOT CPACK_GENERATOR STREQUAL "DEB")
  return()
endif()

include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)

function(compress_manual folder)
  file(GLOB pages ${folder}/man*/*)
  foreach(page IN LISTS pages)
    file(READ ${page} text LIMIT 100)
    if(text MATCHES "^\\.so man[0-9]/([^\n]+)\n$")
      file(REMOVE ${page})
      file(CREATE_LINK ${CMAKE_MATCH_1}.gz ${page}.gz SYMBOLIC)
    else()
      run(gzip -9n ${page})
    endif()
  endforeach()
endfunction()

string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)  # of SOURCE_DATE_EPOCH
set(version ${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} key)
  set(package ${CPACK_DEBIAN_${key}_PACKAGE_NAME})
  set(usr ${CPACK_TEMPORARY_DIRECTORY}/${component}${CPACK_PACKAGING_INSTALL_PREFIX})
  compress_manual(${usr}/share/man)
  file(GLOB_RECURSE archives ${usr}/lib/*.a)
  foreach(archive IN LISTS archives)
    run(strip --strip-debug --remove-section=.comment --enable-deterministic-archives ${archive})
  endforeach()
  # Debian has these two elsewhere.
  file(REMOVE ${usr}/share/doc/hrad/LICENSE ${usr}/share/doc/hrad/CHANGELOG.md)

  set(documents ${usr}/share/doc/${package})
  file(COPY ${CPACK_HRAD_SOURCE_DIR}/pkgconfig/debian/copyright DESTINATION ${documents}
       FILE_PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
  configure_file(${CPACK_HRAD_SOURCE_DIR}/CHANGELOG.md ${documents}/changelog COPYONLY)
  file(WRITE ${documents}/changelog.Debian "libhrad (${version}) unstable; urgency=medium

  * Made from the sources of libhrad ${CPACK_PACKAGE_VERSION}, whose changes are in changelog.gz.

 -- ${CPACK_PACKAGE_CONTACT}  ${date}
")
  run(gzip -9n ${documents}/changelog ${documents}/changelog.Debian)
  run(chmod -R u=rwX,go=rX ${CPACK_TEMPORARY_DIRECTORY}/${component})  # whatever the umask
endforeach()
