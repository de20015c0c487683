#pragma once
// For programs that look for leaks.

#ifdef __SANITIZE_ADDRESS__
// Open MPI unloads its components in MPI_Finalize, before leaks are looked for: then the leak checker neither finds what their static data points
// to nor can it name them. So nothing is unloaded.
extern "C" int dlclose(void*) { return 0; }
#endif
