#pragma once
// Arrays of somebody else.

#include <cstddef>
#include <type_traits>
#include <utility>

namespace mortise {

/// A pointer and a number of entries, which stay where they are.
template <class T>
class Span {
 public:
  /// No entries.
  Span() = default;
  /// `size` entries from `data` on.
  Span(T* data, std::size_t size) : data_(data), size_(size) {}
  /// All entries of a container, as a std::vector.
  template <class Container, class = std::enable_if_t<std::is_convertible_v<decltype(std::declval<Container&>().data()), T*>>>
  Span(Container& container) : data_(container.data()), size_(container.size()) {}

  T* data() const { return data_; }                        ///< null if there are none
  std::size_t size() const { return size_; }               ///< number of entries
  bool empty() const { return size_ == 0; }                ///< true without entries
  T* begin() const { return data_; }                       ///< first entry
  T* end() const { return data_ + size_; }                 ///< behind the last
  T& operator[](std::size_t i) const { return data_[i]; }  ///< i < size()

 private:
  T* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace mortise
