# Precompiled headers: what many files include and what is slow to parse. One set is for the program, one, with GoogleTest, for tests of libraries. That
# of position independent code has the headers of the program: a compiler takes no header that was precompiled without it. Tests of the program from
# outside need no library, and have a set of their own.
# Headers with much static data are left out (CLI11, nlohmann json): each source that loads them would compile that data. Most tests from outside use
# nlohmann json.
# A source must still include what it uses: -DMORTISE_PRECOMPILED_HEADERS=OFF shows what is missing.
option(MORTISE_PRECOMPILED_HEADERS "Precompile the headers of Tpetra, Eigen, fmt, GoogleTest and the standard library" ON)

set(mortise_program_headers <algorithm> <array> <cmath> <filesystem> <fstream> <functional> <map> <memory> <optional> <set> <sstream> <string> <vector>
  <fmt/format.h> <fmt/ranges.h> <Eigen/Dense> <Teuchos_CommHelpers.hpp> <Teuchos_ParameterList.hpp>
  <Tpetra_Core.hpp> <Tpetra_CrsGraph.hpp> <Tpetra_CrsMatrix.hpp> <Tpetra_Import.hpp> <Tpetra_Map.hpp> <Tpetra_MultiVector.hpp> <Tpetra_Vector.hpp>)

set(mortise_program_libraries Mortise::trilinos_Tpetra Eigen3::Eigen fmt::fmt)

set(mortise_position_independent_headers ${mortise_program_headers})
set(mortise_position_independent_libraries ${mortise_program_libraries})

set(mortise_test_headers ${mortise_program_headers} <gmock/gmock.h> <gtest/gtest.h>)
set(mortise_test_libraries ${mortise_program_libraries} GTest::gmock GTest::gtest)

set(mortise_program_test_headers <algorithm> <array> <cmath> <filesystem> <fstream> <map> <sstream> <string> <vector> <fmt/format.h> <fmt/ranges.h>
  <nlohmann/json.hpp> <gmock/gmock.h> <gtest/gtest.h>)
set(mortise_program_test_libraries fmt::fmt nlohmann_json::nlohmann_json GTest::gmock GTest::gtest)

# Tests run for a moment: what an optimiser takes is more than what it gives.
function(mortise_optimise_little target)
  target_compile_options(${target} PRIVATE "$<$<CONFIG:Release>:-O1>")
endfunction()

# Code that may become part of a shared library. Its functions call one another directly, as in a program. Static data of templates and inline functions
# are those of each library: two of them in one process may hold different copies of this code, and of Boost's and Eigen's.
function(mortise_position_independent target)
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_compile_options(${target} PRIVATE "$<$<CXX_COMPILER_ID:GNU>:-fno-semantic-interposition;-fno-gnu-unique>")
endfunction()

# Lets the sources of a target compile with a set, program, position_independent, test or program_test, which is built once. Tests are optimised little.
function(mortise_use_precompiled_headers target set)
  if(set MATCHES "test")
    mortise_optimise_little(${target})
  endif()
  if(NOT MORTISE_PRECOMPILED_HEADERS)
    return()
  endif()
  set(owner mortise_precompiled_for_${set})
  if(NOT TARGET ${owner})
    find_package(Eigen3 REQUIRED)
    find_package(fmt REQUIRED)
    if(NOT EXISTS "${PROJECT_BINARY_DIR}/precompiled_for_${set}.cpp")  # a new time stamp would compile all headers and tests again
      file(WRITE "${PROJECT_BINARY_DIR}/precompiled_for_${set}.cpp" "")
    endif()
    add_library(${owner} OBJECT "${PROJECT_BINARY_DIR}/precompiled_for_${set}.cpp")
    target_link_libraries(${owner} PRIVATE ${mortise_${set}_libraries})
    target_precompile_headers(${owner} PRIVATE ${mortise_${set}_headers})
    if(set STREQUAL "position_independent")
      mortise_position_independent(${owner})
    elseif(set MATCHES "test")
      mortise_optimise_little(${owner})
    endif()
  endif()
  target_precompile_headers(${target} REUSE_FROM ${owner})
endfunction()
