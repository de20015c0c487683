#include "history_bytes.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstring>

#include "text_hash.hpp"

namespace mortise {
namespace {

constexpr char beginning[] = "Mortise contact history 1\n";
constexpr std::size_t beginning_size = sizeof(beginning) - 1;

class Writer {
 public:
  template <class Number>
  void numbers(const Number* first, std::size_t count) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(first);
    bytes_.insert(bytes_.end(), bytes, bytes + count * sizeof(Number));
  }
  void number(std::uint64_t value) { numbers(&value, 1); }
  template <class Tables>
  void tables(const Tables& tables) {
    number(tables.size());
    for (const auto& [name, values] : tables) {
      number(name.size());
      numbers(name.data(), name.size());
      number(values.size());
      numbers(values.data(), values.size());
    }
  }
  std::vector<unsigned char>& bytes() { return bytes_; }

 private:
  std::vector<unsigned char> bytes_;
};

/// Reads no further than the bytes go.
class Reader {
 public:
  explicit Reader(Span<const unsigned char> bytes) : bytes_(bytes) {}
  template <class Container>
  bool numbers(Container& values, std::uint64_t count) {
    constexpr std::size_t size = sizeof(typename Container::value_type);
    if (count > (bytes_.size() - at_) / size) return false;
    values.resize(count);
    if (count > 0) std::memcpy(values.data(), bytes_.data() + at_, count * size);
    at_ += count * size;
    return true;
  }
  bool number(std::uint64_t& value) {
    std::vector<std::uint64_t> one;
    if (!numbers(one, 1)) return false;
    value = one[0];
    return true;
  }
  template <class Tables>
  bool tables(Tables& tables) {
    std::uint64_t count = 0, length = 0;
    if (!number(count)) return false;
    for (std::uint64_t n = 0; n < count; ++n) {
      std::string name;
      if (!number(length) || !numbers(name, length) || !number(length) || !numbers(tables[name], length)) return false;
    }
    return true;
  }
  bool ends() const { return at_ == bytes_.size(); }

 private:
  Span<const unsigned char> bytes_;
  std::size_t at_ = 0;
};

}  // namespace

std::vector<unsigned char> to_bytes(const StoredTables& tables, int rank, int ranks) {
  Writer body;
  body.number(static_cast<std::uint64_t>(rank));
  body.number(static_cast<std::uint64_t>(ranks));
  body.tables(tables.ids);
  body.tables(tables.numbers);
  Writer all;
  all.numbers(beginning, beginning_size);
  all.number(text_hash(body.bytes().data(), body.bytes().size()));
  all.numbers(body.bytes().data(), body.bytes().size());
  return std::move(all.bytes());
}

ReadTables from_bytes(Span<const unsigned char> bytes, int rank, int ranks) {
  const auto wrong = [](const std::string& text) { return ReadTables{{}, Problem{MORTISE_BAD_BYTES, text}}; };
  constexpr std::size_t head = beginning_size + sizeof(std::uint64_t);
  if (bytes.size() < head || std::memcmp(bytes.data(), beginning, beginning_size) != 0)
    return wrong(fmt::format("{} bytes are given, which do not begin as those of mortise_store() do", bytes.size()));
  const Span<const unsigned char> rest(bytes.data() + head, bytes.size() - head);
  std::uint64_t checksum = 0, its_rank = 0, its_ranks = 0;
  std::memcpy(&checksum, bytes.data() + beginning_size, sizeof(checksum));
  if (checksum != text_hash(rest.data(), rest.size())) return wrong("the bytes are not those that were stored: their checksum is another one");
  Reader reader(rest);
  ReadTables result;
  if (!reader.number(its_rank) || !reader.number(its_ranks) || !reader.tables(result.tables.ids) || !reader.tables(result.tables.numbers) ||
      !reader.ends())
    return wrong("the bytes are damaged");
  if (its_rank != static_cast<std::uint64_t>(rank) || its_ranks != static_cast<std::uint64_t>(ranks))
    return wrong(fmt::format("the bytes are those of rank {} of {}; this is rank {} of {}", its_rank, its_ranks, rank, ranks));
  return result;
}

const std::vector<double>* TableArchive::found(const std::string& name) {
  const auto found = tables_.numbers.find(name);
  const bool there = found != tables_.numbers.end();
  refuse_if(there ? std::nullopt : std::optional(fmt::format("the stored history has no \"{}\": it is of another model or has other options", name)));
  return &found->second;
}

void TableArchive::values(const std::string& name, std::vector<double>& values) {
  if (restores_)
    values = *found(name);
  else
    tables_.numbers[name] = values;
}

void TableArchive::text(const std::string& name, std::string& text) {
  std::vector<double> bytes;
  for (const char c : text) bytes.push_back(static_cast<unsigned char>(c));
  values("text." + name, bytes);
  if (!restores_) return;
  text.clear();
  for (const double byte : bytes) text.push_back(static_cast<char>(static_cast<unsigned char>(byte)));
}

void TableArchive::rows(const std::string& name, const RowIds& ids, std::size_t columns, std::vector<double>& rows) {
  if (!restores_) {
    tables_.ids[ids.name].assign(ids.ids.begin(), ids.ids.end());
    tables_.numbers[name] = rows;
    return;
  }
  const std::vector<double>& stored = *found(name);
  const std::vector<std::int64_t>& its_ids = tables_.ids[ids.name];
  std::unordered_map<std::int64_t, std::size_t> place;
  for (std::size_t row = 0; row < its_ids.size(); ++row) place.emplace(its_ids[row], row);
  std::optional<std::string> wrong;
  if (stored.size() != columns * its_ids.size())
    wrong = fmt::format("\"{}\" has {} numbers for {} rows of {}", name, stored.size(), its_ids.size(), columns);
  if (const auto bad = not_finite(name, stored)) wrong = bad;
  rows.clear();
  for (std::size_t row = 0; row < ids.ids.size() && !wrong; ++row) {
    const auto at = place.find(ids.ids[row]);
    if (at == place.end())
      wrong = fmt::format("\"{}\" was not stored for node {}: this rank had other nodes", name, ids.ids[row]);
    else
      rows.insert(rows.end(), stored.begin() + static_cast<std::ptrdiff_t>(columns * at->second),
                  stored.begin() + static_cast<std::ptrdiff_t>(columns * (at->second + 1)));
  }
  refuse_if(wrong);
}

void TableArchive::refuse_if(const std::optional<std::string>& wrong) {
  Agreement(comm_).check("mortise_restore", wrong ? std::optional(Problem{MORTISE_BAD_BYTES, *wrong}) : std::nullopt);
}

}  // namespace mortise
