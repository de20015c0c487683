# NetCDFForMPI::netcdf: the netCDF that Exodus II stands on. Where there are two, the one for MPI.
include(FindPackageHandleStandardArgs)
set(NetCDFForMPI_NOT_FOUND_MESSAGE "Debian: libnetcdf-mpi-dev. Elsewhere: netcdf.h and a libnetcdf built with MPI below NetCDFForMPI_ROOT")
find_path(NetCDFForMPI_INCLUDE_DIR netcdf.h)
find_library(NetCDFForMPI_LIBRARY NAMES netcdf_mpi netcdf NAMES_PER_DIR)
find_package_handle_standard_args(NetCDFForMPI REQUIRED_VARS NetCDFForMPI_LIBRARY NetCDFForMPI_INCLUDE_DIR
  REASON_FAILURE_MESSAGE "${NetCDFForMPI_NOT_FOUND_MESSAGE}")
mark_as_advanced(NetCDFForMPI_INCLUDE_DIR NetCDFForMPI_LIBRARY)
if(NetCDFForMPI_FOUND AND NOT TARGET NetCDFForMPI::netcdf)
  add_library(NetCDFForMPI::netcdf UNKNOWN IMPORTED)
  set_target_properties(NetCDFForMPI::netcdf PROPERTIES IMPORTED_LOCATION "${NetCDFForMPI_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${NetCDFForMPI_INCLUDE_DIR}")
endif()
