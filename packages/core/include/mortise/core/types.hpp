#pragma once
// The one place that names the linear algebra types, so that a Trilinos built for other scalars or nodes needs one change.

#include <Teuchos_Comm.hpp>
#include <Teuchos_RCP.hpp>
#include <Tpetra_CrsGraph_decl.hpp>
#include <Tpetra_CrsMatrix_decl.hpp>
#include <Tpetra_Export_decl.hpp>
#include <Tpetra_Import_decl.hpp>
#include <Tpetra_Map_decl.hpp>
#include <Tpetra_MultiVector_decl.hpp>
#include <Tpetra_Operator.hpp>
#include <Tpetra_Vector_decl.hpp>

namespace mortise {

using Scalar = double;
using Map = Tpetra::Map<>;
using LocalOrdinal = Map::local_ordinal_type;
using GlobalOrdinal = Map::global_ordinal_type;
using NodeType = Map::node_type;

using Graph = Tpetra::CrsGraph<LocalOrdinal, GlobalOrdinal, NodeType>;
using Matrix = Tpetra::CrsMatrix<Scalar, LocalOrdinal, GlobalOrdinal, NodeType>;
using Vector = Tpetra::Vector<Scalar, LocalOrdinal, GlobalOrdinal, NodeType>;
using MultiVector = Tpetra::MultiVector<Scalar, LocalOrdinal, GlobalOrdinal, NodeType>;
using Operator = Tpetra::Operator<Scalar, LocalOrdinal, GlobalOrdinal, NodeType>;
using Import = Tpetra::Import<LocalOrdinal, GlobalOrdinal, NodeType>;
using Export = Tpetra::Export<LocalOrdinal, GlobalOrdinal, NodeType>;
using Communicator = Teuchos::Comm<int>;

using Teuchos::RCP;
using Teuchos::rcp;

}  // namespace mortise
