// Mutations of checkpoints: mostly of words of 8 bytes, which are numbers, ids and sizes there.

#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>
#include <random>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace {

std::uint64_t bits_of(double number) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &number, sizeof bits);
  return bits;
}

std::uint64_t interesting_word(std::minstd_rand& random) {
  const std::uint64_t words[] = {0,
                                 1,
                                 2,
                                 7,
                                 0xff,
                                 std::uint64_t{1} << 31,
                                 std::uint64_t{1} << 32,
                                 std::uint64_t{1} << 40,
                                 std::uint64_t{1} << 61,
                                 std::uint64_t{1} << 62,
                                 std::uint64_t{1} << 63,
                                 (std::uint64_t{1} << 63) - 1,
                                 ~std::uint64_t{0},
                                 bits_of(0.5),
                                 bits_of(-1.0),
                                 bits_of(3.0),
                                 bits_of(256.0),
                                 bits_of(2147483648.0),
                                 bits_of(1e10),
                                 bits_of(1e19),
                                 bits_of(1e300),
                                 bits_of(-1e300),
                                 bits_of(std::numeric_limits<double>::quiet_NaN()),
                                 bits_of(std::numeric_limits<double>::infinity())};
  return words[random() % std::size(words)];
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size, unsigned seed) {
  std::minstd_rand random(seed);
  constexpr std::size_t word = 8;
  if (size < word || random() % 3 == 0) return LLVMFuzzerMutate(data, size, max_size);
  for (auto changes = 1 + random() % 3; changes > 0; --changes) {
    const std::uint64_t value = interesting_word(random);
    std::memcpy(data + word * (random() % (size / word)), &value, word);
  }
  return size;
}
