# Mortise::trilinos: Debian's Trilinos has no namespaced targets and its plain ones carry no include directories, so they are wrapped once.
find_package(MPI REQUIRED COMPONENTS CXX)
set(MORTISE_TRILINOS_COMPONENTS Tpetra Amesos2 Belos MueLu NOX Stratimikos Sacado Zoltan Ifpack2 Teko)
find_package(Trilinos REQUIRED COMPONENTS ${MORTISE_TRILINOS_COMPONENTS})

add_library(mortise_trilinos INTERFACE)
add_library(Mortise::trilinos ALIAS mortise_trilinos)
target_include_directories(mortise_trilinos SYSTEM INTERFACE ${Trilinos_INCLUDE_DIRS} ${Trilinos_TPL_INCLUDE_DIRS})
target_link_libraries(mortise_trilinos INTERFACE ${Trilinos_LIBRARIES} MPI::MPI_CXX)
target_compile_definitions(mortise_trilinos INTERFACE OMPI_SKIP_MPICXX)
set_target_properties(mortise_trilinos PROPERTIES EXPORT_NAME trilinos)
install(TARGETS mortise_trilinos EXPORT MortiseTargets)
