# Builds apps/embed_host against what is installed in PREFIX, with the components that it asks for, and compares it with a run of the program.
#   cmake -D PREFIX=... -D SOURCE=... -D SCRATCH=... -D GENERATOR=... -D MPIEXEC=... -D PYTHON=... -P check_embed_host.cmake
cmake_minimum_required(VERSION 3.25)

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE failed OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(failed)
    message(FATAL_ERROR "failed: ${ARGN}\n${output}")
  endif()
  message(STATUS "${output}")
endfunction()

file(REMOVE_RECURSE "${SCRATCH}")
run("${CMAKE_COMMAND}" -S "${SOURCE}/apps/embed_host" -B "${SCRATCH}/build" -G "${GENERATOR}" "-DCMAKE_PREFIX_PATH=${PREFIX}"
  -DCMAKE_BUILD_TYPE=Release)
run("${CMAKE_COMMAND}" --build "${SCRATCH}/build")
run("${PREFIX}/bin/mortise" run "${SOURCE}/apps/embed_host/blocks.xml" -o "${SCRATCH}/run")
foreach(ranks 1 2 4)
  run("${MPIEXEC}" -n ${ranks} "${SCRATCH}/build/embed_host" steps "${SCRATCH}/host${ranks}")
  file(GLOB results "${SCRATCH}/host${ranks}.*")
  run("${PYTHON}" "${SOURCE}/tests/install/compare_embed_host.py" "${PREFIX}/share/mortise/python" "${SCRATCH}/run" ${results})
endforeach()
# Other formulations, and a slave whose edges are flush with the master's.
foreach(variant "penalty;penalty;0.28" "augmented;augmented lagrange;0.28" "dual;dual mortar;0")
  list(GET variant 0 name)
  list(GET variant 1 formulation)
  list(GET variant 2 offset)
  set(results "${SCRATCH}/${name}_${offset}")
  run("${PREFIX}/bin/mortise" run "${SOURCE}/apps/embed_host/blocks.xml" --set "contact/joint/formulation/type=${formulation}"
    --set variables/offset=${offset} -o "${results}_run")
  run("${MPIEXEC}" -n 2 "${SCRATCH}/build/embed_host" steps "${results}" ${name} ${offset})
  run("${PYTHON}" "${SOURCE}/tests/install/compare_embed_host.py" "${PREFIX}/share/mortise/python" "${results}_run" "${results}.0" "${results}.1")
endforeach()
run("${SCRATCH}/build/embed_host" rejects)
