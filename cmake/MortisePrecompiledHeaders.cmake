# One set of precompiled headers for all packages and tests: what nearly every file includes and what is slow to parse. They are built once and reused.
# A source must still include what it uses: -DMORTISE_PRECOMPILED_HEADERS=OFF shows what is missing.
option(MORTISE_PRECOMPILED_HEADERS "Precompile the headers of Tpetra, Eigen, fmt and the standard library" ON)

# Lets the sources of a target compile with them.
function(mortise_use_precompiled_headers target)
  if(NOT MORTISE_PRECOMPILED_HEADERS)
    return()
  endif()
  if(NOT TARGET mortise_precompiled)
    file(WRITE "${PROJECT_BINARY_DIR}/precompiled.cpp" "")
    add_library(mortise_precompiled OBJECT "${PROJECT_BINARY_DIR}/precompiled.cpp")
    target_link_libraries(mortise_precompiled PRIVATE Mortise::trilinos Eigen3::Eigen fmt::fmt)
    target_precompile_headers(mortise_precompiled PRIVATE <algorithm> <array> <cmath> <functional> <map> <memory> <optional> <string> <vector>
      <fmt/format.h> <Eigen/Core> <Teuchos_CommHelpers.hpp> <Tpetra_Core.hpp> <Tpetra_CrsGraph.hpp> <Tpetra_CrsMatrix.hpp> <Tpetra_Import.hpp>
      <Tpetra_Map.hpp> <Tpetra_MultiVector.hpp> <Tpetra_Vector.hpp>)
  endif()
  target_precompile_headers(${target} REUSE_FROM mortise_precompiled)
endfunction()
