#pragma once
// Histories as bytes of a rank.

#include <cstdint>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "agreement.hpp"
#include "mortise/core/state_archive.hpp"
#include "mortise/plain/span.hpp"

namespace mortise {

/// Numbers by name, and the ids of their rows.
struct StoredTables {
  std::map<std::string, std::vector<std::int64_t>> ids;  ///< by RowIds::name
  std::map<std::string, std::vector<double>> numbers;    ///< by the name of a table
};

/// Bytes of tables that belong to a rank out of several, with a checksum.
std::vector<unsigned char> to_bytes(const StoredTables& tables, int rank, int ranks);

/// The tables that bytes hold, or what is wrong with these.
struct ReadTables {
  StoredTables tables;
  std::optional<Problem> problem;
};
ReadTables from_bytes(Span<const unsigned char> bytes, int rank, int ranks);

/// Tables that are stored or restored. Ghosts are stored as well, so that a rank needs no other one.
class TableArchive final : public StateArchive {
 public:
  /// Stores into an empty one.
  explicit TableArchive(const Communicator& comm) : comm_(comm) {}
  /// Restores from these.
  TableArchive(const Communicator& comm, StoredTables stored) : comm_(comm), tables_(std::move(stored)), restores_(true) {}

  bool restores() const override { return restores_; }
  void values(const std::string& name, std::vector<double>& values) override;
  void text(const std::string& name, std::string& text) override;
  void rows(const std::string& name, const RowIds& ids, std::size_t columns, std::vector<double>& rows) override;
  void refuse_if(const std::optional<std::string>& wrong) override;

  const StoredTables& tables() const { return tables_; }

 private:
  const std::vector<double>* found(const std::string& name);
  const Communicator& comm_;
  StoredTables tables_;
  bool restores_ = false;
};

}  // namespace mortise
