// Feeds one target, MORTISE_FUZZ_TARGET, with the bytes of libFuzzer.

#include <Tpetra_Core.hpp>
#include <cstddef>
#include <cstdint>
#include <string>

#include "fuzz_targets.hpp"

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  new Tpetra::ScopeGuard(argc, argv);  // libFuzzer ends the process without a way back to here
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const mortise::fuzz::Target& target = mortise::fuzz::target(MORTISE_FUZZ_TARGET);
  mortise::fuzz::read_or_refuse(target, std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
