# Installs the build into a scratch prefix, builds a foreign application against it, runs it; the installed program needs no source tree.
#   cmake -D BUILD=... -D CONSUMER=... -D SCRATCH=... -D GENERATOR=... -D MPIEXEC=... -P check_install.cmake
cmake_minimum_required(VERSION 3.25)

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE failed OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(failed)
    message(FATAL_ERROR "failed: ${ARGN}\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE "${SCRATCH}")
run("${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${SCRATCH}/prefix")
run("${CMAKE_COMMAND}" -S "${CONSUMER}" -B "${SCRATCH}/build" -G "${GENERATOR}" "-DCMAKE_PREFIX_PATH=${SCRATCH}/prefix" -DCMAKE_BUILD_TYPE=Debug)
run("${CMAKE_COMMAND}" --build "${SCRATCH}/build")
run("${SCRATCH}/build/consumer")
run("${MPIEXEC}" -n 2 "${SCRATCH}/build/consumer")
foreach(file share/mortise/schema/scene.rng share/mortise/inputs/paper/patch_test.xml share/doc/Mortise/LICENSE
    share/bash-completion/completions/mortise share/man/man1/mortise.1)
  if(NOT EXISTS "${SCRATCH}/prefix/${file}")
    message(FATAL_ERROR "not installed: ${file}")
  endif()
endforeach()
run("${CMAKE_COMMAND}" -E chdir "${SCRATCH}" "${SCRATCH}/prefix/bin/mortise" paper --only patch_test -o page)
if(NOT EXISTS "${SCRATCH}/page/paper.html")
  message(FATAL_ERROR "the installed program drew no page")
endif()
