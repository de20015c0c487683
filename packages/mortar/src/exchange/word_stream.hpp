#pragma once
// Lists of numbers as one message: words of 8 bytes.

#include <Eigen/Core>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <vector>

namespace mortise {

using Words = std::vector<std::uint64_t>;

/// Appends values to a message.
class WordWriter {
 public:
  explicit WordWriter(Words& words) : words_(words) {}

  template <class T>
  void put(T value) {
    static_assert(std::is_arithmetic_v<T>);
    std::uint64_t word = 0;
    std::memcpy(&word, &value, sizeof(T));
    words_.push_back(word);
  }
  template <class List>
  void put_list(const List& list) {
    put(list.size());
    for (const auto value : list) put(value);
  }
  template <class Derived>
  void put_matrix(const Eigen::PlainObjectBase<Derived>& matrix) {
    put(matrix.rows());
    put(matrix.cols());
    const std::size_t begin = words_.size();
    words_.resize(begin + static_cast<std::size_t>(matrix.size()));
    if (matrix.size() > 0) std::memcpy(words_.data() + begin, matrix.data(), static_cast<std::size_t>(matrix.size()) * sizeof(double));
  }

 private:
  Words& words_;
};

/// Takes values from a message in the order in which they were put.
class WordReader {
 public:
  explicit WordReader(const Words& words) : words_(words) {}

  bool at_end() const { return place_ == words_.size(); }
  template <class T>
  T get() {
    T value;
    std::memcpy(&value, &words_[place_++], sizeof(T));
    return value;
  }
  /// Calls act(value) for each value of a list.
  template <class T, class Act>
  void get_list(const Act& act) {
    for (auto left = get<std::size_t>(); left > 0; --left) act(get<T>());
  }
  template <class Derived>
  void get_matrix(Eigen::PlainObjectBase<Derived>& matrix) {
    const auto rows = get<Eigen::Index>(), columns = get<Eigen::Index>();
    matrix.resize(rows, columns);
    if (matrix.size() > 0) std::memcpy(matrix.data(), words_.data() + place_, static_cast<std::size_t>(matrix.size()) * sizeof(double));
    place_ += static_cast<std::size_t>(matrix.size());
  }

 private:
  const Words& words_;
  std::size_t place_ = 0;
};

}  // namespace mortise
