// mortise.h over PlainContact: exceptions become a status and a text.

#include <algorithm>
#include <atomic>
#include <cstring>
#include <limits>
#include <memory>
#include <new>
#include <string>

#include "agreement.hpp"
#include "communicator.hpp"
#include "mortise/plain/plain_contact.hpp"

struct mortise_contact {
  std::unique_ptr<mortise::PlainContact> contact;
  std::string error{};
  std::atomic<bool> is_busy{false};  ///< within a call
};

namespace {

using mortise::PlainError;
using mortise::PlainState;
using mortise::Span;

/// A length below 0 becomes one that no array has.
template <class T>
Span<T> span(T* data, std::int64_t size) {
  return {data, size < 0 ? std::numeric_limits<std::size_t>::max() : static_cast<std::size_t>(size)};
}

/// An array that may be NULL.
template <class T>
Span<T> optional_span(T* data, std::int64_t size) {
  return data == nullptr ? Span<T>() : span(data, size);
}

std::string text(const char* given) { return given == nullptr ? std::string() : std::string(given); }

/// Calls `work` and returns its status, with the error in words in `message`.
template <class Work>
int guarded(std::string& message, const Work& work) noexcept {
  try {
    message.clear();
    work();
    return MORTISE_OK;
  } catch (...) {
    try {
      const mortise::Problem problem = mortise::problem_of_exception();
      message = problem.text;
      return problem.status;
    } catch (...) {  // no memory for the text
      return MORTISE_NO_MEMORY;
    }
  }
}

template <class Work>
int guarded(mortise_contact* contact, const Work& work) noexcept {
  if (contact == nullptr) return MORTISE_NULL_POINTER;
  if (contact->is_busy.exchange(true)) return MORTISE_WRONG_ORDER;  // its text belongs to the call that is under way
  const int status = guarded(contact->error, [&] { work(*contact->contact); });
  contact->is_busy = false;
  return status;
}

/// A result that has to be there: if it is not, the next collective call fails on every rank.
template <class T>
T& given(mortise::PlainContact& contact, T* result, T& elsewhere, const char* name) {
  if (result != nullptr) return *result;
  contact.refuse_next(MORTISE_NULL_POINTER, std::string("\"") + name + "\" is null");
  return elsewhere;
}

PlainState state_of(const mortise::PlainContact& contact, std::int64_t rows, std::int64_t multipliers, const double* d, const double* prescribed,
                    const double* z) {
  const auto of_nodes = static_cast<std::int64_t>(contact.nodes()) * contact.dimension();
  return {span(d, rows), optional_span(prescribed, of_nodes), span(z, multipliers)};
}

/// Without derivatives, or with them.
using Evaluate = mortise_norms (mortise::PlainContact::*)(const PlainState&, Span<double>, Span<double>);

int evaluate(Evaluate call, mortise_contact* contact, std::int64_t rows, std::int64_t multipliers, const double* d, const double* prescribed,
             const double* z, double* f, double* C, mortise_norms* norms) {
  return guarded(contact, [&](mortise::PlainContact& self) {
    const mortise_norms result =
        (self.*call)(state_of(self, rows, multipliers, d, prescribed, z), optional_span(f, rows), optional_span(C, multipliers));
    if (norms != nullptr) *norms = result;
  });
}

}  // namespace

int mortise_create(int comm, int dimension, int64_t nodes, const int64_t* node_ids, const double* positions, const int64_t* node_rows,
                   const int32_t* marks, int64_t rows, const int64_t* row_ids, const char* options, mortise_contact** contact, char* message,
                   int64_t message_size) {
  if (contact != nullptr) *contact = nullptr;
  std::string error;
  const int status = guarded(error, [&] {
    if (contact == nullptr) throw PlainError(MORTISE_NULL_POINTER, "mortise_create: \"contact\" is null");
    if (comm != MORTISE_THIS_PROCESS) mortise::check_mpi_runs();
    const std::int64_t of_nodes = dimension == 2 || dimension == 3 ? std::min(nodes, std::numeric_limits<std::int64_t>::max() / 3) * dimension : 0;
    const mortise::PlainModel model{
        dimension, span(node_ids, nodes), span(positions, of_nodes), span(node_rows, of_nodes), optional_span(marks, of_nodes), span(row_ids, rows)};
    auto made = std::make_unique<mortise_contact>();
    made->contact = comm == MORTISE_THIS_PROCESS ? std::make_unique<mortise::PlainContact>(model, text(options))
                                                 : std::make_unique<mortise::PlainContact>(MPI_Comm_f2c(comm), model, text(options));
    *contact = made.release();
  });
  if (message != nullptr && message_size > 0) {
    const std::size_t length = std::min(error.size(), static_cast<std::size_t>(message_size) - 1);
    std::memcpy(message, error.data(), length);
    message[length] = '\0';
  }
  return status;
}

int mortise_add_pair(mortise_contact* contact, const char* name, double youngs_modulus, const char* options, int32_t* pair) {
  return guarded(contact, [&](mortise::PlainContact& self) {
    std::int32_t none{};
    std::int32_t& result = given(self, pair, none, "pair");
    result = self.add_pair(text(name), youngs_modulus, text(options));
  });
}

int mortise_add_second_pass(mortise_contact* contact, int32_t of, int32_t* pair) {
  return guarded(contact, [&](mortise::PlainContact& self) {
    std::int32_t none{};
    std::int32_t& result = given(self, pair, none, "pair");
    result = self.add_second_pass(of);
  });
}

int mortise_add_facets(mortise_contact* contact, int32_t pair, int side, int64_t facets, int nodes_per_facet, const int64_t* nodes) {
  return guarded(contact, [&](mortise::PlainContact& self) {
    if (facets < 0) {
      const std::string message = "mortise_add_facets: the number of facets is " + std::to_string(facets);
      self.refuse_next(MORTISE_WRONG_LENGTH, message);
      throw PlainError(MORTISE_WRONG_LENGTH, message);
    }
    const bool is_kind = nodes_per_facet > 0 && nodes_per_facet <= 8;
    const bool is_count = facets >= 0 && facets < std::numeric_limits<std::int32_t>::max();
    self.add_facets(pair, static_cast<mortise_side>(side), nodes_per_facet, span(nodes, is_kind && is_count ? facets * nodes_per_facet : -1));
  });
}

int mortise_ready(mortise_contact* contact, int64_t* multipliers) {
  return guarded(contact, [&](mortise::PlainContact& self) {
    std::int64_t none{};
    std::int64_t& result = given(self, multipliers, none, "multipliers");
    self.ready();
    result = static_cast<std::int64_t>(self.multiplier_ids().size());
  });
}

int mortise_multipliers(mortise_contact* contact, int64_t multipliers, int64_t* ids, int64_t* nodes, double* weights) {
  return guarded(contact, [&](mortise::PlainContact& self) {
    const std::size_t count = self.multiplier_ids().size();
    if (multipliers != static_cast<std::int64_t>(count))
      throw PlainError(MORTISE_WRONG_LENGTH, "mortise_multipliers: this rank has " + std::to_string(count) +
                                                 " multipliers after mortise_ready(); given is the length " + std::to_string(multipliers));
    if (ids != nullptr) std::copy(self.multiplier_ids().begin(), self.multiplier_ids().end(), ids);
    if (nodes != nullptr) std::copy(self.multiplier_nodes().begin(), self.multiplier_nodes().end(), nodes);
    if (weights != nullptr) std::copy(self.multiplier_weights().begin(), self.multiplier_weights().end(), weights);
  });
}

int mortise_start_step(mortise_contact* contact, int64_t rows, int64_t multipliers, const double* d, const double* prescribed, double* z) {
  return guarded(contact,
                 [&](mortise::PlainContact& self) { self.start_step(state_of(self, rows, multipliers, d, prescribed, z), span(z, multipliers)); });
}

int mortise_evaluate(mortise_contact* contact, int64_t rows, int64_t multipliers, const double* d, const double* prescribed, const double* z,
                     double* f, double* C, mortise_norms* norms) {
  return evaluate(&mortise::PlainContact::evaluate, contact, rows, multipliers, d, prescribed, z, f, C, norms);
}

int mortise_differentiate(mortise_contact* contact, int64_t rows, int64_t multipliers, const double* d, const double* prescribed, const double* z,
                          double* f, double* C, mortise_norms* norms) {
  return evaluate(&mortise::PlainContact::differentiate, contact, rows, multipliers, d, prescribed, z, f, C, norms);
}

int mortise_jacobian(mortise_contact* contact, int block, mortise_matrix* matrix) {
  return guarded(contact, [&](mortise::PlainContact& self) {
    mortise_matrix none{};
    mortise_matrix& result = given(self, matrix, none, "matrix");
    result = self.jacobian(static_cast<mortise_block>(block));
  });
}

int mortise_condense(mortise_contact* contact, int64_t rows, const int64_t* starts, const int64_t* columns, const double* values, double* rhs,
                     mortise_matrix* matrix) {
  return guarded(contact, [&](mortise::PlainContact& self) {
    mortise_matrix none{};
    mortise_matrix& result = given(self, matrix, none, "matrix");
    // The number of entries stands in the array, which is read if it is as long as it should be.
    const bool is_long_enough = starts != nullptr && rows == static_cast<std::int64_t>(self.rows());
    const std::int64_t entries = is_long_enough ? starts[rows] : 0;
    const std::int64_t starts_size = rows < 0 || rows == std::numeric_limits<std::int64_t>::max() ? -1 : rows + 1;
    result = self.condense({span(starts, starts_size), span(columns, entries), span(values, entries)}, span(rhs, rows));
  });
}

int mortise_solve(mortise_contact* contact, int64_t rows, int64_t multipliers, const double* right, mortise_linear_solver solver, void* user,
                  double* dd, double* dz) {
  return guarded(contact, [&](mortise::PlainContact& self) {
    const auto solve = [&](Span<const double> of, Span<double> solution) {
      const int failed = solver(user, static_cast<std::int64_t>(of.size()), of.data(), solution.data());
      if (failed != 0) throw PlainError(MORTISE_SOLVE_FAILED, "it returns " + std::to_string(failed));
    };
    self.solve(span(right, rows), solver == nullptr ? mortise::PlainContact::Solve() : solve, span(dd, rows), span(dz, multipliers));
  });
}

int mortise_recover(mortise_contact* contact, int64_t rows, int64_t multipliers, const double* dd, double* z) {
  return guarded(contact, [&](mortise::PlainContact& self) { self.recover(span(dd, rows), span(z, multipliers)); });
}

int mortise_augment(mortise_contact* contact, mortise_augmentation* augmentation) {
  return guarded(contact, [&](mortise::PlainContact& self) {
    mortise_augmentation none{};
    mortise_augmentation& result = given(self, augmentation, none, "augmentation");
    result = self.augment();
  });
}

int mortise_accept(mortise_contact* contact) {
  return guarded(contact, [](mortise::PlainContact& self) { self.accept(); });
}

int mortise_count_nodes(mortise_contact* contact, int32_t pair, int64_t* nodes) {
  return guarded(contact, [&](mortise::PlainContact& self) {
    if (nodes == nullptr) throw PlainError(MORTISE_NULL_POINTER, "mortise_count_nodes: \"nodes\" is null");
    *nodes = static_cast<std::int64_t>(self.count_nodes(pair));
  });
}

int mortise_report(mortise_contact* contact, int32_t pair, int64_t nodes, mortise_node* report) {
  return guarded(contact, [&](mortise::PlainContact& self) { self.report(pair, span(report, nodes)); });
}

int mortise_store(mortise_contact* contact, int64_t capacity, void* bytes, int64_t* size) {
  return guarded(contact, [&](mortise::PlainContact& self) {
    std::int64_t none{};
    std::int64_t& result = given(self, size, none, "size");
    if (bytes == nullptr && capacity != 0) self.refuse_next(MORTISE_NULL_POINTER, "\"bytes\" is null");
    const std::vector<unsigned char> all = self.store();
    result = static_cast<std::int64_t>(all.size());
    if (bytes == nullptr) return;
    if (capacity < result)
      throw PlainError(MORTISE_WRONG_LENGTH,
                       "mortise_store: there are " + std::to_string(all.size()) + " bytes, and room for " + std::to_string(capacity));
    std::memcpy(bytes, all.data(), all.size());
  });
}

int mortise_restore(mortise_contact* contact, int64_t size, const void* bytes, int64_t rows, int64_t multipliers, const double* d,
                    const double* prescribed, const double* z) {
  return guarded(contact, [&](mortise::PlainContact& self) {
    self.restore(span(static_cast<const unsigned char*>(bytes), std::max(size, std::int64_t{0})),
                 state_of(self, rows, multipliers, d, prescribed, z));
  });
}

const char* mortise_last_error(const mortise_contact* contact) { return contact == nullptr ? "the contact is null" : contact->error.c_str(); }

void mortise_destroy(mortise_contact** contact) {
  if (contact == nullptr || (*contact != nullptr && (*contact)->is_busy)) return;
  delete *contact;
  *contact = nullptr;
}
