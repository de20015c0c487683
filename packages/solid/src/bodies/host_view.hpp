#pragma once
// Contiguous access to a vector's values on the host, held as long as the object lives.

#include <Tpetra_Vector.hpp>

#include "mortise/core/types.hpp"

namespace mortise {

class HostReadView {
 public:
  explicit HostReadView(const Vector& vector) : view_(vector.getLocalViewHost(Tpetra::Access::ReadOnly)) {}
  const double* data() const { return view_.data(); }

 private:
  decltype(std::declval<const Vector&>().getLocalViewHost(Tpetra::Access::ReadOnly)) view_;
};

class HostWriteView {
 public:
  explicit HostWriteView(Vector& vector) : view_(vector.getLocalViewHost(Tpetra::Access::ReadWrite)) {}
  double* data() const { return view_.data(); }

 private:
  decltype(std::declval<Vector&>().getLocalViewHost(Tpetra::Access::ReadWrite)) view_;
};

}  // namespace mortise
