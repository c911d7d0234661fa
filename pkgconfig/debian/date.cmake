# Read by cpack: files in packages bear the date of the commit, or without git that of the change log,
# so that packages of one commit are the same bytes whenever they are made. SOURCE_DATE_EPOCH, where it
# is set, is that date.
if(NOT "$ENV{SOURCE_DATE_EPOCH}" STREQUAL "")
  return()
endif()
execute_process(COMMAND git -C ${CPACK_HRAD_SOURCE_DIR} log -1 --format=%ct
                OUTPUT_VARIABLE date ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
if(NOT date MATCHES "^[0-9]+$")
  file(TIMESTAMP ${CPACK_HRAD_SOURCE_DIR}/CHANGELOG.md date "%s" UTC)
endif()
set(ENV{SOURCE_DATE_EPOCH} ${date})
