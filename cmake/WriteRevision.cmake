# Writes OUTPUT with the git revision of SOURCE, if it changed: cmake -D SOURCE=... -D OUTPUT=... -P WriteRevision.cmake
# "" without git, as in an archive; "-dirty" after it if files have changed.
execute_process(COMMAND git -C "${SOURCE}" describe --always --dirty --exclude=* OUTPUT_VARIABLE revision OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
set(content "#define MORTISE_REVISION \"${revision}\"\n")
set(present "")
if(EXISTS "${OUTPUT}")
  file(READ "${OUTPUT}" present)
endif()
if(NOT content STREQUAL present)
  file(WRITE "${OUTPUT}" "${content}")
endif()
