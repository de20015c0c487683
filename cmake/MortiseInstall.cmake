# find_package(Mortise) for applications that use the libraries: the targets Mortise::<package>.
include(CMakePackageConfigHelpers)
get_property(mortise_packages GLOBAL PROPERTY MORTISE_PACKAGES)
set(mortise_finds "")
foreach(package IN LISTS mortise_packages)
  get_property(finds GLOBAL PROPERTY MORTISE_FINDS_${package})
  string(APPEND mortise_finds "set(mortise_finds_${package} ${finds})\n")
endforeach()
# libmortise needs nothing else at configuration.
string(APPEND mortise_finds "set(mortise_finds_shared \"\")\n")
list(JOIN mortise_packages ", " mortise_component_names)
string(APPEND mortise_component_names ", shared")
set(config_directory "${CMAKE_INSTALL_LIBDIR}/cmake/Mortise")
configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/MortiseConfig.cmake.in" "${PROJECT_BINARY_DIR}/MortiseConfig.cmake"
  INSTALL_DESTINATION "${config_directory}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/MortiseConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/MortiseConfig.cmake" "${PROJECT_BINARY_DIR}/MortiseConfigVersion.cmake" "${CMAKE_CURRENT_LIST_DIR}/MortiseFind.cmake"
  DESTINATION "${config_directory}" COMPONENT development)
install(DIRECTORY "${CMAKE_CURRENT_LIST_DIR}/find" DESTINATION "${config_directory}" COMPONENT development)
file(COPY "${CMAKE_CURRENT_LIST_DIR}/MortiseFind.cmake" "${CMAKE_CURRENT_LIST_DIR}/find" DESTINATION "${PROJECT_BINARY_DIR}")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/inputs" DESTINATION "${CMAKE_INSTALL_DATADIR}/mortise" COMPONENT program)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/docs/reference/" DESTINATION "${CMAKE_INSTALL_DATADIR}/mortise/schema" COMPONENT program FILES_MATCHING PATTERN "*.rng")
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" "${PROJECT_SOURCE_DIR}/README.md" "${PROJECT_SOURCE_DIR}/CHANGELOG.md" DESTINATION "${CMAKE_INSTALL_DOCDIR}"
  COMPONENT program)
file(GLOB pages "${PROJECT_SOURCE_DIR}/docs/*.md")
install(FILES ${pages} DESTINATION "${CMAKE_INSTALL_DOCDIR}/docs" COMPONENT program)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/tests/install/consumer/" DESTINATION "${CMAKE_INSTALL_DATADIR}/mortise/examples/host" COMPONENT development)
install(EXPORT MortiseTargets NAMESPACE Mortise:: DESTINATION "${config_directory}" COMPONENT development)
# The build itself can be found as well as what is installed from it.
export(EXPORT MortiseTargets NAMESPACE Mortise:: FILE "${PROJECT_BINARY_DIR}/MortiseTargets.cmake")
