#pragma once
// Tpetra objects in Thyra's, and the other way round.

#include <Thyra_TpetraThyraWrappers.hpp>

#include "mortise/core/types.hpp"

namespace mortise::detail {

using ThyraSpace = ::Thyra::VectorSpaceBase<Scalar>;
using TpetraOfThyra = ::Thyra::TpetraOperatorVectorExtraction<Scalar, LocalOrdinal, GlobalOrdinal, NodeType>;

inline RCP<const Vector> tpetra(const ::Thyra::VectorBase<Scalar>& vector) {
  return TpetraOfThyra::getConstTpetraVector(Teuchos::rcpFromRef(vector));
}
inline RCP<Vector> tpetra(::Thyra::VectorBase<Scalar>& vector) { return TpetraOfThyra::getTpetraVector(Teuchos::rcpFromRef(vector)); }

inline RCP<const ::Thyra::TpetraVectorSpace<Scalar, LocalOrdinal, GlobalOrdinal, NodeType>> space_of(const RCP<const Map>& map) {
  return ::Thyra::tpetraVectorSpace<Scalar, LocalOrdinal, GlobalOrdinal, NodeType>(map);
}
inline RCP<::Thyra::VectorBase<Scalar>> thyra(Vector& vector) {
  return ::Thyra::tpetraVector<Scalar, LocalOrdinal, GlobalOrdinal, NodeType>(space_of(vector.getMap()), Teuchos::rcpFromRef(vector));
}
inline RCP<const ::Thyra::VectorBase<Scalar>> thyra(const Vector& vector) {
  return ::Thyra::constTpetraVector<Scalar, LocalOrdinal, GlobalOrdinal, NodeType>(space_of(vector.getMap()), Teuchos::rcpFromRef(vector));
}

/// True, on every rank, if all values are alike, bit by bit.
bool are_equal(const MultiVector& one, const MultiVector& other);

}  // namespace mortise::detail
