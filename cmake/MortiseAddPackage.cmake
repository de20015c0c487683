# Several sources of a target are compiled as one: what their headers bring is compiled once for all of them, and a first build takes fewer seconds.
# So names in unnamed namespaces have to differ within a package. To work on one file: -DMORTISE_UNITY=OFF.
option(MORTISE_UNITY "Compile several sources of a package as one, where that pays" ON)

function(mortise_compile_together target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${MORTISE_UNITY} UNITY_BUILD_BATCH_SIZE 5)
endfunction()

# mortise_add_package(<name> USES <packages and libraries> [PRIVATE_USES <libraries>])
# A library Mortise::<name> from the sources below packages/<name>/src with the public headers below packages/<name>/include/mortise/<name>.
# Large packages have rooms: folders of src and of include/mortise/<name>.
function(mortise_add_package name)
  cmake_parse_arguments(PARSE_ARGV 1 package "" "" "USES;PRIVATE_USES")
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/src/*.cpp")
  set(link_type PUBLIC)
  if(sources)
    add_library(mortise_${name} ${sources})
    mortise_use_precompiled_headers(mortise_${name} program)
  else()
    add_library(mortise_${name} INTERFACE)
    set(link_type INTERFACE)
  endif()
  add_library(Mortise::${name} ALIAS mortise_${name})
  target_include_directories(mortise_${name} ${link_type} "$<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>" "$<INSTALL_INTERFACE:include>")
  target_link_libraries(mortise_${name} ${link_type} ${package_USES})
  if(sources)
    target_link_libraries(mortise_${name} PRIVATE ${package_PRIVATE_USES})
  endif()
  set_target_properties(mortise_${name} PROPERTIES EXPORT_NAME ${name})
  install(TARGETS mortise_${name} EXPORT MortiseTargets)
  install(DIRECTORY include/mortise DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
endfunction()
