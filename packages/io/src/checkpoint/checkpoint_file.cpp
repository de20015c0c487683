#include "mortise/io/checkpoint_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <hdf5.h>
#include <unistd.h>
#include <zlib.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <map>
#include <numeric>
#include <set>

#include "files/file_descriptor.hpp"
#include "hdf5/hdf5_file.hpp"
#include "hdf5/hdf5_handle.hpp"
#include "mortise/io/files.hpp"

namespace mortise {
namespace {

constexpr int version = 1;
constexpr const char* beginning = "mortise checkpoint ";
constexpr std::size_t line_length = 64;  ///< of the last line, padded with blanks, with its line break

/// The last line of a file of which `bytes` come before it.
std::string last_line(long long bytes, unsigned long crc) {
  std::string line = fmt::format("\n{}{} bytes {} crc32 {:08x}", beginning, version, bytes, crc);
  line.resize(line_length - 1, ' ');
  return line + "\n";
}

/// CRC-32 of `count` bytes from `begin` on; nothing if they cannot be read.
std::optional<unsigned long> crc_of_part(int file, long long begin, long long count) {
  std::vector<unsigned char> buffer(std::size_t{1} << 20);
  unsigned long crc = crc32(0, nullptr, 0);
  for (long long done = 0; done < count;) {
    const auto wanted = static_cast<std::size_t>(std::min<long long>(count - done, static_cast<long long>(buffer.size())));
    const ssize_t read = pread(file, buffer.data(), wanted, begin + done);
    if (read < 0 && errno == EINTR) continue;
    if (read <= 0) return std::nullopt;
    crc = crc32(crc, buffer.data(), static_cast<unsigned>(read));
    done += read;
  }
  return crc;
}

/// CRC-32 of the first bytes of a file, of which each rank reads a part. Collective; the same on every rank; nothing if any rank could not read.
std::optional<unsigned long> crc_of(const Communicator& comm, const std::string& path, long long bytes) {
  const long long ranks = comm.getSize(), rank = comm.getRank(), begin = bytes * rank / ranks, end = bytes * (rank + 1) / ranks;
  std::optional<unsigned long> mine;
  if (const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC); file >= 0) {
    mine = crc_of_part(file, begin, end - begin);
    close(file);
  }
  const std::array<long long, 2> own{mine ? static_cast<long long>(*mine) : -1, end - begin};
  std::vector<long long> all(2 * static_cast<std::size_t>(ranks));
  Teuchos::gatherAll(comm, 2, own.data(), static_cast<int>(all.size()), all.data());
  unsigned long crc = crc32(0, nullptr, 0);
  for (std::size_t n = 0; n < all.size(); n += 2) {
    if (all[n] < 0) return std::nullopt;
    crc = crc32_combine(crc, static_cast<unsigned long>(all[n]), all[n + 1]);
  }
  return crc;
}

/// End of a file, as rank 0 finds it: the bytes before the last line and their checksum; or why it is no checkpoint.
struct LastLine {
  long long bytes = 0;
  unsigned long crc = 0;
  std::string wrong;
};

LastLine read_last_line(const std::string& path) {
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  if (error) return {0, 0, error.message()};
  const long long bytes = static_cast<long long>(size) - static_cast<long long>(line_length);
  std::array<char, line_length> line{};
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return {0, 0, std::strerror(errno)};
  const bool read = bytes > 0 && pread(file, line.data(), line.size(), bytes) == static_cast<ssize_t>(line.size());
  close(file);
  const std::string text(line.data(), line.size());
  if (!read || text.compare(1, std::strlen(beginning), beginning) != 0)
    return {0, 0, fmt::format("it has {} bytes and does not end as a checkpoint does: it is cut short, or none", size)};
  int its_version = 0;
  long long its_bytes = 0;
  unsigned long crc = 0;
  const std::string form = fmt::format("\n{}%d bytes %lld crc32 %lx", beginning);
  if (std::sscanf(text.c_str(), form.c_str(), &its_version, &its_bytes, &crc) < 1) return {0, 0, "its last line is damaged"};
  if (its_version != version) return {0, 0, fmt::format("it is of version {}; this program reads version {}", its_version, version)};
  if (text != last_line(bytes, crc) || its_bytes != bytes)
    return {0, 0, fmt::format("it has {} bytes before its last line, which tells of {}: it is damaged", bytes, its_bytes)};
  return {bytes, crc, ""};
}

GlobalOrdinal rows_before(const Communicator& comm, GlobalOrdinal mine, GlobalOrdinal& all) {
  GlobalOrdinal end = 0;
  Teuchos::scan(comm, Teuchos::REDUCE_SUM, mine, Teuchos::outArg(end));
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, mine, Teuchos::outArg(all));
  return end - mine;
}

}  // namespace

struct CheckpointWriter::Implementation {
  Implementation(RCP<const Communicator> comm_, std::string path_) : comm(std::move(comm_)), path(std::move(path_)), file(comm, path) {}

  RCP<const Communicator> comm;
  std::string path;
  Hdf5File file;
  std::set<std::string> ids;  ///< in the file
};

CheckpointWriter::CheckpointWriter(RCP<const Communicator> comm, std::string path)
    : implementation_(std::make_unique<Implementation>(std::move(comm), std::move(path))) {}
CheckpointWriter::~CheckpointWriter() = default;

void CheckpointWriter::values(const std::string& name, std::vector<double>& values) {
  Implementation& self = *implementation_;
  const bool first = self.comm->getRank() == 0;
  self.file.write("/values/" + name, static_cast<GlobalOrdinal>(values.size()), 0, 1, first ? values : std::vector<double>());
}

void CheckpointWriter::text(const std::string& name, std::string& text) {
  std::vector<double> bytes;
  for (const char c : text) bytes.push_back(static_cast<unsigned char>(c));
  values("text." + name, bytes);
}

void CheckpointWriter::rows(const std::string& name, const RowIds& ids, std::size_t columns, std::vector<double>& rows) {
  Implementation& self = *implementation_;
  GlobalOrdinal all = 0;
  const GlobalOrdinal first = rows_before(*self.comm, static_cast<GlobalOrdinal>(ids.owned), all);
  if (self.ids.insert(ids.name).second)
    self.file.write("/ids/" + ids.name, all, first, 1,
                    std::vector<long long>(ids.ids.begin(), ids.ids.begin() + static_cast<std::ptrdiff_t>(ids.owned)));
  const std::vector<double> owned(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(ids.owned * columns));
  self.file.write("/rows/" + name, all, first, static_cast<int>(columns), owned);
}

void CheckpointWriter::refuse_if(const std::optional<std::string>& wrong) {
  throw_if_any_file_error(*implementation_->comm, "cannot write", implementation_->path, wrong);
}

// Rank 0 adds the last line when all ranks have read their parts.
std::uintmax_t CheckpointWriter::finish() {
  Implementation& self = *implementation_;
  const Communicator& comm = *self.comm;
  long long bytes = 0;
  self.file.close([&](const std::string& part) -> std::optional<std::string> {
    std::optional<std::string> reason;
    if (comm.getRank() == 0) {
      std::error_code error;
      bytes = static_cast<long long>(std::filesystem::file_size(part, error));
      if (error) reason = error.message();
    }
    Teuchos::broadcast(comm, 0, Teuchos::outArg(bytes));
    const auto crc = crc_of(comm, part, bytes);
    if (!crc) return reason ? reason : "it cannot be read again";
    if (comm.getRank() != 0) return reason;
    FileDescriptor file;
    const std::string line = last_line(bytes, *crc);
    if (!reason) reason = file.open(part, O_WRONLY);
    if (!reason) reason = file.write(line.data(), line.size(), static_cast<std::uintmax_t>(bytes));
    if (!reason) reason = file.sync();
    if (!reason) reason = file.close();
    return reason;
  });
  std::optional<std::string> reason;
  if (comm.getRank() == 0) reason = sync_directory(std::filesystem::path(self.path).parent_path().string());
  throw_if_any_file_error(comm, "cannot write", self.path, reason);
  return static_cast<std::uintmax_t>(bytes) + line_length;
}

std::optional<std::string> checkpoint_damage(const Communicator& comm, const std::string& path) {
  LastLine line;
  if (comm.getRank() == 0) line = read_last_line(path);
  int length = static_cast<int>(line.wrong.size());
  Teuchos::broadcast(comm, 0, Teuchos::outArg(length));
  line.wrong.resize(static_cast<std::size_t>(length));
  if (length > 0) Teuchos::broadcast(comm, 0, length, line.wrong.data());
  if (length > 0) return line.wrong;
  std::array<long long, 2> numbers{line.bytes, static_cast<long long>(line.crc)};
  Teuchos::broadcast(comm, 0, 2, numbers.data());
  const auto crc = crc_of(comm, path, numbers[0]);
  if (!crc) return "it cannot be read to its end";
  if (static_cast<long long>(*crc) != numbers[1])
    return fmt::format("its checksum is {:08x} and its last line says {:08x}: it is damaged", *crc, static_cast<unsigned long>(numbers[1]));
  return std::nullopt;
}

struct CheckpointReader::Implementation {
  Implementation(RCP<const Communicator> comm_, std::string path_) : comm(std::move(comm_)), path(std::move(path_)), access(hdf5_access()) {
    agree(checkpoint_damage(*comm, path));
    file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, access);
    agree(file >= 0 ? std::nullopt : std::optional(hdf5_reason()));
    std::error_code error;
    bytes = static_cast<hsize_t>(std::filesystem::file_size(path, error));
    agree(error ? std::optional(error.message()) : std::nullopt);
  }
  ~Implementation() {
    if (file >= 0) H5Fclose(file);
  }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  void agree(const std::optional<std::string>& reason) const { throw_if_any_file_error(*comm, "cannot read the checkpoint", path, reason); }

  /// True if a dataset has all its values in one piece of this file, as all written ones do. No size that a file claims for more than it has
  /// is believed, nothing is taken from another file.
  bool lies_in_file(hid_t dataset, hsize_t rows, hsize_t columns, std::size_t value_size) const {
    const hsize_t room = bytes / value_size;
    if (rows > room || columns > room || (rows > 0 && columns > room / rows)) return false;
    if (rows * columns == 0) return true;
    const haddr_t place = H5Dget_offset(dataset);
    return place != HADDR_UNDEF && place < bytes && rows * columns * value_size <= std::min<hsize_t>(H5Dget_storage_size(dataset), bytes - place);
  }

  /// A slab of a dataset, [rows x columns], and what is wrong with it.
  template <class Number>
  std::optional<std::string> read(const std::string& name, hid_t type, std::size_t& all, std::size_t& columns, std::vector<Number>& values,
                                  bool whole) {
    const Hdf5Handle dataset(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose);
    if (!dataset.good()) return fmt::format("it has no \"{}\"", name);
    const Hdf5Handle space(H5Dget_space(dataset), H5Sclose);
    std::array<hsize_t, 2> size{0, 1};
    const int dimensions = space.good() ? H5Sget_simple_extent_ndims(space) : -1;
    if (dimensions < 1 || dimensions > 2 || H5Sget_simple_extent_dims(space, size.data(), nullptr) < 0)
      return fmt::format("\"{}\" has {} dimensions", name, dimensions);
    if (!lies_in_file(dataset, size[0], size[1], sizeof(Number))) return fmt::format("\"{}\" lacks values", name);
    const auto ranks = static_cast<hsize_t>(comm->getSize()), rank = static_cast<hsize_t>(comm->getRank());
    const hsize_t first = whole ? 0 : size[0] * rank / ranks, end = whole ? size[0] : size[0] * (rank + 1) / ranks;
    all = size[0];
    columns = size[1];
    values.resize((end - first) * columns);
    if (values.empty()) return std::nullopt;
    const std::array<hsize_t, 2> start{first, 0}, part{end - first, size[1]};
    const Hdf5Handle memory(H5Screate_simple(dimensions, part.data(), nullptr), H5Sclose);
    H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, part.data(), nullptr);
    return H5Dread(dataset, type, memory, space, H5P_DEFAULT, values.data()) >= 0 ? std::nullopt : std::optional(hdf5_reason());
  }

  /// From the slabs of the file to the rows that this rank wants.
  struct Plan {
    RCP<const Map> slab, wanted;
    RCP<const Import> import;
    std::size_t rows = 0;  ///< in the file
  };

  const Plan& plan(const RowIds& ids) {
    if (const auto found = plans.find(ids.name); found != plans.end()) return found->second;
    std::vector<long long> slab;
    std::size_t all = 0, columns = 0;
    agree(read("/ids/" + ids.name, H5T_NATIVE_LLONG, all, columns, slab, false));
    agree(columns == 1 ? std::nullopt : std::optional(fmt::format("\"{}\" has {} ids in a row; expected is 1", ids.name, columns)));
    const auto invalid = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
    GlobalOrdinal mine = -1, last = -1;
    for (const GlobalOrdinal id : ids.ids) mine = std::max(mine, id);
    Teuchos::reduceAll(*comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(last));
    const auto bad = std::find_if(slab.begin(), slab.end(), [&](long long id) { return id < 0 || id > last; });
    agree(bad == slab.end()
              ? std::nullopt
              : std::optional(fmt::format("\"{}\" holds the id {}; the last one here is {}: it is of another mesh", ids.name, *bad, last)));
    Plan plan;
    plan.rows = all;
    const std::vector<GlobalOrdinal> stored(slab.begin(), slab.end());
    plan.slab = rcp(new Map(invalid, stored.data(), static_cast<LocalOrdinal>(stored.size()), 0, comm));
    plan.wanted = rcp(new Map(invalid, ids.ids.data(), static_cast<LocalOrdinal>(ids.ids.size()), 0, comm));
    std::vector<int> ranks(ids.ids.size());
    plan.slab->getRemoteIndexList(Teuchos::arrayView(ids.ids.data(), ids.ids.size()), Teuchos::arrayView(ranks.data(), ranks.size()));
    const auto missing = std::find(ranks.begin(), ranks.end(), -1);
    agree(missing == ranks.end() ? std::nullopt
                                 : std::optional(fmt::format("its rows \"{}\" lack the id {}: it is of another mesh", ids.name,
                                                             ids.ids[static_cast<std::size_t>(missing - ranks.begin())])));
    plan.import = rcp(new Import(plan.slab, plan.wanted));
    return plans[ids.name] = plan;
  }

  RCP<const Communicator> comm;
  std::string path;
  Hdf5Handle access;
  hid_t file = -1;
  hsize_t bytes = 0;  ///< of the file
  std::map<std::string, Plan> plans;
};

CheckpointReader::CheckpointReader(RCP<const Communicator> comm, std::string path)
    : implementation_(std::make_unique<Implementation>(std::move(comm), std::move(path))) {}
CheckpointReader::~CheckpointReader() = default;

void CheckpointReader::values(const std::string& name, std::vector<double>& values) {
  std::size_t all = 0, columns = 0;
  implementation_->agree(implementation_->read("/values/" + name, H5T_NATIVE_DOUBLE, all, columns, values, true));
}

void CheckpointReader::text(const std::string& name, std::string& text) {
  std::vector<double> bytes;
  values("text." + name, bytes);
  text.clear();
  const auto wrong = std::find_if(bytes.begin(), bytes.end(), [](double byte) { return !whole_number<unsigned char>(byte); });
  refuse_if(wrong == bytes.end() ? std::nullopt : std::optional(not_whole("text." + name, *wrong)));
  for (const double byte : bytes) text += static_cast<char>(*whole_number<unsigned char>(byte));
}

void CheckpointReader::refuse_if(const std::optional<std::string>& wrong) { implementation_->agree(wrong); }

void CheckpointReader::rows(const std::string& name, const RowIds& ids, std::size_t columns, std::vector<double>& rows) {
  Implementation& self = *implementation_;
  const Implementation::Plan& plan = self.plan(ids);
  std::vector<double> slab;
  std::size_t all = 0, stored = 0;
  const auto wrong = self.read("/rows/" + name, H5T_NATIVE_DOUBLE, all, stored, slab, false);
  self.agree(wrong);
  self.agree(all == plan.rows && stored == columns
                 ? std::nullopt
                 : std::optional(fmt::format("\"{}\" has {} x {} numbers; expected are {} x {}", name, all, stored, plan.rows, columns)));
  const auto bad = std::find_if(slab.begin(), slab.end(), [](double value) { return !std::isfinite(value); });
  self.agree(bad == slab.end()
                 ? std::nullopt
                 : std::optional(fmt::format("\"{}\" holds {} in the row of the id {} of \"{}\"; only finite numbers can stand there", name, *bad,
                                             plan.slab->getGlobalElement(static_cast<LocalOrdinal>((bad - slab.begin()) / columns)), ids.name)));
  MultiVector source(plan.slab, columns), target(plan.wanted, columns);
  {
    const auto view = source.getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (std::size_t row = 0; row < view.extent(0); ++row)
      for (std::size_t c = 0; c < columns; ++c) view(row, c) = slab[row * columns + c];
  }
  target.doImport(source, *plan.import, Tpetra::INSERT);
  rows.resize(ids.ids.size() * columns);
  const auto view = target.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t row = 0; row < ids.ids.size(); ++row)
    for (std::size_t c = 0; c < columns; ++c) rows[row * columns + c] = view(row, c);
}

}  // namespace mortise
