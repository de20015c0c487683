#pragma once
// The header of netCDF's classic formats.

#include "readers/byte_stream.hpp"

namespace mortise {

/// Reads the header of a file in a classic format (CDF-1, CDF-2 or CDF-5) behind its first four bytes, of which `version` is the last. The library of
/// netCDF takes memory for the counts in it before it looks whether the file has so much.
/// @throws InputError with the byte of a count for which the file has no room, of a variable that lies beyond its end, or of what is no header
void check_netcdf_header(ByteStream& stream, int version);

}  // namespace mortise
