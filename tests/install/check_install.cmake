# Installs the build into a scratch prefix, builds a foreign application against it, runs it; the installed program needs no source tree.
# Neither that application nor any library below the readers of input has a symbol of them, or needs what they are made of.
#   cmake -D BUILD=... -D CONSUMER=... -D SCRATCH=... -D GENERATOR=... -D MPIEXEC=... -D NM=... -D READELF=... -P check_install.cmake
cmake_minimum_required(VERSION 3.25)

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE failed OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(failed)
    message(FATAL_ERROR "failed: ${ARGN}\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE "${SCRATCH}")
run("${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${SCRATCH}/prefix")
# As on a machine without the libraries that read input.
run("${CMAKE_COMMAND}" -S "${CONSUMER}" -B "${SCRATCH}/build" -G "${GENERATOR}" "-DCMAKE_PREFIX_PATH=${SCRATCH}/prefix" -DCMAKE_BUILD_TYPE=Debug
  -DCMAKE_DISABLE_FIND_PACKAGE_LibXml2=ON -DCMAKE_DISABLE_FIND_PACKAGE_muparser=ON -DCMAKE_DISABLE_FIND_PACKAGE_nlohmann_json=ON
  -DCMAKE_DISABLE_FIND_PACKAGE_PkgConfig=ON)
run("${CMAKE_COMMAND}" --build "${SCRATCH}/build")
foreach(program first_contact consumer contact_alone)
  run("${SCRATCH}/build/${program}")
  run("${MPIEXEC}" -n 2 "${SCRATCH}/build/${program}")
endforeach()

set(reader "mu::|mortise::(parse_expression|parse_xml|read_text|read_symbols|ReadParameters|CollectParameters)|nlohmann|(^|[^A-Za-z_])xml[A-Z]")
function(refuse_reader file)
  execute_process(COMMAND "${NM}" -C "${file}" OUTPUT_FILE "${SCRATCH}/symbols" ERROR_VARIABLE error RESULT_VARIABLE failed)
  file(STRINGS "${SCRATCH}/symbols" own REGEX "mortise::" LIMIT_COUNT 1)
  if(failed OR NOT own)
    message(FATAL_ERROR "no symbols of Mortise are found in ${file}: ${error}")
  endif()
  file(STRINGS "${SCRATCH}/symbols" found REGEX "${reader}" LIMIT_COUNT 3)
  if(found)
    message(FATAL_ERROR "${file} has symbols of what reads input: ${found}")
  endif()
endfunction()
foreach(package core shape mesh material mortar contact thermal_contact plain solid nonlinear thermal thyra)
  file(GLOB library "${SCRATCH}/prefix/lib*/libmortise_${package}.a" "${SCRATCH}/prefix/lib/*/libmortise_${package}.a")
  if(library)
    refuse_reader("${library}")
  elseif(NOT package STREQUAL "shape")
    message(FATAL_ERROR "there is no library of ${package} below ${SCRATCH}/prefix")
  endif()
endforeach()
foreach(program consumer contact_alone)
  refuse_reader("${SCRATCH}/build/${program}")
  execute_process(COMMAND "${READELF}" -d "${SCRATCH}/build/${program}" OUTPUT_VARIABLE needed)
  if(NOT needed MATCHES "NEEDED" OR needed MATCHES "NEEDED[^\n]*(xml2|expat|muparser)")
    message(FATAL_ERROR "${program} needs a library that reads input:\n${needed}")
  endif()
endforeach()

# A program in C, with what pkg-config says. Of Mortise the library shows the functions of mortise.h alone.
file(GLOB library "${SCRATCH}/prefix/lib*/libmortise.so" "${SCRATCH}/prefix/lib/*/libmortise.so")
get_filename_component(libraries "${library}" DIRECTORY)
run("${CMAKE_COMMAND}" -E env "PKG_CONFIG_PATH=${libraries}/pkgconfig" sh -c
  "mpicc -std=c99 '${CONSUMER}/../plain_hosts/c_host.c' $(pkg-config --cflags --libs mortise) -lm -o '${SCRATCH}/c_host'")
run("${CMAKE_COMMAND}" -E env "LD_LIBRARY_PATH=${libraries}" "${MPIEXEC}" -n 2 "${SCRATCH}/c_host" 2)
execute_process(COMMAND "${NM}" -DC --defined-only "${library}" OUTPUT_FILE "${SCRATCH}/symbols")
file(STRINGS "${SCRATCH}/symbols" shown REGEX " T mortise_")
file(STRINGS "${SCRATCH}/symbols" others REGEX "^[0-9a-f]+ T mortise::" LIMIT_COUNT 3)
list(LENGTH shown functions)
# Static data that the loader would share with another copy of this code in the process.
file(STRINGS "${SCRATCH}/symbols" unique REGEX "^[0-9a-f]+ u " LIMIT_COUNT 3)
if(unique)
  message(FATAL_ERROR "libmortise shows static data of its own: ${unique}")
endif()
if(functions LESS 20 OR others)
  message(FATAL_ERROR "libmortise shows ${functions} functions of mortise.h, and these of C++: ${others}")
endif()

# What find_package says of components that cannot be had.
function(expect_refusal languages component said)
  file(WRITE "${SCRATCH}/refused/CMakeLists.txt" "cmake_minimum_required(VERSION 3.25)\nproject(refused LANGUAGES ${languages})\n"
    "find_package(Mortise REQUIRED COMPONENTS ${component})\n")
  file(REMOVE_RECURSE "${SCRATCH}/refused/build")
  execute_process(COMMAND "${CMAKE_COMMAND}" -S "${SCRATCH}/refused" -B "${SCRATCH}/refused/build" -G "${GENERATOR}"
    "-DCMAKE_PREFIX_PATH=${SCRATCH}/prefix" RESULT_VARIABLE code OUTPUT_QUIET ERROR_VARIABLE error)
  string(REGEX REPLACE "[ \n]+" " " error "${error}")
  if(NOT code OR NOT error MATCHES "${said}")
    message(FATAL_ERROR "find_package of ${component} with ${languages} ends with ${code} and says: ${error}")
  endif()
endfunction()
expect_refusal(CXX contakt "there is no component \"contakt\"; there are core, ")
expect_refusal(C plain "enable_language.CXX. before find_package")

foreach(file share/mortise/schema/scene.rng share/mortise/inputs/paper/patch_test.xml share/doc/Mortise/LICENSE share/mortise/fortran/mortise.f90
    share/bash-completion/completions/mortise share/man/man1/mortise.1 share/mortise/python/mortise_results.py)
  if(NOT EXISTS "${SCRATCH}/prefix/${file}")
    message(FATAL_ERROR "not installed: ${file}")
  endif()
endforeach()
run("${CMAKE_COMMAND}" -E chdir "${SCRATCH}" "${SCRATCH}/prefix/bin/mortise" paper --only patch_test -o page)
if(NOT EXISTS "${SCRATCH}/page/paper.html")
  message(FATAL_ERROR "the installed program drew no page")
endif()
