# cpack -G DEB in the build directory: packages of Debian, mortise with the program and libmortise-dev with the libraries.
set(CPACK_PACKAGE_VENDOR "Mortise")
set(CPACK_PACKAGE_CONTACT "The Mortise authors <mortise@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_RESOURCE_FILE_LICENSE "${PROJECT_SOURCE_DIR}/LICENSE")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_STRIP_FILES ON)
set(CPACK_THREADS 0)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME mortise)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "Finite elements with dual mortar contact and friction: program, scenes, schema")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "openmpi-bin, libopenblas0-pthread")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "python3-matplotlib, python3-h5py, python3-pil")

# What Mortise::contact needs is depended on, what the other libraries need is recommended. Debian's packages of Trilinos do not name one another.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libmortise-dev)
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Finite elements with dual mortar contact and friction: libraries for applications")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS ON)  # of libmortise.so
set(of_contact libopenmpi-dev libtrilinos-tpetra-dev libtrilinos-epetra-dev libtrilinos-kokkos-dev libtrilinos-kokkos-kernels-dev libtrilinos-teuchos-dev
  libtrilinos-sacado-dev libtrilinos-zoltan-dev libptscotch-dev libeigen3-dev libfmt-dev libboost-dev)
file(STRINGS "${CMAKE_CURRENT_LIST_DIR}/apt-packages.txt" of_all REGEX "-dev$")
list(REMOVE_ITEM of_all ${of_contact} libcli11-dev libgtest-dev libgmock-dev)
list(JOIN of_contact ", " CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS)
list(JOIN of_all ", " CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS)
include(CPack)
