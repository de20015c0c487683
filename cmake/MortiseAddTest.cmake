# mortise_add_unit_tests(<package> USES <targets>)
# tests/unit/<package>/*_test.cpp make one executable that runs on one rank; each *_test.np<digits>.cpp makes its own and runs on as many
# ranks as each digit says (np123: on 1, 2 and 3). Their label is the package: ctest -L mortar. Those on one rank also have the label quick.
find_package(GTest REQUIRED)

# More ranks than cores are fine: they are not bound to cores (two tests at a time would share one) and yield when they wait.
set(MORTISE_MPI_ENVIRONMENT OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
  OMPI_MCA_hwloc_base_binding_policy=none OMPI_MCA_btl_vader_single_copy_mechanism=none OMPI_MCA_mpi_yield_when_idle=1 OMP_NUM_THREADS=1
  OPENBLAS_NUM_THREADS=1)

# Sanitizers make a program slower by about ten.
set(mortise_test_seconds 300)
if(MORTISE_SANITIZE)
  set(mortise_test_seconds 3000)
endif()

# One rank is run without mpirun, without a daemon and without a network: they take longer to start than most tests to run.
set(MORTISE_ALONE_ENVIRONMENT OMPI_MCA_ess_singleton_isolated=1 OMPI_MCA_btl=self OMPI_MCA_pml=ob1 OMPI_MCA_orte_create_session_dirs=0
  OMPI_MCA_sharedfp=individual OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1)

function(mortise_add_mpi_test name executable ranks)
  if(ranks EQUAL 1)
    add_test(NAME ${name} COMMAND ${executable} ${ARGN})
    set(environment "${MORTISE_ALONE_ENVIRONMENT}")
  else()
    add_test(NAME ${name} COMMAND ${MPIEXEC_EXECUTABLE} ${MPIEXEC_NUMPROC_FLAG} ${ranks} $<TARGET_FILE:${executable}> ${ARGN})
    set(environment "${MORTISE_MPI_ENVIRONMENT}")
  endif()
  set_tests_properties(${name} PROPERTIES PROCESSORS ${ranks} TIMEOUT ${mortise_test_seconds} ENVIRONMENT "${environment}")
endfunction()

function(mortise_add_unit_tests package)
  cmake_parse_arguments(PARSE_ARGV 1 test "" "" "USES")
  file(GLOB serial CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/*_test.cpp")
  if(serial)
    add_executable(test_${package} ${serial})
    target_link_libraries(test_${package} PRIVATE ${test_USES} mortise_test_main)
    mortise_use_precompiled_headers(test_${package} test)
    mortise_add_mpi_test(unit.${package} test_${package} 1)
    set_tests_properties(unit.${package} PROPERTIES LABELS "${package};quick")
  endif()
  file(GLOB parallel CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/*_test.np*.cpp")
  foreach(source ${parallel})
    get_filename_component(file ${source} NAME)
    string(REGEX MATCH "^(.*)_test\\.np([0-9]+)\\.cpp$" matched "${file}")
    set(stem "${CMAKE_MATCH_1}")
    set(digits "${CMAKE_MATCH_2}")
    add_executable(test_${package}_${stem} ${source})
    target_link_libraries(test_${package}_${stem} PRIVATE ${test_USES} mortise_test_main)
    mortise_use_precompiled_headers(test_${package}_${stem} test)
    string(REGEX MATCHALL "[0-9]" digits "${digits}")
    foreach(ranks ${digits})
      set(name unit.${package}.${stem}.np${ranks})
      mortise_add_mpi_test(${name} test_${package}_${stem} ${ranks})
      set(labels ${package})
      if(ranks EQUAL 1)
        list(APPEND labels quick)
      endif()
      set_tests_properties(${name} PROPERTIES LABELS "${labels}")
    endforeach()
  endforeach()
endfunction()
